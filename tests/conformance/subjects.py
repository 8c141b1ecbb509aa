"""The materials of this folder, which between them do all that the language can."""

from __future__ import annotations

from pathlib import Path

import burnish
from burnish import api
from burnish.api import CompiledMaterial
from burnish.compiler.ir.node import reachable
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.routes import ROUTES

from .kit import Studio

FOLDER = Path(__file__).parent / "materials"


def _names() -> tuple[str, ...]:
    return tuple(
        f"{path.stem}: {pass_}"
        for path in sorted(FOLDER.glob("*.burnish"))
        for _rig, pass_ in api.variants(path)
        if pass_ is not None
    )


NAMES = _names()
"""``operations: Limits``: a file, and one of its passes."""

LACKING = dict.fromkeys(
    ("gathered: Colors", "gathered: Depths", "gathered: Levels", "gathered: Varying"),
    ("glsl:es300", "glsl:gl330"),
)
"""What some profiles cannot do."""

DEFECTS = {"gathered: Varying": "lavapipe"}
"""What a driver gets wrong: Mesa 22.3.6 takes one pixel's size of a level for that of all, so
loads are kept within the wrong one."""


def compiled(name: str, *profiles: str) -> CompiledMaterial:
    """One of ``NAMES``, compiled anew."""
    stem, _, pass_ = name.partition(": ")
    (material,) = burnish.compile(FOLDER / f"{stem}.burnish", profiles, pass_=pass_)
    return material


def row(studio: Studio, name: str, route: str) -> Row:
    """What a conformance run finds of one of ``NAMES``, compiled anew, on a route."""
    material = compiled(name, ROUTES[route].profile)
    (found,) = conform([(name, material)], [ROUTES[route]], studio.runner, studio.toolchain)
    return found


def called(name: str) -> frozenset[str]:
    """The builtins that one of ``NAMES`` calls."""
    shader = compiled(name).shader
    return frozenset(str(node.data) for node in reachable(shader.roots) if node.op == "call")
