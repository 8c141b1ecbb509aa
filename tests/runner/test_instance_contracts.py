"""An instance refuses values that break a contract of the reflection."""

from __future__ import annotations

import math

import numpy as np
import pytest

import burnish
from burnish import Instance, ParameterError
from burnish.compiler.documents.writing import to_json

from .instance_kit import REFLECTION, complete, state

REFUSED: list[tuple[str, object, str]] = [
    ("powr", 1, "there is no parameter `powr`: did you mean `power`?"),
    ("lamp[0].place", 1, "there is no parameter `lamp[0].place`: did you mean `lamps`?"),
    ("power]", 1, "there is no parameter `power]`: did you mean `power`?"),
    ("torch.axs", 1, "there is no parameter `torch.axs`: did you mean `torch.axis`?"),
    ("power.x", 1, "`power` (float) has no part `x`"),
    ("base[0]", 1, "`base` (rgb) has no part `[0]`"),
    ("lamps[3].place", 1, "there is no `lamps[3]`: the last element is `lamps[2]`"),
    ("lamps.place", 1, "`lamps` (Point[3]) has no part `place`"),
    ("lamps[0].plce", 1, "`lamps[0]` has no member `plce`: did you mean `place`?"),
    ("layer.zzz", 1, "`layer` has no member `zzz`: there are tint, cone, weights"),
    ("layer", {"zzz": 1}, "`layer` has no member `zzz`: there are tint, cone, weights"),
    ("layer", 3, "`layer` takes a mapping of tint, cone, weights (Layer), and was given 3"),
    (
        "torch",
        3,
        "`torch` is a light and takes a mapping of diffuse_color, specular_color, place, axis, "
        "inner, outer",
    ),
    ("torch", {"axs": 3}, "there is no parameter `torch.axs`: did you mean `torch.axis`?"),
    ("power", 600, "`power` is declared in 1..512: 600 is not"),
    ("power", 0.5, "`power` is declared in 1..512: 0.5 is not"),
    ("offset", (0, 4), "`offset` is declared in -3..3: 4 is not"),
    ("tag", 8, "`tag` is declared in 0..7: 8 is not"),
    ("lamps.count", 4, "`lamps.count` is declared in 0..3: 4 is not"),
    ("lamps.count", -1, "`lamps.count` is declared in 0..3: -1 is not"),
    (
        "lamps",
        [{}] * 4,
        "`lamps` takes a list of at most 3 elements (Point[3]), and was given a list of 4",
    ),
    (
        "pair",
        [{}],
        "`pair` takes a list of 2 elements (Point[2]), and was given a list of 1",
    ),
    ("base", (1, 2), "`base` takes 3 numbers (rgb), and was given a list of 2"),
    ("base", 1, "`base` takes 3 numbers (rgb), and was given 1"),
    ("base", {1, 2, 3}, "`base` takes 3 numbers (rgb), and was given {1, 2, 3}"),
    ("base", b"abc", "`base` takes 3 numbers (rgb), and was given b'abc'"),
    ("base", "#12345", "`base`: #12345 is no colour, which would be #b5651d"),
    ("base", "#12345678", "`base` takes 3 numbers (rgb), and was given a list of 4"),
    ("base", "red", "`base` (rgb) cannot hold 'red': a colour is written #f00"),
    ("base", "paint", "`base` (rgb) cannot hold 'paint': a colour is written #b5651d"),
    ("base", ("1", 2, 3), "`base` (rgb) cannot hold '1'"),
    ("power", [1], "`power` takes one number (float), and was given a list of 1"),
    ("turn", (1, 2, 3), "`turn` takes 2 columns of 2 numbers (mat2), and was given a list of 3"),
    (
        "turn",
        ((1, 2), (3,)),
        "`turn` takes columns of 2 numbers (mat2), and was given a list of 1",
    ),
    ("power", True, "`power` (float) cannot hold True"),
    ("power", None, "`power` (float) cannot hold None"),
    ("power", 1j, "`power` (float) cannot hold 1j"),
    ("power", "30deg", "`power` (float) cannot hold '30deg'"),
    ("tilt", "xdeg", "`tilt` (angle) cannot hold 'xdeg'"),
    ("steps", 1.5, "`steps` (int) cannot hold 1.5"),
    ("steps", math.nan, "`steps` (int) cannot hold nan"),
    ("steps", math.inf, "`steps` (int) cannot hold inf"),
    ("steps", True, "`steps` (int) cannot hold True"),
    (
        "steps",
        2**31,
        "`steps` is a 32-bit int, -2147483648 to 2147483647: 2147483648 is not",
    ),
    ("big", -1, "`big` is a 32-bit uint, 0 to 4294967295: -1 is not"),
    ("shiny", 0.5, "`shiny` (bool) cannot hold 0.5"),
    ("shiny", 2, "`shiny` (bool) cannot hold 2"),
    ("values", math.nan, "`values` takes finite numbers, and nan is none"),
    ("values", np.float32(-np.inf), "`values` takes finite numbers, and -inf is none"),
    ("values", 3.5e38, "`values` is a float32, and 3.5e+38 is too large for it"),
    ("values", 10**400, f"`values` is a float32, and {str(10**400)[:37]}... is too large for it"),
    (
        "wind",
        (1, 1, 0),
        "`wind` is a direction and has to be of length 1, not 1.41421: that would be "
        "(0.707107, 0.707107, 0)",
    ),
    (
        "floor",
        (0, 0, 2),
        "`floor` is a normal and has to be of length 1, not 2: that would be (0, 0, 1)",
    ),
    ("wind", (0, 0, 0), "`wind` is a direction and has to be of length 1, not 0"),
    (
        "ways[1]",
        (2, 0, 0),
        "`ways[1]` is a direction and has to be of length 1, not 2: that would be (1, 0, 0)",
    ),
    (
        "albedo",
        np.zeros((2, 2)),
        "`albedo` takes a Texture, and was given a value of type ndarray",
    ),
]


@pytest.mark.parametrize(("name", "value", "message"), REFUSED, ids=lambda value: str(value)[:20])
def test_what_breaks_a_contract_is_refused(
    instance: Instance, name: str, value: object, message: str
) -> None:
    before = state(complete(instance))
    with pytest.raises(ParameterError) as caught:
        instance.set(name, value)
    assert str(caught.value) == message
    assert state(instance) == before


def test_the_error_names_the_part(instance: Instance) -> None:
    with pytest.raises(ParameterError) as caught:
        instance.set("layer", {"tint": (0, 0, 0), "cone": {"width": math.inf}})
    assert caught.value.name == "layer.cone.width"
    assert instance.get("layer.tint") is None


def test_of_a_mapping_all_or_nothing_is_set(instance: Instance) -> None:
    before = state(instance)
    with pytest.raises(ParameterError):
        instance.set("torch", {"place": (1, 1, 1), "axis": (1, 1, 1)})
    with pytest.raises(ParameterError):
        instance.set("lamps", [{"place": (1, 1, 1)}, {"place": (1, 1)}])
    assert state(instance) == before


BULBS = """
import std.lights.{Point}
import std.terms.{lambert}
light Bulb : Point {
    param reach : float in 0.5..100 = 8
    param way   : direction<world> = vec3(1, 0, 0)
    falloff = reach * way.x
}
material M { color = lambert(vec3(1)) }
rig R { hall : Bulb[<= 2]  door : Bulb }
"""


def test_the_members_of_lights_have_contracts_too() -> None:
    instance = burnish.compile(BULBS, ("wgsl",))["M"].instance()
    for name in ("hall[1]", "door"):
        with pytest.raises(ParameterError) as caught:
            instance.set(f"{name}.reach", 0)
        assert str(caught.value) == f"`{name}.reach` is declared in 0.5..100: 0 is not"
        with pytest.raises(ParameterError) as caught:
            instance.set(name, {"way": (0, 2, 0)})
        assert str(caught.value).startswith(f"`{name}.way` is a direction and has to be of length")
        instance.set(name, {"way": (0, 1, 0), "reach": 0.5})


def test_a_derived_value_cannot_be_set() -> None:
    source = "material M { param tilt : angle  slope = cos(tilt)  color = vec3(uv.x * slope) }"
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    with pytest.raises(ParameterError) as caught:
        instance.set("slope", 1)
    assert str(caught.value) == "`slope` is not set but derived, from `tilt`"


def test_another_format_is_refused() -> None:
    document = to_json(REFLECTION)
    assert Instance(document).reflection == REFLECTION
    with pytest.raises(ValueError) as caught:
        Instance({**document, "format": 1})
    assert str(caught.value) == (
        "/format: this is version 1, and Burnish reads version 3: compile the source again"
    )
    with pytest.raises(ValueError, match=r"^/: there is no `format`\n/: there is no `material`\n"):
        Instance({})
