"""Parts of all HTML pages of Burnish: templates, and restrictions for the browser.

``report.py`` makes the page of a conformance run, and ``burnish gallery`` those of a folder. Both
show texts that may come from anybody, and are opened from disk or from any server.
"""

from __future__ import annotations

import base64
from hashlib import sha256
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from ...compiler.diagnostics.display import harmless_lines

_OWN_PICTURES = "'self' file: data:"
"""The sources of pictures beside a page: of a page on disk, some browsers do not take files in its
own folder for ``'self'``."""
_EMBEDDED_PICTURES = "data:"


def environment(folder: Path) -> Environment:
    """The templates of a folder.

    All texts that they show are escaped, and so are characters that nobody sees, or that reverse
    texts.
    """
    return Environment(
        loader=FileSystemLoader(folder),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=_visible,
        trim_blocks=True,
        lstrip_blocks=True,
    )


def _visible(value: object) -> object:
    """The text that a template shows for a value.

    Markup comes from Burnish, which has made it harmless already.
    """
    if isinstance(value, str) and not isinstance(value, Markup):
        return harmless_lines(value)
    return value


class Embedded:
    """The style and the script of a page, and the policy by which a browser takes nothing else.

    So even a text that got into a page as markup could neither run nor load anything. Both are in
    the page itself, since browsers compare files beside a page on disk with no digest.
    """

    def __init__(self, style: Path, script: Path | None = None, *, has_files: bool = False) -> None:
        """``has_files`` says whether pictures lie beside the page, instead of in it."""
        self.style = Markup(style.read_text("utf-8"))
        self.script = Markup(script.read_text("utf-8") if script else "")
        rules = {
            "default-src": "'none'",
            "base-uri": "'none'",
            "form-action": "'none'",
            "img-src": _OWN_PICTURES if has_files else _EMBEDDED_PICTURES,
            "style-src": _digest(self.style),
        }
        if self.script:
            rules["script-src"] = _digest(self.script)
        self.policy = "; ".join(f"{name} {allowed}" for name, allowed in rules.items())


def _digest(text: str) -> str:
    return f"'sha256-{base64.b64encode(sha256(text.encode()).digest()).decode()}'"
