"""A public class name means one thing on a floor: who reads ``Request`` need not ask which."""

from __future__ import annotations

import ast
from collections import defaultdict

from ..suite.package import FOLDERS
from .kit import ROOT, files

HOUSES_OF_FLOORS = {"compiler", "targets", "stdlib", "materialx", "engines"}
"""Folders whose folders are floors: two of them may each have, say, a ``Context``."""
FAMILIES = (
    "targets/conformance/comparers",
    "targets/runner/scenes/gltf",
    "targets/runner/drivers/browser",
    "targets/runner/drivers/opengl",
    "targets/runner/drivers/vulkan",
    "targets/runner/drivers/wgpu",
)
"""Folders below a floor with names of their own: the records of glTF are called as its
specification calls them, drivers have the same parts under the same names, and comparers are copied
to where they stand alone."""


def _floor(path: str) -> str:
    """The floor that a file, given relative to the root, belongs to."""
    for family in FAMILIES:
        if path.startswith(f"{family}/"):
            return family
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] in HOUSES_OF_FLOORS else parts[0]


def test_a_class_name_means_one_thing_on_its_floor() -> None:
    declared = defaultdict(list)
    for folder in FOLDERS:
        for path in files(ROOT / folder):
            if path.suffix != ".py":
                continue
            name = path.relative_to(ROOT).as_posix()
            for node in ast.parse(path.read_text("utf-8")).body:
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    declared[_floor(name), node.name].append(name)
    twice = {name: paths for (_, name), paths in declared.items() if len(paths) > 1}
    assert not twice, "\n".join(f"{name}: {', '.join(paths)}" for name, paths in twice.items())
