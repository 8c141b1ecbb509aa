"""Plans and reflections that follow their schemas, and would take all memory, or never end."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from ..fuzz.hostile.plans import Received, outcome, received

Change = Callable[[dict[str, Any], dict[str, Any]], object]

CONSTANT = {"op": "constant", "type": "float", "args": [], "value": 1.5}


def number(steps: list[dict[str, Any]]) -> Change:
    """The size of the first textures is computed by other steps."""

    def change(plan: dict[str, Any], _shader: dict[str, Any]) -> None:
        plan["values"][plan["textures"][0]["size"]["value"]]["steps"] = steps

    return change


def doubled(op: str, type_: str, times: int) -> list[dict[str, Any]]:
    """Steps of which each consists twice of the one before."""
    steps = [{"op": op, "type": type_, "args": [each, each]} for each in range(times)]
    return [CONSTANT, *steps, {"op": "vector", "type": "ivec2", "args": [times]}]


def folds(depth: int) -> list[dict[str, Any]]:
    """Sums in sums."""
    whole = {"op": "constant", "type": "int", "args": []}
    variable = {"op": "bound", "type": "int", "args": [], "binder": depth - 1}
    steps: list[dict[str, Any]] = [{**whole, "value": 60_000}, {**whole, "value": 0}, variable]
    for inner in range(2, depth + 2):
        row = {"op": "fold", "type": "int", "operator": "add", "bound": 60_000}
        steps.append({**row, "args": [0, 1, inner]})
    last = len(steps) - 1
    return [*steps, {"op": "vector", "type": "ivec2", "args": [last, last]}]


def powers(times: int) -> list[dict[str, Any]]:
    """Products of whole numbers that are called floats, each the square of the last."""
    first = {"op": "constant", "type": "float", "args": [], "value": 2**50}
    row = {"op": "call", "type": "float", "function": "mul"}
    steps = [{**row, "args": [each, each]} for each in range(times)]
    return [first, *steps, {"op": "splat", "type": "ivec2", "args": [times]}]


def count_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    row = next(row for row in shader["parameters"] if row["block"] is not None)
    row["layout"] |= {"count": 2**50, "stride": 0}


def block_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["blocks"][0]["size"] = 2**44


def parameter_of(plan: dict[str, Any], _shader: dict[str, Any]) -> None:
    row = plan["parameters"][0]
    row["layout"] |= {"count": 2**28, "stride": 16}
    row["size"] = 2**32


def levels_of(plan: dict[str, Any], _shader: dict[str, Any]) -> None:
    plan["textures"][0]["levels"] = 2**40


def layers_of(plan: dict[str, Any], _shader: dict[str, Any]) -> None:
    plan["textures"][0] |= {"dimension": "2d-array", "layers": 2**40}


def sampler_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["samplers"][0]["state"]["wrap"] = "mirrored"


def size_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["blocks"][0]["size"] = 10**8


def padding_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    block = shader["blocks"][0]
    row = {"name": "pad_9", "type": "vec4", "offset": block["size"], "size": 10**8}
    block["members"].append({**row, "parameter": None})
    block["size"] += 10**8


def member_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["blocks"][0]["members"][1]["offset"] = 10**8


def value_of(plan: dict[str, Any], _shader: dict[str, Any]) -> None:
    plan["parameters"][0]["size"] = 10**7


def target_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["targets"][0]["location"] = 10**9


def vertices_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["draw"] |= {"vertices": 3 * 10**9, "expanded_by": "instances"}


def binding_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    (backend,) = shader["backends"].values()
    next(iter(backend["blocks"].values()))["binding"] = 10**9


def input_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["vertex_inputs"][0]["location"] = 10**9


def input_twice(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    one, other, *_ = shader["vertex_inputs"]
    one["location"] = other["location"]


def captured(stride: int, buffer: str | None = None) -> Change:
    """The shader captures one number of each vertex."""

    def change(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
        row = {"name": "at", "type": "float", "representation": "float", "offset": 0, "doc": ""}
        capture = {"topology": "point-list", "vertices": 1, "buffer": buffer, "there": None}
        shader["capture"] = {**capture, "members": [row], "stride": stride}

    return change


def captured_far_apart(plan: dict[str, Any], shader: dict[str, Any]) -> None:
    """A kernel captures, and its vertices have a gap of 10⁹ bytes between them."""
    captured(4, "captured")(plan, shader)
    written = {"name": "captured", "type": "uint[]", "representation": "uint[]", "group": "draw"}
    layout = {"stored": "uint", "kind": "uint", "lanes": 1}
    lists: dict[str, Any] = {"members": [], "structs": []}
    joined = {"scattered": None, "initial": None}
    count = [{"op": "constant", "type": "int", "args": [], "value": 3}]
    shader["results"] = [
        {**written, **lists, **joined, "stride": 10**9, "layout": layout, "doc": "", "count": count}
    ]
    place = {"identifier": "captured", "group": 0, "binding": 9, "register": "u9"}
    for backend in shader["backends"].values():
        backend["buffers"]["captured"] = place


def group_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["work_group"] = [10**9, 1, 1]


def entry_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    (backend,) = shader["backends"].values()
    backend["files"][0]["entry_point"] = "--help"


def default_of(_plan: dict[str, Any], shader: dict[str, Any]) -> None:
    shader["textures"][0]["default"] = "checkered"


HOSTILE: dict[str, tuple[Change, str]] = {
    "more and more lanes": (
        number(doubled("vector", "float", 60)), "Shadows, value 2: its steps cannot be computed"
    ),
    "sums in sums": (
        number(folds(4)), "a frame of Shadows takes 4,000,001 steps, and the limit is 4,000,000 "
        "steps: `--budget steps=4001k` raises it"
    ),
    "powers of powers": (
        number(powers(200)), "Shadows, value 2: its steps compute no ivec2"
    ),
    "many elements without bytes": (
        count_of, "Shadows.Shadowed.Clay, from_lamp: 1125899906842624 elements do not lie every 0 "
        "bytes"
    ),
    "a large block": (
        block_of, "Shadows.Shadowed.Clay: its blocks take 17,592 GB, and the limit is 1 GB: "
        "`--budget memory=17593G` raises it"
    ),
    "a large parameter": (
        parameter_of, "Shadows: the values of its parameters take 68.7 GB, and the limit is 1 GB: "
        "`--budget memory=69G` raises it"
    ),
    "many levels": (
        levels_of, "Shadows, texture 0: no texture has 1099511627776 levels"
    ),
    "many layers": (
        layers_of, "Shadows, texture 0: 2d_array does not have 1099511627776 layers"
    ),
    "no word of samplers": (
        sampler_of, "`Shadows.Shadowed.Clay.json` is no reflection that can be read:\n"
        '  /samplers/0/state/wrap: "mirrored" is not "repeat", "clamp-to-edge", "mirror-repeat" or '
        '"clamp-to-border"'
    ),
    "a block of other bytes than its members": (
        size_of, "Shadows.Shadowed.Clay, Frame: its members have 80 bytes, and it has 100000000"
    ),
    "a block of padding": (
        padding_of, "Shadows.Shadowed.Clay, Frame.pad_9: no padding has 100000000 bytes: the "
        "most are 65536"
    ),
    "a member behind the block": (
        member_of, "Shadows.Shadowed.Clay, Frame.spread: it is at byte 100000000, and not at 64"
    ),
    "a value of other bytes than its lanes": (
        value_of, "Shadows, size: its value has 8 bytes, and not 10000000"
    ),
    "a target far behind": (
        target_of, "Shadows.Shadowed.Clay, color: it is target 0, and not 1000000000"
    ),
    "a primitive of many vertices": (
        vertices_of, "Shadows.Shadowed.Clay: what one primitive turns into has 3,000,000,000 "
        "vertices, and the limit is 4,000,000 vertices: `--budget vertices=3000M` raises it"
    ),
    "a binding far behind": (
        binding_of, "Shadows.Shadowed.Clay, glsl:vulkan: no binding has the number 1000000000, as "
        "the block `Frame`"
    ),
    "a vertex input far behind": (
        input_of, "Shadows.Shadowed.Clay, vertex_position: it has the location 1000000000, and "
        "the last is 31"
    ),
    "two vertex inputs in one place": (
        input_twice, "Shadows.Shadowed.Clay, vertex_normal: another vertex input has the location 1"
    ),
    "a vertex that is captured with a gap": (
        captured(10**9),
        "Shadows.Shadowed.Clay, capture: its values have 4 bytes, and not 1000000000"
    ),
    "vertices that nothing captures": (
        captured(4, "captured"), "Shadows.Shadowed.Clay, capture: no kernel writes `captured`"
    ),
    "vertices that are captured far apart": (
        captured_far_apart,
        "Shadows.Shadowed.Clay, captured: its vertices have 4 bytes, and not 1000000000"
    ),
    "a large work group": (
        group_of, "Shadows.Shadowed.Clay, work_group: no device runs 1000000000 x 1 x 1 "
        "invocations together"
    ),
    "an option as entry point": (
        entry_of, "Shadows.Shadowed.Clay, glsl:vulkan: `--help` is no name of an entry point"
    ),
    "a default of another kind": (
        default_of, "Shadows.Shadowed.Clay, shadow: nothing depth is called `checkered`"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_documents_are_refused_at_once(tmp_path: Path, name: str) -> None:
    change, wanted = HOSTILE[name]
    whole = deepcopy(received("shadows"))
    shader = next(each for each in whole.reflections.values() if each["samplers"])
    change(whole.plan, shader)
    said = outcome(Received(whole.plan, whole.reflections, whole.texts).write(tmp_path))
    assert said == wanted
