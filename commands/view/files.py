"""The files of the page and of the host that draws in it, as the server sends them."""

from __future__ import annotations

from importlib.resources import files

_PACKAGES = ("web_view", "web_host")
"""The folders below ``targets``. Their ``modules`` replace the sources from which they were made,
so that one module imports the other as it does in the tree."""
_MODULES = "modules"
_KINDS = {
    ".css": "text/css",
    ".html": "text/html",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
}
PAGE = "/web_view/index.html"
"""The file that ``/`` shows."""


def page_files() -> dict[str, tuple[bytes, str]]:
    """The content and the media type of each file, by the path of its address."""
    found = {}
    for package in _PACKAGES:
        folder = files(f"{__package__.split('.')[0]}.targets.{package}")
        pending = [(f"/{package}", folder)]
        while pending:
            path, each = pending.pop()
            if each.is_dir():
                inside = path.removesuffix(f"/{_MODULES}")
                pending += [(f"{inside}/{inner.name}", inner) for inner in each.iterdir()]
                continue
            kind = next((kind for end, kind in _KINDS.items() if path.endswith(end)), None)
            if kind is not None:
                found[path] = each.read_bytes(), kind
    return {"/": found[PAGE], **found}
