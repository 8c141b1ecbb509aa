"""Checks a plan against the reflections of its shaders: what steps give them, and draw to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from .reflections import check_reflection
from .rows import Row, attachments, fail, step_name, uses

DEPTHS = "depth"
"""What the formats of depths begin with, and what textures are called that hold them."""
_VALUE = ("representation", "layout", "members")
"""What has to be alike where a shader takes over a value of the frame."""
_KINDS = ("parameters", "textures", "buffers")
_BUFFER = ("representation", "stride", "members", "structs")
"""What has to be alike where one shader reads the elements that another one writes."""


def check_shaders(plan: Row, reflections: Sequence[Row]) -> None:
    """Raise ``PlanError`` for a shader that is given, or draws, something else than its reflection
    says. ``reflections`` are those of the plan's shaders, in order."""
    if len(reflections) != len(plan["shaders"]):
        fail(plan, "shaders", f"there are {len(reflections)}, and not {len(plan['shaders'])}")
    for row, reflection in zip(plan["shaders"], reflections, strict=True):
        found = {key: reflection[key] or None for key in ("material", "pass", "rig")}
        wanted = {"material": row["name"], "pass": row["pass"], "rig": row["rig"]}
        if found != wanted:
            fail(plan, row["name"], f"{row['reflection']} is the reflection of another shader")
        check_reflection(row["name"], reflection)
        _check_lights(plan, reflection)
    shaders = _Shaders(plan, reflections)
    for step in plan["steps"]:
        for use in uses(step):
            shaders.check_use(step_name(step), use)
        if step["kind"] == "draw":
            shaders.check_draw(step)
        elif step["kind"] == "run":
            shaders.check_run(step)


def _check_lights(plan: Row, reflection: Row) -> None:
    """The lights of a shader are those of the frame; an array is taken over as it is."""
    lights = _by_name(plan["lights"])
    values, own_values = _by_name(plan["parameters"]), _by_name(reflection["parameters"])
    for row in reflection["lights"]:
        name = row["name"].removeprefix(f"{reflection['rig']}.")
        own = lights.get(name, lights.get(f"{plan['rig']}.{name}"))
        if own is None:
            fail(plan, reflection["material"], f"the frame has no light `{name}`")
        if row["capacity"] is None:
            continue
        taken = [(row["name"], own["name"])]
        if row["count"] is not None:
            taken.append((row["count"], own["count"]))
        for ours, theirs in taken:
            of_frame = values.get(theirs, {})
            if any(own_values[ours][key] != of_frame.get(key) for key in _VALUE):
                fail(plan, reflection["material"], f"the frame's light `{name}` is another one")


class _Shaders:
    def __init__(self, plan: Row, reflections: Sequence[Row]) -> None:
        self._plan = plan
        self._reflections = reflections
        self._inputs = [_inputs_of(each) for each in reflections]
        """By name, what each shader can be given: which of ``_KINDS`` it is, and its row."""
        self._results = [_by_name(each["results"]) for each in reflections]
        self._alike: set[tuple[str, int, str]] = set()
        """Which buffers have been compared with which input of which shader."""
        self._textures: dict[str, tuple[str, str]] = dict(self._all_textures())
        """Of each result, and each texture of the host, the dimension and what it holds."""
        self._buffers: dict[str, Row] = dict(self._all_buffers())

    def _all_textures(self) -> Iterator[tuple[str, tuple[str, str]]]:
        for row in self._plan["host_textures"]:
            yield f"host {row['name']}", (row["dimension"], row["sample"])
        for row in self._plan["results"]:
            if row["texture"] is not None:
                texture = self._plan["textures"][row["texture"]]
                holds = DEPTHS if texture["format"].startswith(DEPTHS) else "float"
                yield row["name"], (texture["dimension"], holds)

    def _all_buffers(self) -> Iterator[tuple[str, Row]]:
        for row in self._plan["host_buffers"]:
            yield f"host {row['name']}", row
        for step in self._plan["steps"]:
            for row in step.get("buffers", ()):
                yield row["result"], self._results[step["shader"]].get(row["name"], {})

    # --- what shaders are given ------------------------------------------------------------------

    def check_use(self, where: str, use: Row) -> None:
        """Every input is one of the shader, and of its type."""
        shader: int = use["shader"]
        for row in use["inputs"]:
            name = row["name"]
            if name not in self._inputs[shader]:
                material = self._reflections[shader]["material"]
                fail(self._plan, where, f"{material} has no input `{name}`")
            wanted, declared = self._inputs[shader][name]
            if (wanted == "parameters") != ("value" in row):
                fail(self._plan, where, f"`{name}` is one of the shader's {wanted}")
            if "value" in row:
                self._check_value(where, row, declared)
                continue
            for source in (row, row.get("initially") or {}):
                named = _source(source)
                if named is not None and wanted == "textures":
                    self._check_texture(where, named, declared)
                elif named is not None and (named, shader, name) not in self._alike:
                    self._check_buffer(where, named, declared)
                    self._alike.add((named, shader, name))

    def _check_value(self, where: str, row: Row, declared: Row) -> None:
        found = self._plan["values"][row["value"]]["representation"]
        if found != declared["representation"]:
            fail(self._plan, where,
                 f"`{row['name']}` is {declared['representation']}, and value {row['value']} is "
                 f"{found}")  # fmt: skip

    def _check_texture(self, where: str, named: str, declared: Row) -> None:
        found = self._textures.get(named)
        if found != (declared["dimension"], declared["sample"]):
            name = declared["name"]
            fail(self._plan, where, f"`{name}` is {declared['type']}, and `{named}` is not")

    def _check_buffer(self, where: str, named: str, declared: Row) -> None:
        buffer = self._buffers.get(named, {})
        if any(buffer.get(key) != declared[key] for key in _BUFFER):
            name = declared["name"]
            fail(self._plan, where, f"`{name}` is {declared['type']}, and `{named}` is not")

    # --- what they draw and write ----------------------------------------------------------------

    def check_draw(self, step: Row) -> None:
        """The targets of a pass are drawn to textures of their formats."""
        where = step_name(step)
        layers = self._plan["textures"][next(attachments(step))["texture"]]["layers"]
        for shader in dict.fromkeys(use["shader"] for use in uses(step)):
            reflection = self._reflections[shader]
            self._check_kind(where, shader, is_kernel=False)
            self._check_targets(where, step["targets"], reflection)
            self._check_depths(where, step["depth"], reflection)
            own = reflection["draw"]["layers"]
            samples = reflection["render_state"]["samples"]
            for row in attachments(step):
                found = self._plan["textures"][row["texture"]]["samples"]
                if found != samples:
                    fail(self._plan, where, f"`{row['name']}` has {found} samples, not {samples}")
                if (own is not None) != (row["layer"] is None):
                    fail(self._plan, where, f"`{row['name']}` is drawn to layer {row['layer']}")
            if own is not None and own["count"] != layers:
                fail(self._plan, where, f"it draws {own['count']} layers to {layers}")

    def _check_depths(self, where: str, given: Row | None, reflection: Row) -> None:
        """A step has depths, and stencil values, if its pass uses them."""
        state = reflection["render_state"]
        depth, stencil = state["depth"], state["stencil"]
        is_used = depth["write"] or depth["compare"] != "always" or stencil is not None
        if is_used != (given is not None):
            said = "no depths" if given is None else "depths"
            fail(self._plan, where, f"it has {said}, and {reflection['material']} differs")
        if stencil is not None and "stencil" not in (given or ()):
            fail(self._plan, where, f"{reflection['material']} tests stencil values it has not got")

    def check_run(self, step: Row) -> None:
        """A kernel writes what its reflection says."""
        reflection = self._reflections[step["shader"]]
        self._check_kind(step_name(step), step["shader"], is_kernel=True)
        self._check_targets(step_name(step), step["images"], reflection)
        found = [row["name"] for row in step["buffers"]]
        wanted = [row["name"] for row in reflection["results"]]
        if found != wanted:
            fail(self._plan, step_name(step), f"it writes {', '.join(wanted)}")

    def _check_kind(self, where: str, shader: int, *, is_kernel: bool) -> None:
        """A pass has no work groups, and a kernel draws nothing."""
        reflection = self._reflections[shader]
        if (reflection["work_group"] is not None) != is_kernel:
            kinds = "a pass", "a kernel"
            fail(self._plan, where, f"{reflection['material']} is {kinds[not is_kernel]}, and not "
                 f"{kinds[is_kernel]}")  # fmt: skip

    def _check_targets(self, where: str, rows: Sequence[Row], reflection: Row) -> None:
        found = [(row["name"], self._plan["textures"][row["texture"]]["format"]) for row in rows]
        wanted = [(row["name"], row["format"]) for row in reflection["targets"]]
        if found != wanted:
            given, meant = (", ".join(f"`{name}` as {format_}" for name, format_ in each) or "none"
                            for each in (found, wanted))  # fmt: skip
            fail(self._plan, where, f"its targets are {given}, and those of the shader {meant}")


def _source(row: Row) -> str | None:
    """What an input reads, by the name under which it is known here."""
    if "host" in row:
        return f"host {row['host']}"
    found = row.get("result", row.get("previous"))
    return None if found is None else str(found)


def _inputs_of(reflection: Row) -> Mapping[str, tuple[str, Row]]:
    """All that a shader can be given, by name. What comes first hides what has its name."""
    return {row["name"]: (kind, row) for kind in reversed(_KINDS) for row in reflection[kind]}


def _by_name(rows: Sequence[Row]) -> Mapping[str, Any]:
    return {row["name"]: row for row in rows}
