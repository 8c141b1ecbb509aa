"""The texts of the stages that divide patches.

``BURNISH_UPDATE_GOLDEN=1`` writes the texts anew. What drivers make of them is tried in
``tests/conformance/test_tessellation_stages.py``.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.api import _compiled
from burnish.compiled import CompiledMaterial
from burnish.compiler.passes.pipeline import Options, stage
from burnish.targets import registry
from burnish.targets.emit.emitter import EmitOptions

from ..passes.test_tessellated_graphs import divided
from .test_geometry_stage import refused

GOLDEN = Path(__file__).parent / "golden" / "tessellation"
PROFILES = ("glsl:vulkan", "glsl:gl450", "hlsl:sm6")


def material(profile: str, options: EmitOptions) -> CompiledMaterial:
    """Triangles whose levels are lengths of edges, with one of them handed on to all vertices."""
    _, shader = divided()
    return _compiled(shader, stage(shader, Options()), {}, [registry.select(profile)], options)


@pytest.mark.parametrize("profile", PROFILES)
def test_texts(profile: str) -> None:
    files = material(profile, EmitOptions()).files
    assert [file.stage for file in files] == ["vertex", "control", "evaluation", "fragment"]
    for file in files:
        path = GOLDEN / file.name
        if os.environ.get("BURNISH_UPDATE_GOLDEN"):
            path.parent.mkdir(exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        assert file.text == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("flip_y", [False, True])
@pytest.mark.parametrize("profile", PROFILES)
def test_compilers_accept_them(profile: str, flip_y: bool) -> None:
    assert refused(material(profile, EmitOptions(flip_y=flip_y))) == []


def test_compilers_accept_all_stages_in_one_text() -> None:
    made = material("hlsl:sm6", EmitOptions(single_file=True))
    assert [set(file.entry_points.values()) for file in made.files] == [
        {"vs_main", "hs_main", "ds_main", "fs_main"}
    ]
    assert refused(made) == []


def test_what_is_handed_on_keeps_its_place() -> None:
    program = material("glsl:vulkan", EmitOptions()).staged.program
    vertex, control, evaluation, _ = program.stages
    assert control.handed_on == vertex.outputs == control.inputs
    assert set(evaluation.inputs) == {*control.handed_on, *control.outputs}
    locations = [field.location for field in evaluation.inputs]
    assert len(set(locations)) == len(locations)
