"""Has Bevy's own composer compose shaders with Bevy's own modules, for each pass that draws them.

The composer, ``naga_oil``, is the one that Bevy has, and naga validates what it makes. Nothing of
Bevy's programs runs here: what each pass defines is in ``PASSES``, as Bevy's source says it.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from burnish.targets.toolchain.process import run
from burnish.targets.toolchain.tools import tool_named

LIMIT = 120.0
"""The seconds that the composer may take on a busy machine; it takes some milliseconds a shader."""

ALWAYS = (
    "MATERIAL_BIND_GROUP=3", "MAX_CASCADES_PER_LIGHT=4", "MAX_DIRECTIONAL_LIGHTS=10",
    "MAX_RECT_LIGHTS=16", "PER_OBJECT_BUFFER_BATCH_SIZE=64", "AVAILABLE_STORAGE_BUFFER_BINDINGS=8",
    "SCREEN_SPACE_SPECULAR_TRANSMISSION_BLUR_TAPS=8", "VERTEX_OUTPUT_INSTANCE_INDEX",
    "VERTEX_POSITIONS", "VERTEX_UVS", "VERTEX_UVS_A", "VERTEX_UVS_B", "VERTEX_COLORS",
    "VIEW_PROJECTION_PERSPECTIVE",
)  # fmt: skip
"""What Bevy defines in all passes, for a mesh that has everything."""
NORMALS = ("VERTEX_NORMALS", "VERTEX_TANGENTS")
DEEP = ("PREPASS_PIPELINE", "NORMAL_PREPASS_OR_DEFERRED_PREPASS", *NORMALS, "PREPASS_FRAGMENT")
MOVING = ("MOTION_VECTOR_PREPASS", "MOTION_VECTOR_PREPASS_OR_DEFERRED_PREPASS")

PASSES: Mapping[str, tuple[str, ...]] = {
    "forward": ("MESH_PIPELINE", *NORMALS),
    "forward, skinned": (
        "MESH_PIPELINE", *NORMALS, "SKINNED", "VISIBILITY_RANGE_DITHER", "MAY_DISCARD",
        "STANDARD_MATERIAL_CLEARCOAT", "STANDARD_MATERIAL_SPECULAR_TRANSMISSION",
    ),
    "deferred": (*DEEP, "DEFERRED_PREPASS"),
    "deferred, skinned": (
        *DEEP, *MOVING, "DEFERRED_PREPASS", "SKINNED", "HAS_PREVIOUS_SKIN",
        "VISIBILITY_RANGE_DITHER",
    ),
}  # fmt: skip
"""What a pass defines beside that."""
BEFORE: Mapping[str, tuple[str, ...]] = {
    "depths": ("PREPASS_PIPELINE", "DEPTH_PREPASS"),
    "depths with holes": ("PREPASS_PIPELINE", "DEPTH_PREPASS", "MAY_DISCARD"),
    "shadows": (
        "PREPASS_PIPELINE", "UNCLIPPED_DEPTH_ORTHO_EMULATION", "PREPASS_FRAGMENT", "SKINNED",
        "MAY_DISCARD",
    ),
    "normals": (*DEEP, *MOVING, "NORMAL_PREPASS", "MAY_DISCARD"),
}  # fmt: skip
"""Passes before the others, in which only some materials have shaders of their own."""

OWN = """burnish 1

enum Mode { plain, striped }

/// All kinds of parameters.
material Own {
    param base    : rgb = #ffffff
    param match   : float in 0..1 = 0.5     /// How well it fits
    param mode    : Mode = Mode.striped
    param weights : float[3] = [1, 2, 3]
    param is_wet  : bool = true
    param turn    : mat2 = mat2(vec2(0, 1), vec2(1, 0))
    map   grain   : utexture2d

    roughness = match * weights[1] * float(grain.load(ivec2(0, 0), 0).x) + (turn * uv).x
    metallic  = choose(mode, plain = 0.0, striped = uv.x) + (if is_wet then 0.1 else 0.2)
}
"""
"""A material with parameters of all kinds."""
SWOLLEN = """burnish 1

import std.prelude.{Surface}

material Swollen : Surface {
    param by        : float = 0.1

    object_position = vertex_position + vertex_normal * (by * (1 + vertex_position.y))
    object_normal   = normalize(vertex_normal + vec3(0, by, 0) * vertex_position)
    is_hidden       = vertex_normal.y > 0.9
    base_color      = rgb(vertex_position * 0.5 + 0.5)
}
"""
"""A material that moves and turns the vertices of its object, and has holes."""


def passes_of(files: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """What is defined in each pass in which a material has a shader."""
    (module,) = (text for name, text in files.items() if name.endswith(".rs"))
    found = {name: (*ALWAYS, *words) for name, words in PASSES.items()}
    if "fn prepass_" in module:
        added = [word for word in DEEP[1:-1] if f'"{word}"' in module]
        found |= {name: (*ALWAYS, *words, *added) for name, words in BEFORE.items()}
    return found


def composed(materials: Mapping[str, Mapping[str, str]], folder: Path) -> dict[str, str]:
    """What the composer says of materials in passes, by ``material, pass``: nothing if it takes it.

    ``materials`` are the files of each.
    """
    found = tool_named("bevy").find()
    assert found is not None
    program = found[0]
    labels, jobs = [], []
    for label, files in materials.items():
        (text,) = (text for name, text in files.items() if name.endswith(".wgsl"))
        path = folder / f"{label}.wgsl"
        path.write_text(text, "utf-8")
        for name, words in passes_of(files).items():
            labels.append(f"{label}, {name}")
            jobs.append("\t".join([str(path), *words]))
    (folder / "jobs.txt").write_text("\n".join(jobs), "utf-8")
    command = [str(program), str(program.parent / "modules"), str(folder / "jobs.txt")]
    outcome = run(command, time_limit=LIMIT, folder=folder)
    assert outcome.ending == "ended" and outcome.code == 0, outcome.log
    said = [line.removeprefix("refused ") for line in outcome.log.splitlines()]
    return {
        label: "" if line == "taken" else line for label, line in zip(labels, said, strict=True)
    }
