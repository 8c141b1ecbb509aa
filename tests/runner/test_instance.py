"""Named values of an instance: what can be set, and how it is stored, read and written as bytes."""

from __future__ import annotations

import copy
import json
import math
import struct
import sys

import numpy as np
import pytest

import burnish
from burnish import Instance, ParameterError
from burnish.compiler.documents.writing import to_json

from ..suite.processes import run
from .instance_kit import REFLECTION, at, complete, state

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


def test_usual_names_of_parameters_are_no_methods() -> None:
    text = """material M {
        param size : float = 1
        param levels : float = 2
        param counts : int = 3
        color = vec3(size, levels, float(counts))
    }"""
    (material,) = burnish.compile(text, "wgsl").materials
    instance = material.instance()
    assert (instance.size, instance.levels, instance.counts) == (1.0, 2.0, 3)


def test_a_copy_is_another_instance(instance: Instance) -> None:
    other = copy.deepcopy(instance)
    other.power = 2
    assert (instance.power, other.power) == (48.0, 2.0)


# --- bytes and values ----------------------------------------------------------------------------


def test_values_have_the_reference_evaluators_form(instance: Instance) -> None:
    values = complete(instance).values()
    assert values["power"] == (48.0,)
    assert values["turn"] == ((1.0, 0.0), (0.0, 1.0))
    assert values["layer"] == ((1.0, 2.0, 3.0), ((0.25,), (False,)), ((4.0,), (5.0,), (6.0,)))
    assert values["lamps.count"] == (0,)
    zero = (0.0, 0.0, 0.0)
    assert values["lamps"] == (((1.0,) * 3, (1.0,) * 3, zero),) * 3
    assert list(values) == [row.name for row in REFLECTION.parameters]


def test_bytes_lie_where_the_reflection_says(instance: Instance) -> None:
    blocks = complete(instance).blocks()
    assert {name: len(data) for name, data in blocks.items()} == {
        row.name: row.size for row in REFLECTION.blocks
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
    read = Instance(json.loads(json.dumps(to_json(REFLECTION))))
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
    run([sys.executable, "-c", LEAN], text=json.dumps(to_json(reflection)), check=True)


def test_a_light_is_found_in_its_rig_whatever_the_material_calls_so() -> None:
    text = "material Sky { param sun : direction<world> = vec3(0, 1, 0)  color = matt(sun) }\n"
    term = "term matt(v: vec3) per light = light.diffuse * dot(v, light.to_light)\n"
    instance = burnish.compile(text + term, "wgsl")["Sky"].instance()
    instance.rig.sun.direction = (1, 0, 0)
    assert instance.get("Daylight.sun.direction") == (1.0, 0.0, 0.0)
    assert instance.sun == (0.0, 1.0, 0.0)
    instance.rig.sun = {"direction": (0, 0, 1)}
    assert instance.get("Daylight.sun.direction") == (0.0, 0.0, 1.0)
