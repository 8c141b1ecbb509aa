"""The names of the values that an instance still needs before it can be drawn."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import burnish
from burnish import Instance, MissingValuesError, ParameterError

from .instance_kit import REFLECTION, complete


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
        "  `torch.place` : point<world>   On no surface that is drawn\n"
        "  `pair[0].place` : point<world>   On no surface that is drawn\n"
        "  `pair[1].place` : point<world>   On no surface that is drawn"
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
    (row,) = [r for r in instance.reflection.derived if r.name.endswith("falloff_cos")]
    first, stride, count = row.offset, row.layout.stride, row.layout.count
    assert row.block is not None and first is not None and stride is not None and count is not None
    block = instance.blocks()[row.block]
    offsets = [first + i * stride for i in range(count)]
    cosines = [struct.unpack_from("<f", block, offset)[0] for offset in offsets]
    assert cosines == pytest.approx([0.5, np.cos(np.pi / 6), np.cos(np.pi / 6)])
    with pytest.raises(ParameterError, match=r"is not set but derived, from `spots`"):
        instance.set("spots_derived.falloff_cos", 0.5)
