"""The reflection says of derived values which of them hosts of scenes have already."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.reflection import well_known
from burnish.compiler.reflection.roles import scene_names

EXAMPLES = Path(__file__).parents[2] / "examples"


def roles_of(material: burnish.CompiledMaterial) -> dict[str, str]:
    """The roles of derived values that have one, by name."""
    return {row.name: row.role for row in material.reflection.derived if row.role is not None}


def compiled(source: str) -> burnish.CompiledMaterial:
    (material,) = burnish.compile(source, ("wgsl",))
    return material


def test_the_matrix_of_normals_is_one_of_the_scene() -> None:
    (plastic,) = burnish.compile(EXAMPLES / "plastic.burnish", ("wgsl",))
    assert roles_of(plastic) == {"normal_matrix": "normal_matrix"}


def test_own_transforms_have_a_matrix_of_normals_too() -> None:
    material = compiled(
        "material M {\n"
        "    param stood : transform<object, world> per draw\n"
        "    color = transpose(inverse(mat3(stood))) * vec3(uv, 1)\n"
        "}"
    )
    (row,) = material.reflection.derived
    assert row.role == "normal_matrix"


@pytest.mark.parametrize(
    "matrix",
    [
        "transpose(inverse(mat3(own)))",
        "transpose(inverse(mat3(seen)))",
        # Columns in another order.
        "transpose(inverse(mat3(stood[0].xyz, stood[2].xyz, stood[1].xyz)))",
        # Lanes in another order.
        "transpose(inverse(mat3(stood[0].zyx, stood[1].zyx, stood[2].zyx)))",
        # Columns of two matrices.
        "transpose(inverse(mat3(stood[0].xyz, stood[1].xyz, own[2].xyz)))",
    ],
)
def test_others_are_the_materials_own_affair(matrix: str) -> None:
    material = compiled(
        "material M {\n"
        "    param own : mat4 per draw\n"
        "    param seen : transform<world, clip> per view\n"
        "    param stood : transform<object, world> per draw\n"
        f"    color = {matrix} * vec3(uv, 1)\n"
        "}"
    )
    (row,) = material.reflection.derived
    assert (row.representation, row.role) == ("mat3", None)


def test_the_scene_has_names_for_functions_of_its_own_names() -> None:
    """A misspelt one would never be found."""
    names = scene_names()
    known = {name for kind in ("parameters", "types") for name in names[kind].values()}
    for of in names["derived"]:
        function, _, argument = of.removesuffix(")").partition("(")
        assert function in {row.name for row in well_known.ROWS}
        assert argument in known
