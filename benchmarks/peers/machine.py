"""Where and with what the run was made."""

import importlib.metadata
import os
import platform
import subprocess


def machine():
    """Processor, cores and load."""
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo") as lines:
            models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        name = models[0] if models else name
    except OSError:
        pass
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return {"processor": name, "cores": cores, "system": platform.system(), "load_before": os.getloadavg()[0]}


def versions(isolux, libllvm):
    """Of everything that computes; `libllvm` is its path, or None where nothing is compiled by it."""
    found = {name: importlib.metadata.version(name) for name in ("mitsuba", "drjit", "pyluxcore", "pyradiance")}
    said = subprocess.run([isolux, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    found["isolux"] = said.split()[-1]
    if libllvm:
        found["libLLVM"] = os.path.basename(os.path.realpath(libllvm))
    return found
