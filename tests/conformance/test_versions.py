"""A version of a material is held against the meaning of the whole material, with its values."""

from __future__ import annotations

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.trials import Version
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

SOURCE = """
material Paint {
    param weight : float in 0..1 = 1
    param tint   : rgb = #b5651d
    map coat : texture2d
    map dirt : texture2d
    color = weight * coat(uv).rgb + dirt(uv).rgb * tint
}
"""
ROUTE = ROUTES["lavapipe:glsl"]


def material(values: dict[str, str], *, specialise: bool) -> CompiledMaterial:
    (found,) = burnish.compile(
        SOURCE, "glsl", values=values, specialise=specialise, keep_graphs=True
    )
    return found


def row(drawn: dict[str, str], meant: dict[str, str], narrowed: frozenset[str]) -> Row:
    """The row of the version for some values, beside the whole material with others."""
    version = Version(material(meant, specialise=False), narrowed, frozenset(meant))
    with Runner([ROUTE]) as runner, Toolchain(states=runner.states) as toolchain:
        (found,) = conform(
            [("Paint", material(drawn, specialise=True))], [ROUTE], runner, toolchain,
            size=(24, 16), keep=False, versions={"Paint": version},
        )  # fmt: skip
    return found


def test_hosts_are_told_of_values_by_a_text_that_serves_all() -> None:
    told = material({"weight": "0"}, specialise=False)
    assert told.text("glsl", "fragment") == material({}, specialise=True).text("glsl", "fragment")
    (weight,) = (each for each in told.reflection.parameters if each.name == "weight")
    assert (weight.default, weight.range) == (0, (0, 0))


def test_a_version_has_the_meaning_of_the_material_with_its_values() -> None:
    """Also where lanes have values of their own, and the first texture is gone."""
    values = {"weight": "0", "tint": "#102030"}
    assert "coat" not in material(values, specialise=True).text("glsl", "fragment")
    assert row(values, values, frozenset(values)).status == "agrees"


def test_a_version_that_means_something_else_differs() -> None:
    found = row({"weight": "0"}, {"weight": "1"}, frozenset({"weight"}))
    assert found.status == "differs"


def test_what_scenes_set_cannot_be_narrowed() -> None:
    name = frozenset({"sun.direction"})
    found = row({}, {}, name)
    assert found.status == "failed" and "scenes" in (found.problem or "")
