"""The files of the page and the modules of the host that draws in it, as the server sends them."""

from __future__ import annotations

from importlib.resources import files

from ...targets.web_host.serving.modules import host_modules

_KINDS = {
    ".css": "text/css",
    ".html": "text/html",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
}
_SCRIPT = _KINDS[".js"]
PAGE = "/web_view/index.html"
"""The file that ``/`` shows."""


def page_files() -> dict[str, tuple[bytes, str]]:
    """The content and the media type of each file, by the path of its address. The folders lie as
    they do in the tree, so that a module of the page imports one of the host as it does there."""
    found = {f"/web_host/{name}": (text.encode(), _SCRIPT) for name, text in host_modules().items()}
    for file in files(f"{__package__.split('.')[0]}.targets.web_view").iterdir():
        kind = next((kind for end, kind in _KINDS.items() if file.name.endswith(end)), None)
        if kind is not None:
            found[f"/web_view/{file.name}"] = file.read_bytes(), kind
    return {"/": found[PAGE], **found}
