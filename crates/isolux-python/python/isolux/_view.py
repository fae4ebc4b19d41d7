"""A map in a notebook: the walk-through, and a picture where nothing runs."""

from __future__ import annotations

import gzip
import html
import os
import struct
import tempfile
import zlib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from isolux._errors import InputError

if TYPE_CHECKING:
    from isolux._map import Map

#: Of the page in a notebook, in pixels.
HEIGHT = 480
#: Time to look for finer shadows than the map has: whoever looks, waits.
FINER_S = 1.0
#: Of the picture, in pixels: sixteen to nine in a column of a notebook.
_PICTURE = (800, 450)

#: What the page may do: draw, take the pointer while one walks, and save readings. It sees nothing of the notebook.
_SANDBOX = "allow-scripts allow-pointer-lock allow-downloads allow-popups"
_FRAME = "width:100%;border:0;border-radius:4px;display:block"

_SCRIPT = f"""
async function unpack(view) {{
  const bytes = new Blob([view]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(bytes).text();
}}
export default {{
  async render({{ model, el }}) {{
    const frame = document.createElement("iframe");
    frame.setAttribute("sandbox", {_SANDBOX!r});
    frame.allow = "fullscreen";
    frame.title = "walk-through";
    frame.style.cssText = {_FRAME!r};
    const fit = () => (frame.style.height = `${{model.get("height")}}px`);
    fit();
    model.on("change:height", fit);
    el.append(frame);
    frame.srcdoc = await unpack(model.get("page"));
    return () => frame.remove();
  }},
}};
"""


def page(m: Map, finer: float | None = None) -> str:
    """The walk-through in one page, as ``isolux export map.glb -o page.html`` writes it."""
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        path = os.path.join(folder, "page.html")
        m.export(path, finer=finer)
        return Path(path).read_text(encoding="utf-8")


def picture(m: Map) -> bytes | None:
    """A view of the map as PNG, interpolated, which is fast: from inside, or from outside where nothing is seen from there."""
    try:
        return _drawn(m)
    except InputError:
        pass
    low, high = m.scene.bounds_m
    away = np.array((-0.5, -0.8, 0.6) if m.scene.up == "z" else (-0.5, 0.6, 0.8))
    middle = 0.5 * (low + high)
    try:
        return _drawn(m, eye=middle + np.linalg.norm(high - low) * away, target=middle)
    except InputError:
        return None


def _drawn(m: Map, **view: Any) -> bytes:
    width, height = _PICTURE
    return _png(m.render(width=width, height=height, interpolated=True, **view))


def _png(image: npt.NDArray[np.uint8]) -> bytes:
    """An image, (height, width, 3) of sRGB, as PNG."""
    height, width, _ = image.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    # Each row after a byte for its filter, the difference to the pixel before: smooth pictures become small.
    rows = image.reshape(height, -1)
    before = np.concatenate([np.zeros((height, 3), np.uint8), rows[:, :-3]], axis=1)
    filtered = np.concatenate([np.ones((height, 1), np.uint8), rows - before], axis=1)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"".join(
        [
            b"\x89PNG\r\n\x1a\n",
            chunk(b"IHDR", head),
            chunk(b"sRGB", b"\0"),
            chunk(b"IDAT", zlib.compress(filtered.tobytes(), 6)),
            chunk(b"IEND", b""),
        ]
    )


class View:
    """A map in a notebook; see :meth:`isolux.Map.view`."""

    def __init__(
        self, m: Map, height: int = HEIGHT, live: bool = True, finer: float = FINER_S
    ) -> None:
        self._page = page(m, finer)
        self._picture = picture(m)
        self._height = height
        self._text = repr(m)
        self._widget = _widget(self._page, height) if live else None

    def _repr_mimebundle_(self, **_: object) -> tuple[dict[str, Any], dict[str, Any]]:
        width, height = _PICTURE
        about = {"image/png": {"width": width, "height": height}}
        bundle: dict[str, Any] = {"text/plain": self._text}
        if self._picture:
            bundle["image/png"] = self._picture
        if self._widget is None:
            return bundle | {"text/html": self._frame()}, about
        shown = self._widget._repr_mimebundle_()
        data, more = shown if isinstance(shown, tuple) else (shown or {}, {})
        return dict(data) | bundle, dict(more) | about

    def _frame(self) -> str:
        """The page in a frame, which saved notebooks and their exports keep."""
        return (
            f'<iframe sandbox="{_SANDBOX}" allow="fullscreen" title="walk-through" '
            f'style="{_FRAME};height:{self._height}px" srcdoc="{html.escape(self._page)}"></iframe>'
        )


def _widget(text: str, height: int) -> Any:
    """The widget with the page in it; none where anywidget is not installed or no notebook listens."""
    kind = _widget_class()
    return kind and kind(page=gzip.compress(text.encode(), 6, mtime=0), height=height)


@cache
def _widget_class() -> Any:
    try:
        import anywidget
        import traitlets
    except ImportError:
        return None

    class WalkThrough(anywidget.AnyWidget):
        """The walk-through of a map."""

        _esm = _SCRIPT
        page = traitlets.Bytes().tag(sync=True)
        height = traitlets.Int(HEIGHT).tag(sync=True)

    return WalkThrough
