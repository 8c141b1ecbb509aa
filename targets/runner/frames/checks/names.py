"""Checks that every name and number of a plan stands for something, and only for one thing."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .....compiler.ir.host import KNOWN_TO_HOST
from ...binding import FORMATS
from .rows import Row, attachments, drawn_to, fail, inputs, places_of_waiting, step_name, uses

DEPTH_FORMATS = ("depth32f", "depth32f_stencil8")
STENCILS = "stencil8"
"""What formats of depths end with that have stencil values."""
SETTINGS = {"viewport": "ivec4", "scissor": "ivec4", "blend_constant": "vec4"}
"""The types of what a step that draws sets for all of it."""
MOST_TERMS = 1 << 16
"""Of a sum that a host computes."""
LAYERS = {"2d": range(1, 2), "cube": range(6, 7)}
"""How many layers textures of a dimension have; any number where none is said."""


def check_names(plan: Row) -> None:
    """Raise ``PlanError`` for a row that names what is not there, or what cannot be meant."""
    _check_unique(plan)
    for row in plan["shaders"]:
        if row["rig"] not in (None, plan["rig"]):
            fail(plan, row["name"], f"it is drawn under `{row['rig']}`, and not `{plan['rig']}`")
    for number, value in enumerate(plan["values"]):
        _check_value(plan, f"value {number}", value)
    for number, texture in enumerate(plan["textures"]):
        _check_texture(plan, f"texture {number}", texture)
    for where, place in places_of_waiting(plan):
        _check_barriers(plan, where, place)
    for step in plan["steps"]:
        _check_step(plan, step)
    for row in plan["kept"]:
        _check_kept(plan, row)
    for row in plan["outputs"]:
        _one_of(plan, f"output {row['name']}", "result", row["result"], _results(plan))
        _texture(plan, f"output {row['name']}", row["texture"])


def _check_unique(plan: Row) -> None:
    named = {
        "shaders": "name", "models": "name", "parameters": "name", "lights": "name",
        "host_textures": "name", "host_buffers": "name", "results": "name", "outputs": "name",
        "kept": "result",
    }  # fmt: skip
    for table, key in named.items():
        _no_two(plan, table, [row[key] for row in plan[table]])
    _no_two(plan, "steps", [step["name"] for step in plan["steps"] if "name" in step])
    set_by_host = [*plan["parameters"], *plan["host_textures"], *plan["host_buffers"]]
    for row in set_by_host:
        _one_of(plan, "sources", "declaration", row["name"], plan["sources"])
    for name in plan["sources"]:
        _one_of(plan, "sources", "value of the host", name, [row["name"] for row in set_by_host])
    for row in plan["results"]:
        if row["kind"] == "buffer" and row["texture"] is not None:
            fail(plan, row["name"], "a buffer is in no texture")
        number = _texture(plan, row["name"], row["texture"])
        if number >= 0 and plan["textures"][number]["samples"] > 1:
            fail(plan, row["name"], f"nobody can read the samples of texture {number}")


def _no_two(plan: Row, table: str, names: Iterable[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            fail(plan, table, f"there are two of the name `{name}`")
        seen.add(name)


# --- values and textures -------------------------------------------------------------------------


def _check_value(plan: Row, where: str, value: Row) -> None:
    """The steps of a number: known operations on what stands before them."""
    steps = value["steps"]
    parameters = {row["name"]: row["representation"] for row in plan["parameters"]}
    textures = [row["name"] for row in plan["host_textures"]]
    for number, step in enumerate(steps):
        op, type_, args = step["op"], step["type"], step["args"]
        _one_of(plan, where, "operation", op, KNOWN_TO_HOST)
        if step.get("bound", 0) > MOST_TERMS:
            fail(plan, where, f"step {number} has {step['bound']} terms")
        if not all(each < number for each in args):
            fail(plan, where, f"step {number} is computed of {args}, which do not stand before it")
        if op == "parameter":
            _one_of(plan, where, "parameter", step["parameter"], parameters)
            if type_ != parameters[step["parameter"]]:
                fail(plan, where, f"`{step['parameter']}` is no {type_}")
        if op == "resource":
            _one_of(plan, where, "texture of the host", step["texture"], textures)
    if steps[-1]["type"] != value["representation"]:
        fail(plan, where, f"it is {steps[-1]['type']}, and not {value['representation']}")


def _check_texture(plan: Row, where: str, texture: Row) -> None:
    is_single = (texture["dimension"], texture["levels"], texture["kept"]) == ("2d", 1, False)
    if texture["samples"] > 1 and not is_single:
        fail(plan, where, "it has several samples, and also levels, layers or a later frame")
    _one_of(plan, where, "format", texture["format"], (*FORMATS, *DEPTH_FORMATS))
    if texture["layers"] not in LAYERS.get(texture["dimension"], range(1, 1 << 16)):
        fail(plan, where, f"{texture['dimension']} does not have {texture['layers']} layers")
    size = texture["size"]
    if (size["value"] is None) == (size["extent_of"] is None):
        fail(plan, where, "its size is either a value or the extent of a step")
    if size["value"] is not None:
        _value(plan, where, size["value"], "ivec2")
        return
    kernels = [step["name"] for step in plan["steps"] if step.get("images")]
    _one_of(plan, where, "step that writes images", size["extent_of"], kernels)


# --- steps ---------------------------------------------------------------------------------------


def _check_barriers(plan: Row, where: str, place: Row) -> None:
    """What is waited for in one place."""
    _no_two(plan, where, [f"texture {row['texture']}" for row in place["barriers"]])
    for barrier in place["barriers"]:
        _texture(plan, where, barrier["texture"])
    _no_two(plan, where, [row["result"] for row in place["buffer_barriers"]])
    buffers = [row["name"] for row in plan["results"] if row["kind"] == "buffer"]
    for barrier in place["buffer_barriers"]:
        _one_of(plan, where, "buffer", barrier["result"], buffers)


def _check_step(plan: Row, step: Row) -> None:
    where = step_name(step)
    for use in uses(step):
        _number(plan, where, "shader", use["shader"], plan["shaders"])
        _no_two(plan, where, [row["name"] for row in use["inputs"]])
    for row in inputs(step):
        _check_input(plan, f"{where}, input {row['name']}", row)
    written = [*drawn_to(step), *(row["texture"] for row in step.get("images", ()))]
    _no_two(plan, where, [f"texture {number}" for number in written])
    for image in step.get("images", ()):
        _texture(plan, where, image["texture"])
    for row in attachments(step):
        _check_attachment(plan, f"{where}, {row['name']}", row, is_depth=row is step["depth"])
    for name, type_ in SETTINGS.items():
        if step.get(name) is not None:
            _value(plan, f"{where}, {name}", step[name], type_)
    for drawn in step.get("draws", ()):
        _check_drawn(plan, where, step, drawn)
    for end in ("from", "to"):
        if end in step:
            _one_of(plan, where, "result", step[end].get("result"), _results(plan))
            _texture(plan, where, step[end].get("texture"))
    _check_result_names(plan, where, step)


def _check_result_names(plan: Row, where: str, step: Row) -> None:
    """A result is called like what leaves it."""
    for row in attachments(step):
        if row["result"].rpartition(".")[2] != row["name"]:
            fail(plan, where, f"`{row['name']}` is drawn to `{row['result']}`")
    for row in (*step.get("images", ()), *step.get("buffers", ())):
        if row["result"] != f"{step['name']}.{row['name']}":
            fail(plan, where, f"`{row['name']}` is written to `{row['result']}`")


def _check_input(plan: Row, where: str, row: Row) -> None:
    if "value" in row:
        _number(plan, where, "value", row["value"], plan["values"])
        return
    for source in (row, row.get("initially") or {}):
        if "host" in source:
            known = [each["name"] for each in (*plan["host_textures"], *plan["host_buffers"])]
            _one_of(plan, where, "texture or buffer of the host", source["host"], known)
        if "result" in source:
            _one_of(plan, where, "result", source["result"], _results(plan))
        _texture(plan, where, source.get("texture"))
    if "previous" in row:
        kept = {each["result"]: each["previous"] for each in plan["kept"]}
        _one_of(plan, where, "result that is kept", row["previous"], kept)
        if kept[row["previous"]] != row["texture"]:
            fail(plan, where, f"texture {row['texture']} does not keep `{row['previous']}`")


def _check_attachment(plan: Row, where: str, row: Row, *, is_depth: bool) -> None:
    texture = plan["textures"][_texture(plan, where, row["texture"])]
    if (texture["format"] in DEPTH_FORMATS) != is_depth:
        fail(plan, where, f"texture {row['texture']} is {texture['format']}")
    if texture["format"].endswith(STENCILS) != ("stencil" in row):
        said = "what becomes" if "stencil" in row else "nothing"
        fail(plan, where, f"it says {said} of stencil values, and it is {texture['format']}")
    layer, level = row["layer"], row["level"]
    if not 0 <= level < texture["levels"] or not (layer is None or 0 <= layer < texture["layers"]):
        fail(plan, where, f"texture {row['texture']} has no layer {layer}, level {level}")
    if row["clear"] is not None:
        _value(plan, where, row["clear"], "float" if is_depth else "vec4")
        if row["load"] != "clear":
            fail(plan, where, "what is loaded is not cleared")
    if row["over"] is not None:
        _one_of(plan, where, "result", row["over"], _results(plan))
    if row["resolve"] is not None:
        _check_resolve(plan, where, texture, row["resolve"])


def _check_resolve(plan: Row, where: str, drawn: Row, row: Row) -> None:
    """The mean of samples is written to a place of the same size and format."""
    texture, level = plan["textures"][_texture(plan, where, row["texture"])], row["level"]
    size, whole = drawn["size"], texture["size"]
    if drawn["samples"] == 1 or drawn["format"] in DEPTH_FORMATS or texture["samples"] > 1:
        fail(plan, where, f"there are no samples to resolve to texture {row['texture']}")
    if not 0 <= level < texture["levels"] or not 0 <= row["layer"] < texture["layers"]:
        fail(plan, where, f"texture {row['texture']} has no layer {row['layer']}, level {level}")
    if (texture["format"], {**whole, "level": whole["level"] + level}) != (drawn["format"], size):
        fail(plan, where, f"texture {row['texture']} has another format or size than its samples")


def _check_drawn(plan: Row, where: str, step: Row, drawn: Row) -> None:
    """What is drawn: models, each by the shader for its material, or vertices without any."""
    models = drawn["models"]
    lights = [row["name"].removeprefix(f"{plan['rig']}.") for row in plan["lights"]]
    materials: list[str | None] = [None]
    if (models is None) == (drawn["vertices"] is None):
        fail(plan, where, "it draws either models or vertices without models")
    if models is None:
        _value(plan, where, drawn["vertices"], "int")
    else:
        known = {row["name"]: row["materials"] for row in plan["models"]}
        _one_of(plan, where, "name of models", models, known)
        materials = known[models]
    if [use["material"] for use in drawn["uses"]] != materials:
        fail(plan, where, f"it does not have one shader for each material of `{models}`")
    if drawn["light"] is not None:
        _one_of(plan, where, "light", drawn["light"], lights)
    for use in drawn["uses"]:
        shader = plan["shaders"][use["shader"]]
        parts = (plan["frame"], step["pass"], use["material"], drawn["light"])
        meant = ".".join(part for part in parts if part)
        if (shader["name"], shader["pass"]) != (meant, step["pass"]):
            fail(plan, where, f"it is drawn by `{shader['name']}`, and not by `{meant}`")


def _check_kept(plan: Row, row: Row) -> None:
    where = f"kept {row['result']}"
    _one_of(plan, where, "result", row["result"], _results(plan))
    if row["texture"] is None and row["previous"] is None:
        return
    if _texture(plan, where, row["texture"]) == _texture(plan, where, row["previous"]):
        fail(plan, where, "what was drawn and what is drawn are one texture")
    one, other = (plan["textures"][row[end]] for end in ("texture", "previous"))
    for key in ("format", "dimension", "size", "layers", "levels"):
        if one[key] != other[key]:
            fail(plan, where, f"its two textures differ in their {key}")


# --- parts ---------------------------------------------------------------------------------------


def _results(plan: Row) -> list[str]:
    return [row["name"] for row in plan["results"]]


def _one_of(plan: Row, where: str, what: str, name: Any, known: Iterable[str]) -> None:
    known = list(known)
    if name not in known:
        fail(plan, where, f"there is no {what} `{name}`")


def _number(plan: Row, where: str, what: str, number: int, rows: list[Row]) -> None:
    if not 0 <= number < len(rows):
        fail(plan, where, f"there is no {what} {number}: there are {len(rows)}")


def _value(plan: Row, where: str, number: int, type_: str) -> None:
    _number(plan, where, "value", number, plan["values"])
    found = plan["values"][number]["representation"]
    if found != type_:
        fail(plan, where, f"value {number} is {found}, and not {type_}")


def _texture(plan: Row, where: str, number: int | None) -> int:
    if number is None:
        return -1
    _number(plan, where, "texture", number, plan["textures"])
    return number
