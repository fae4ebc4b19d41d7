"""The isolux command: where it is, and a run of it that can be watched and stopped."""

import json
import os
import shutil
import subprocess
import threading

# What it ends with: done, and stopped early with a valid map.
VALID = (0, 3)


class Trouble(Exception):
    """Something that the user is told, in one sentence."""


def find(asked):
    """The path of the command: as asked for in the preferences, else on PATH."""
    import bpy

    if asked:
        path = bpy.path.abspath(asked)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
        raise Trouble(f"{path}: is not a program; set the path of isolux in the preferences of the add-on")
    path = shutil.which("isolux")
    if path is None:
        raise Trouble("isolux is not found on PATH; install it, or set its path in the preferences of the add-on")
    return path


class Run:
    """One run in the background. `state` is the newest that it told of its progress."""

    def __init__(self, program, arguments):
        self.arguments = arguments
        self.state = {}
        self.warnings = []
        self.error = ""
        self.printed = ""
        try:
            self.process = subprocess.Popen(
                [program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace"
            )
        except OSError as error:
            raise Trouble(f"{program}: cannot be run ({error}); set the path of isolux in the preferences of the add-on") from error
        self.readers = [threading.Thread(target=read, daemon=True) for read in (self._read_progress, self._read_output)]
        for reader in self.readers:
            reader.start()

    def _read_progress(self):
        for line in self.process.stderr:
            try:
                told = json.loads(line)
            except ValueError:
                # What it says before it knows of --progress json.
                self.error = self.error or line.strip()
                continue
            if "error" in told:
                self.error = told["error"]
            elif "warning" in told:
                self.warnings.append(told["warning"])
            elif "stage" in told:
                self.state = told

    def _read_output(self):
        self.printed = self.process.stdout.read()

    def is_done(self):
        return self.process.poll() is not None

    def stop(self):
        self.process.terminate()
        self.process.wait()

    def result(self):
        """What it printed, once it is done."""
        code = self.process.wait()
        for reader in self.readers:
            reader.join()
        if code in VALID:
            return self.printed
        raise Trouble(self.error or f"isolux {' '.join(self.arguments)}: exit code {code}")

    def progress(self):
        """A line for people, and the share that is done."""
        stage = self.state.get("stage")
        if stage is None:
            return "isolux reads the scene", 0.0
        elapsed, finish = self.state["elapsed_s"], self.state.get("finish_s")
        error = self.state.get("accuracy")
        told = "" if error is None else f", error {100 * error:.2g} %"
        left = "" if finish is None else f", {max(0, finish - elapsed):.0f} s left"
        return f"isolux: {stage}{told}{left}", min(1.0, elapsed / finish) if finish else 0.0
