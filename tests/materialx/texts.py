"""Documents as texts: what tests write down, and what becomes of it."""

from __future__ import annotations

from pathlib import Path

from burnish.materialx.importing import Imported, imported
from burnish.materialx.outline import DocumentError

UNLIT = (
    '<surface_unlit name="s" type="surfaceshader">\n'
    '<input name="emission_color" type="color3" {}/>\n'
    "</surface_unlit>\n"
    '<surfacematerial name="{}" type="material"{}>\n'
    '<input name="surfaceshader" type="surfaceshader" nodename="s"/>\n'
    "</surfacematerial>"
)
RED = 'value="1, 0, 0"'


def lit(color: str = RED, name: str = "m", more: str = "") -> str:
    """A material that shows a colour."""
    return UNLIT.format(color, name, more)


def document(body: str, version: str = "1.39") -> str:
    """A document; its first element stands in line 2."""
    return f'<materialx version="{version}">\n{body}\n</materialx>\n'


def converted(folder: Path, text: str | bytes) -> Imported:
    """What a document becomes; its files are written beside it."""
    path = folder / "doc.mtlx"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    found = imported(path)
    for name, content in found.files.items():
        place = folder / name
        place.parent.mkdir(exist_ok=True)
        place.write_bytes(content)
    return found


def told(folder: Path, text: str | bytes) -> list[str]:
    """What is said of a document: why it is not read, or what is not converted."""
    try:
        return [str(problem) for problem in converted(folder, text).problems]
    except DocumentError as error:
        return [str(error)]


def node(text: str) -> str:
    """A node called x before a material that shows it."""
    link = 'nodegraph="g"' if 'name="g"' in text else 'nodename="x"'
    return document(f"{text}\n{lit(link)}")
