"""Named values: what can be set, what is refused with which words, and what is still missing."""

from __future__ import annotations

import copy
import json
import math
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish import Instance, MissingValuesError, ParameterError
from burnish.compiler.reflection.reflect import FORMAT as WRITTEN_FORMAT
from burnish.targets.runner.instances.instance import FORMAT

EVERYTHING = """
import std.lights.{Point, Spot}
import std.terms.{lambert}

struct Cone { width : float  soft : bool }
struct Layer { tint : vec3  cone : Cone  weights : float[3] }

material All {
    param power  : float in 1..512 = 48               /// Specular exponent
    param base   : rgb = #b5651d
    param veil   : rgba = #00000080
    param tilt   : angle = 30deg
    param offset : ivec2 in -3..3 = ivec2(0)
    param tag    : uint in 0..7 = 3u
    param big    : uint = 0u
    param steps  : int = 0
    param shiny  : bool = true
    param mask   : bvec2 = bvec2(true, false)
    param turn   : mat2                               /// Turns the texture
    param bones  : mat3[2]
    param ways   : direction<world>[2]
    param layer  : Layer
    param values : float = 2
    param wind   : direction<world> = vec3(1, 0, 0)
    param floor  : normal<world> = vec3(0, 1, 0)
    map   albedo : texture2d = gray

    color = lambert(base) * power * cos(tilt) + veil.rgb * layer.tint * layer.weights[1]
          + vec3(turn * uv, values) + bones[1] * ways[0] * wind.x * floor.y
          + (if shiny and layer.cone.soft and mask.x then vec3(float(offset.x)) else albedo(uv).rgb)
          + vec3(float(big), float(steps) + float(tag), layer.cone.width)
}

rig Stage {
    lamps : Point[<= 3]
    torch : Spot
    pair  : Point[2]
}
"""
REFLECTION = burnish.compile(EVERYTHING, ("wgsl",))["All"].reflection


@pytest.fixture
def instance() -> Instance:
    return Instance(REFLECTION)


def complete(instance: Instance) -> Instance:
    """The instance with a value for everything that has no default."""
    instance.set("turn", ((1, 0), (0, 1)))
    instance.set("bones", [np.eye(3), np.eye(3)])
    instance.set("ways", [(1, 0, 0), (0, 1, 0)])
    cone = {"width": 0.25, "soft": False}
    instance.set("layer", {"tint": (1, 2, 3), "cone": cone, "weights": (4, 5, 6)})
    instance.set("torch.place", (0, 0, 1))
    instance.set("pair", [{"place": (0, 0, 2)}, {"place": (0, 0, 3)}])
    return instance


def state(instance: Instance) -> dict[str, Any]:
    return {row["name"]: instance.get(row["name"]) for row in REFLECTION["parameters"]}


def at(name: str) -> tuple[str, int]:
    """Block and offset of a parameter."""
    (row,) = (row for row in REFLECTION["parameters"] if row["name"] == name)
    return row["block"], row["offset"]


# --- values --------------------------------------------------------------------------------------


def test_defaults_are_there_from_the_start(instance: Instance) -> None:
    assert instance.get("power") == 48.0
    assert instance.get("shiny") is True
    assert instance.get("offset") == (0, 0)
    assert instance.get("layer") == {
        "tint": None,
        "cone": {"width": None, "soft": None},
        "weights": (None, None, None),
    }
    assert instance.get("lamps.count") == 0
    assert instance.get("albedo") is None


@pytest.mark.parametrize(
    ("name", "given", "stored"),
    [
        ("power", 32, 32.0),
        ("power", np.float32(32.5), 32.5),
        ("power", np.array(7), 7.0),
        ("values", 0.1, 0.10000000149011612),
        ("values", "2", None),
        ("values", 1e-45, 1.401298464324817e-45),
        ("base", [1, 0.5, 0], (1.0, 0.5, 0.0)),
        ("base", np.array([1, 0.5, 0]), (1.0, 0.5, 0.0)),
        ("base", [np.float64(1), np.int8(2), 3], (1.0, 2.0, 3.0)),
        ("base", "#fff", (1.0, 1.0, 1.0)),
        ("base", "#808080", (0.21586050093173980713,) * 3),
        ("veil", "#ffffff80", (1.0, 1.0, 1.0, 0.5019607843137255)),
        ("veil", "#ffffff", (1.0, 1.0, 1.0, 1.0)),
        ("tilt", "180deg", math.pi),
        ("tilt", "0.5rad", 0.5),
        ("offset", (-3, 3.0), (-3, 3)),
        ("offset", np.array([1, 2], np.int64), (1, 2)),
        ("tag", np.uint8(7), 7),
        ("big", 2**32 - 1, 2**32 - 1),
        ("steps", -(2**31), -(2**31)),
        ("shiny", np.bool_(False), False),
        ("shiny", 0, False),
        ("mask", [False, 1], (False, True)),
        ("turn", [[1, 2], [3, 4]], ((1.0, 2.0), (3.0, 4.0))),
        ("turn", [1, 2, 3, 4], ((1.0, 2.0), (3.0, 4.0))),
        ("turn", np.array([[1, 2], [3, 4]]), ((1.0, 2.0), (3.0, 4.0))),
        ("layer.weights", range(3), (0.0, 1.0, 2.0)),
        ("layer.weights[2]", 9, 9.0),
        ("layer.cone.soft", True, True),
        ("lamps[2].place", (1, 2, 3), (1.0, 2.0, 3.0)),
        ("wind", (0, 0.9995, 0), (0.0, 1.0, 0.0)),
        ("wind", (0.6, 0, 0.8), (0.6000000238418579, 0.0, 0.800000011920929)),
    ],
)
def test_what_is_set_is_stored_as_the_gpu_sees_it(
    instance: Instance, name: str, given: object, stored: object
) -> None:
    if stored is None:
        with pytest.raises(ParameterError):
            instance.set(name, given)
        return
    instance.set(name, given)
    found = instance.get(name)
    assert found == pytest.approx(stored, rel=1e-7) if _floats(stored) else found == stored
    before = state(instance)
    instance.set(name, found)
    assert state(instance) == before


def _floats(value: object) -> bool:
    flat = value if isinstance(value, tuple) else (value,)
    return all(isinstance(lane, float) for lane in flat)


def test_a_bound_that_float32_cannot_hold_belongs_to_the_range() -> None:
    source = "material M { param a : float in 0.7..1.1 = 0.7  color = vec3(a) }"
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    for bound in (0.7, 1.1):
        instance.set("a", bound)
        instance.set("a", instance.get("a"))
    with pytest.raises(ParameterError):
        instance.set("a", 0.6999)


def test_parts_keep_what_is_not_named(instance: Instance) -> None:
    complete(instance).set("layer", {"cone": {"width": 0.5}})
    assert instance.get("layer.cone") == {"width": 0.5, "soft": False}
    assert instance.get("layer.tint") == (1.0, 2.0, 3.0)


def test_a_list_of_lights_sets_their_count(instance: Instance) -> None:
    instance.set("lamps", [{"place": (0, 2, 1)}, {"place": (1, 2, 1), "diffuse_color": "#fff"}])
    assert instance.get("lamps.count") == 2
    assert instance.get("lamps[1].place") == (1.0, 2.0, 1.0)
    instance.set("lamps", [])
    assert instance.get("lamps.count") == 0
    assert instance.get("lamps[1].place") == (1.0, 2.0, 1.0)


def test_a_light_can_be_set_at_once(instance: Instance) -> None:
    instance.set("torch", {"place": (0, 1, 0), "axis": (0, 0, 1)})
    assert instance.get("torch.axis") == (0.0, 0.0, 1.0)
    assert instance.get("torch")["place"] == (0.0, 1.0, 0.0)


# --- attributes ----------------------------------------------------------------------------------


def test_parameters_are_attributes(instance: Instance) -> None:
    instance.power = 32
    instance.torch.axis = (0, 0, -1)
    instance.rig.torch.outer = "40deg"
    instance.lamps[1].place = (0, 2, 1)
    instance.rig.lamps.count = 2
    instance.layer.cone.width = 3
    instance.layer.weights[1] = 7
    instance.rig.pair = [{}, {"place": (5, 5, 5)}]
    assert (instance.power, instance.torch.axis) == (32.0, (0.0, 0.0, -1.0))
    assert instance.torch.outer == pytest.approx(math.radians(40))
    assert instance.rig.lamps[1].place == (0.0, 2.0, 1.0)
    assert (instance.lamps.count, len(instance.lamps)) == (2, 3)
    assert [lamp.place for lamp in instance.pair] == [None, (5.0, 5.0, 5.0)]
    assert instance.layer.cone.width == 3.0
    assert list(instance.layer.weights) == [None, 7.0, None]
    assert repr(instance.layer.weights) == "<layer.weights: (None, 7.0, None)>"


def test_attributes_that_are_none(instance: Instance) -> None:
    with pytest.raises(AttributeError, match="there is no parameter `powr`: did you mean `power`"):
        _ = instance.powr
    with pytest.raises(AttributeError, match=r"`layer` has no member `tin`: did you mean `tint`"):
        _ = instance.layer.tin
    with pytest.raises(AttributeError, match="the rig has no `power`: there are ambient_light, "):
        _ = instance.rig.power
    with pytest.raises(ParameterError, match="the rig has no `torhc`: did you mean `torch`"):
        instance.rig.torhc = {}
    with pytest.raises(TypeError, match="`layer` is no array"):
        len(instance.layer)
    assert not hasattr(instance, "nothing")
    for part in (instance, instance.layer, instance.rig):
        assert not hasattr(part, "__array__")


def test_a_parameter_named_like_a_method_is_set_by_name(instance: Instance) -> None:
    with pytest.raises(AttributeError, match=r"every instance has `values`: write set\('values'"):
        setattr(instance, "values", 3)  # noqa: B010
    instance.set("values", 3)
    assert instance.get("values") == 3.0


def test_a_copy_is_another_instance(instance: Instance) -> None:
    other = copy.deepcopy(instance)
    other.power = 2
    assert (instance.power, other.power) == (48.0, 2.0)


# --- contracts -----------------------------------------------------------------------------------

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
    ("base", "red", "`base` (rgb) cannot hold 'red'"),
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
    with pytest.raises(ValueError, match="this is no reflection of format 1"):
        Instance({**REFLECTION, "format": 2})
    with pytest.raises(ValueError, match="this is no reflection of format 1"):
        Instance({})
    assert FORMAT == WRITTEN_FORMAT


# --- what is missing -----------------------------------------------------------------------------


def test_all_that_is_missing_is_named(instance: Instance) -> None:
    with pytest.raises(MissingValuesError) as caught:
        instance.blocks()
    assert str(caught.value) == (
        "All needs values for\n"
        "  `turn` : mat2   Turns the texture\n"
        "  `bones` : mat3[2]\n"
        "  `ways` : direction<world>[2]\n"
        "  `layer.tint` : vec3\n"
        "  `layer.cone.width` : float\n"
        "  `layer.cone.soft` : bool\n"
        "  `layer.weights` : float[3]\n"
        "  `torch.place` : point<world>\n"
        "  `pair[0].place` : point<world>\n"
        "  `pair[1].place` : point<world>"
    )
    assert caught.value.names == instance.missing
    with pytest.raises(MissingValuesError):
        instance.values()
    assert not complete(instance).missing


def test_of_an_array_what_is_left_is_named(instance: Instance) -> None:
    complete(instance)
    instance = Instance(REFLECTION)
    instance.set("layer.weights[1]", 1)
    assert {"layer.weights[0]", "layer.weights[2]"} <= set(instance.missing)


def test_only_lights_that_shine_need_values(instance: Instance) -> None:
    complete(instance).set("lamps.count", 2)
    assert instance.missing == ("lamps[0].place", "lamps[1].place")
    instance.set("lamps[0].place", (0, 0, 0))
    assert list(instance.missing) == ["lamps[1].place"]
    instance.set("lamps.count", 1)
    assert not instance.missing


def test_what_nothing_reads_is_not_missed() -> None:
    source = "material M { param a : vec2 per frame  param b : float per frame  color = vec3(0) }"
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    instance.set("b", 3)
    assert (instance.values()["a"], instance.values()["b"]) == ((0.0, 0.0), (3.0,))
    assert "Frame" not in instance.blocks()


def test_what_only_a_derived_value_reads_is_missed() -> None:
    source = "material M { param a : float  color = vec3(uv.x * cos(a)) }"
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    assert instance.missing == ("a",)
    instance.set("a", 0.5)
    blocks = instance.blocks()
    assert "Material" not in blocks
    assert struct.unpack_from("<f", blocks["MaterialDerived"]) == (np.float32(np.cos(0.5)),)


def test_of_counted_lights_those_that_do_not_shine_are_harmless() -> None:
    source = (
        "import std.lights.{Spot}\nimport std.terms.{lambert}\n"
        "material M { color = lambert(vec3(1)) }\nrig R { spots : Spot[<= 3] }"
    )
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    instance.spots = [{"place": (0, 1, 0), "inner": "20deg", "outer": "60deg"}]
    (row,) = [r for r in instance.reflection["derived"] if r["name"].endswith("falloff_cos")]
    block = instance.blocks()[row["block"]]
    offsets = [row["offset"] + i * row["layout"]["stride"] for i in range(row["layout"]["count"])]
    cosines = [struct.unpack_from("<f", block, offset)[0] for offset in offsets]
    assert cosines == pytest.approx([0.5, np.cos(np.pi / 6), np.cos(np.pi / 6)])
    with pytest.raises(ParameterError, match=r"is not set but derived, from `spots`"):
        instance.set("spots_derived.falloff_cos", 0.5)


# --- bytes and values ----------------------------------------------------------------------------


def test_values_have_the_reference_evaluators_form(instance: Instance) -> None:
    values = complete(instance).values()
    assert values["power"] == (48.0,)
    assert values["turn"] == ((1.0, 0.0), (0.0, 1.0))
    assert values["layer"] == ((1.0, 2.0, 3.0), ((0.25,), (False,)), ((4.0,), (5.0,), (6.0,)))
    assert values["lamps.count"] == (0,)
    zero = (0.0, 0.0, 0.0)
    assert values["lamps"] == (((1.0,) * 3, (1.0,) * 3, zero),) * 3
    assert list(values) == [row["name"] for row in REFLECTION["parameters"]]


def test_bytes_lie_where_the_reflection_says(instance: Instance) -> None:
    blocks = complete(instance).blocks()
    assert {name: len(data) for name, data in blocks.items()} == {
        row["name"]: row["size"] for row in REFLECTION["blocks"]
    }
    for name, code, expected in (
        ("power", "<f", (48.0,)),
        ("tag", "<I", (3,)),
        ("shiny", "<I", (1,)),
        ("mask", "<2I", (1, 0)),
        ("turn", "<8f", (1, 0, 0, 0, 0, 1, 0, 0)),
    ):
        block, offset = at(name)
        assert struct.unpack_from(code, blocks[block], offset) == expected, name


def test_a_reflection_from_a_file_serves_as_well(instance: Instance) -> None:
    read = Instance(json.loads(json.dumps(REFLECTION)))
    assert complete(read).blocks() == complete(instance).blocks()


LEAN = """
import json, sys
from burnish.targets.runner.instances.instance import Instance
Instance(json.loads(sys.stdin.read())).blocks()
for name in ("numpy", "PIL", "lark", "burnish.compiler.semantics"):
    assert name not in sys.modules, name
"""


def test_blocks_need_neither_numpy_nor_the_compiler() -> None:
    source = "material M { param a : float = 1  color = vec3(uv.x * cos(a)) }"
    reflection = burnish.compile(source, ("wgsl",))["M"].reflection
    subprocess.run(
        [sys.executable, "-c", LEAN],
        input=json.dumps(reflection),
        text=True,
        check=True,
        timeout=60,
    )


# --- texts ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("power", "32", 32.0),
        ("power", " 3.2e1 ", 32.0),
        ("base", "1,0.5,0", (1.0, 0.5, 0.0)),
        ("base", "(1, 0.5, 0)", (1.0, 0.5, 0.0)),
        ("base", "1 0.5 0", (1.0, 0.5, 0.0)),
        ("base", "#ffffff", (1.0, 1.0, 1.0)),
        ("tilt", "180deg", 3.1415927410125732),
        ("offset", "-1,2", (-1, 2)),
        ("shiny", "false", False),
        ("mask", "1,true", (True, True)),
        ("turn", "1,2,3,4", ((1.0, 2.0), (3.0, 4.0))),
        ("ways", "1,0,0, 0,1,0", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))),
        ("layer.weights", "1,2,3", (1.0, 2.0, 3.0)),
        ("lamps.count", "2", 2),
        ("lamps[0].place", "0,2,1", (0.0, 2.0, 1.0)),
    ],
)
def test_texts_mean_values(instance: Instance, name: str, text: str, value: object) -> None:
    instance.set_text(name, text)
    assert instance.get(name) == value


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("power", "", "`power` (float) cannot hold ''"),
        ("power", "much", "`power` (float) cannot hold 'much'"),
        ("power", "nan", "`power` takes finite numbers, and nan is none"),
        ("power", "1,2", "`power` takes one number (float), and was given a list of 2"),
        ("base", "1,2", "`base` takes 3 numbers (rgb), and was given a list of 2"),
        ("base", "1,2,x", "`base` (rgb) cannot hold 'x'"),
        ("steps", "1.5", "`steps` (int) cannot hold '1.5'"),
        ("shiny", "yes", "`shiny` (bool) cannot hold 'yes'"),
        ("layer.weights", "1,2", "`layer.weights` (float[3]) takes 3 numbers, not 2"),
        ("layer", "1,2", "`layer` (Layer) is set by its parts, each by its name"),
        ("lamps", "1,2", "`lamps` (Point[3]) is set by its parts, each by its name"),
        ("powr", "1", "there is no parameter `powr`: did you mean `power`?"),
        (
            "torch",
            "1",
            "`torch` is a light, whose parameters are `torch.diffuse_color`, "
            "`torch.specular_color`, `torch.place`, `torch.axis`, `torch.inner`, `torch.outer`",
        ),
    ],
)
def test_texts_that_mean_nothing(instance: Instance, name: str, text: str, message: str) -> None:
    with pytest.raises(ParameterError) as caught:
        instance.set_text(name, text)
    assert str(caught.value) == message


def test_a_text_for_a_texture_is_a_picture_or_a_colour(instance: Instance, tmp_path: Path) -> None:
    instance.set_text("albedo", "#b5651d")
    assert instance.textures()["albedo"] == burnish.Texture.solid("#b5651d")
    with pytest.raises(burnish.PictureError, match="No such file or directory"):
        instance.set_text("albedo", str(tmp_path / "none.png"))
    assert instance.albedo == burnish.Texture.solid("#b5651d")
