"""A project for tests of ``burnish build``, and what is run there."""

from __future__ import annotations

from pathlib import Path

TONES = "shared/tones.burnish"
FILES = {
    TONES: "fn tone(x: float) -> float = x * 0.5\n",
    "materials/a.burnish": (
        'import "shared/tones.burnish".{tone}\nmaterial A { color = vec3(tone(0.5)) }\n'
    ),
    "materials/b.burnish": (
        'import "shared/tones.burnish".{tone}\nmaterial B { color = vec3(tone(0.1)) }\n'
    ),
    "materials/c.burnish": "material C { color = vec3(0.2) }\n",
    "materials/metal/r.burnish": (
        "import std.lights.{Point}\n"
        "rig Day { sun : Point }\nrig Night { moon : Point }\n"
        "material R { color = vec3(0.1) }\n"
    ),
}
"""Three files, of which two import a fourth one, and one with two rigs: five actions."""
LINE = ("-I", ".", "-t", "wgsl")


def write_project(folder: Path) -> None:
    """Write the project into a folder."""
    for name, text in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
