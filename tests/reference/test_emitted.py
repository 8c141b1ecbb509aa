"""The program of every profile means what the material means: both are drawn in double precision.

No driver takes part, so a difference is an error of a pass or of ``legalise``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.api import entry_points as api
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference.picture import Expected, RasterRules
from burnish.targets.conformance.cases import series_of
from burnish.targets.runner.kernels import drawable, is_drawn
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import expected, graph_text
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up

from ..conformance import subjects
from ..examples.kit import EXAMPLES
from ..targets.standings import PROFILES

FILES = (*EXAMPLES, *sorted(subjects.FOLDER.glob("*.burnish")))
RULES = RasterRules(36, 28)
"""Small pictures, of a device that rounds nothing."""
CLOSE = 1e-9
"""The largest difference of values, relative to their size if that is larger than 1."""


def programs(material: CompiledMaterial) -> Mapping[str, Shader]:
    """The emitted programs that differ, each under the name of one profile that has it."""
    found: dict[str, tuple[str, Shader]] = {}
    for profile in PROFILES:
        if profile not in material.lacking:
            program = drawable(material.emitted(profile))
            found.setdefault(graph_text(program), (profile, program))
    return dict(found.values())


def states(material: CompiledMaterial) -> Iterator[tuple[str, SceneState]]:
    """The scenes of conformance, in a small picture."""
    for series in series_of(material.reflection):
        for case in series.cases:
            yield case.name, replace(case.state, width=RULES.width, height=RULES.height)


def difference(meant: Expected, drawn: Expected) -> float:
    """The largest difference of a lane where both pictures are decided; NaN counts as infinite."""
    decided = ~(meant.undecided | drawn.undecided)
    assert np.array_equal(meant.covered[decided], drawn.covered[decided])
    pairs = zip(meant.targets, drawn.targets, strict=True)
    return max(float(_distance(a, b)[decided].max(initial=0.0)) for a, b in pairs)


def _distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    with np.errstate(invalid="ignore"):
        distance = np.abs(a - b) / np.maximum(np.abs(a), 1.0)
    return np.where(a == b, 0.0, np.where(np.isnan(distance), np.inf, distance))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_profile_means_the_same(path: Path) -> None:
    for rig, pass_ in api.variants(path):
        for material in burnish.compile(path, PROFILES, rig=rig, pass_=pass_, partial=True):
            if not is_drawn(material.reflection):
                continue  # `tests/conformance/` judges captures and kernels over buffers.
            drawn = programs(material)
            seen = 0
            for name, state in states(material):
                meant = expected(drawable(material.shader), state, RULES)
                seen += int((meant.covered & ~meant.undecided).sum())
                for profile, program in drawn.items():
                    found = difference(meant, expected(program, state, RULES))
                    assert found < CLOSE, f"{material.name}, {pass_}, {name}, {profile}: {found:g}"
            assert seen and drawn


def compiled(text: str, *profiles: str) -> CompiledMaterial:
    return burnish.compile(text, profiles or PROFILES)["M"]


def ops(shader: Shader) -> list[str]:
    return [node.op for node in reachable(shader.roots)]


def test_a_builtin_that_a_profile_lacks_is_a_call_of_its_definition() -> None:
    material = compiled(
        "material M { color = vec3(float(count_bits(int(floor(9 * uv.x))))) }",
        "glsl:es300", "glsl:vulkan",
    )  # fmt: skip
    assert "apply" in ops(material.emitted("glsl:es300"))
    assert "apply" not in ops(material.emitted("glsl:vulkan"))


def test_a_derived_value_keeps_its_precision() -> None:
    """A third of 1 is no float32, and the device gets the nearest one; but it means a third."""
    material = compiled("material M { param k : float = 3  color = vec3(1 / (k * k * k)) }", "wgsl")
    state = set_up(material.instance(), plane(2), Scene(), (36, 28))
    drawn = expected(material.emitted("wgsl:webgpu"), state, RULES)
    assert "MaterialDerived" in material.text("wgsl", "fragment")
    assert (drawn.targets[0][drawn.covered][:, :3] == 1 / 27).all()


def test_equal_programs_are_remembered_as_one() -> None:
    material = compiled("material M { color = vec3(sin(3 * uv.x)) }")
    assert len(programs(material)) == 1


def test_a_profile_that_was_not_asked_for_has_no_program() -> None:
    material = compiled("material M { color = vec3(1) }", "wgsl")
    with pytest.raises(KeyError, match="M has no texts for glsl:es300"):
        material.emitted("glsl:es300")
