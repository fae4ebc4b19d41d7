"""The shared library that compiles Mitsuba's kernels."""

import ctypes.util
import glob
import os
import re

# The oldest that was tried and compiles all kernels for processors with AVX-512; 15 does not.
OLDEST = 19


def llvm():
    """Path of the newest libLLVM that is installed, or of the one named in DRJIT_LIBLLVM_PATH."""
    chosen = os.environ.get("DRJIT_LIBLLVM_PATH")
    if chosen:
        return chosen
    found = {}
    for folder in ("/usr/lib/*", "/usr/lib", "/usr/lib/llvm-*/lib", "/usr/local/lib"):
        for path in glob.glob(f"{folder}/libLLVM*.so*"):
            version = re.search(r"libLLVM(?:-|\.so\.)(\d+)", path)
            if version and int(version[1]) >= OLDEST:
                found[int(version[1])] = path
    if found:
        return found[max(found)]
    elsewhere = ctypes.util.find_library("LLVM")
    if elsewhere and not re.search(r"\d", elsewhere):
        return elsewhere
    raise SystemExit(
        f"there is no libLLVM of version {OLDEST} or newer, which Mitsuba compiles its kernels with; install Debian's "
        "package libllvm19 (or a newer libllvm), or name a library in DRJIT_LIBLLVM_PATH"
    )
