"""The materials of this folder, which together use all of the language."""

from __future__ import annotations

from pathlib import Path

import burnish
from burnish.api import entry_points as api
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.operations import CALL
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.routes import ROUTES

from ..targets.standings import profiles
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
"""The names of materials, such as ``operations: Limits`` for a file and one of its passes."""

_NEEDING = {
    "cube_arrays: Others": ("arrays of cubes", "gathering texels", "number of levels"),
    "cube_arrays: Sampled": ("arrays of cubes",),
    "cube_arrays: Slopes": ("arrays of cubes",),
    "gathered: Colors": ("gathering texels",),
    "gathered: Depths": ("gathering comparisons",),
    "gathered: Levels": ("number of levels",),
    "gathered: Varying": ("gathering texels", "number of levels"),
    "pipeline: Edges": ("edges",),
    "pipeline: Sampled": ("blending by target",),
    "pipeline: Stained": ("equations by target",),
    "pipeline: Veil": ("equations by target",),
    "buffers: Scaled": ("storage buffers at vertices",),
    "covered: Beyond": ("blending by target",),
    "buffers: Shapes": ("storage buffers at vertices",),
}
"""The capabilities that materials use, of those that some profiles lack."""
LACKING = {name: profiles("absent", *needed) for name, needed in _NEEDING.items()}
"""The profiles that lack a capability of a material, by material."""

DEFECTS = {"gathered: Varying": ("lavapipe", "llvmpipe")}
"""Materials that show a driver's bug. Mesa 22.3.6 uses the size of the level of one pixel for all,
so it clamps loads to the wrong size."""

MAY_PROVE_LITTLE = {
    "cube_arrays: Slopes": "gradients of a cube read all levels, likewise",
    "kinds: Slopes": "gradients of a cube read all levels that some choice of derivatives allows",
    "pipeline: Singular": "a determinant that is zero, or its rounding",
    "values: Loops": "a loop ends where two sums are equal",
}
"""Materials of which some pixels may have nearly any value on a device that conforms, and why."""


def compiled(name: str, *profiles: str) -> CompiledMaterial:
    """One of ``NAMES``, compiled again."""
    stem, _, pass_ = name.partition(": ")
    (material,) = burnish.compile(FOLDER / f"{stem}.burnish", profiles, pass_=pass_)
    return material


def row(studio: Studio, name: str, route: str) -> Row:
    """The row of a conformance run for one of ``NAMES``, compiled again, and a route.

    It ends with the first picture that differs. What the reference draws is not kept: nobody draws
    the same again, where an error is planted.
    """
    material, drawn = compiled(name, ROUTES[route].profile), [ROUTES[route]]
    (found,) = conform(
        [(name, material)], drawn, studio.runner, studio.toolchain, keep=False, brief=True
    )
    return found


def called(subject: CompiledMaterial) -> frozenset[str]:
    """The builtins that a material or a kernel uses."""
    nodes = reachable(subject.shader.roots)
    return frozenset(CALL.data(node) for node in nodes if node.op == "call")
