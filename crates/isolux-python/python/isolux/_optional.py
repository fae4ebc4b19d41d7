"""Packages that are needed by some functions alone."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(module: str, package: str | None = None) -> Any:
    """Import a module, or say in one line how to get it."""
    try:
        return import_module(module)
    except ImportError as missing:
        name = package or module.partition(".")[0]
        text = f"this needs {name}, which is not installed; install it: pip install {name}"
        raise ImportError(text, name=missing.name) from missing
