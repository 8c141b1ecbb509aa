"""Resolves a host's names to parameters, parts of parameters, lights and textures.

``Instance`` asks it for every name that a user passes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ....compiler.diagnostics.nearest import suggestion
from ....compiler.documents.steps import ParameterStep, StepRow
from .declared import Declared, TextureDeclaration
from .shapes import Elements, Members, Shape, part, shape_of
from .values import ParameterError, UnknownParameterError

_NAME = re.compile(r"\w+(\.\w+|\[\d+\])*")
Steps = Sequence[StepRow]
_STEP = re.compile(r"\w+|\[\d+\]")


@dataclass(frozen=True, slots=True)
class ValuePlace:
    """A parameter or a part of one."""

    parameter: str
    path: tuple[int, ...]
    """The positions of elements and members on the way from the parameter to the part."""
    shape: Shape


class Names:
    """All names of one reflection."""

    def __init__(self, declared: Declared) -> None:
        self.shapes: Mapping[str, Shape] = {row.name: shape_of(row) for row in declared.parameters}
        self.textures: Mapping[str, TextureDeclaration] = {
            row.name: row for row in declared.textures
        }
        """The rows of textures, by name."""
        self.counters: Mapping[str, str] = {row.count: row.name for row in declared.buffers}
        """The storage buffer whose elements a parameter counts."""
        self._buffers = frozenset(self.counters.values())
        self._lights = {
            row.name: tuple(map(row.member, row.parameters))
            for row in declared.lights
            if row.capacity is None
        }
        self._derived = {row.name: _inputs(row.steps) for row in declared.derived}
        read = {name for steps in declared.computed for name in _inputs(steps)}
        rows = declared.parameters
        self.needed = tuple(r.name for r in rows if r.block is not None or r.name in read)
        """The parameters that a shader reads, or from which the host computes a value."""
        self._needed = frozenset(self.needed)
        of_rig = [row.name for row in rows if row.group == "rig"]
        self.rig: Mapping[str, str] = {
            **{row.entry: row.name for row in declared.lights},
            **{row.name: row.name for row in declared.lights},
            **{name: name for name in of_rig},
        }
        """The lights, and all other parameters that are set per rig: their names in ``rig``, with
        their full names. Among those of a rig, a light needs no rig's name before its own."""

    def is_needed(self, name: str) -> bool:
        """True if a parameter is one of the ``needed``."""
        return name in self._needed

    def light(self, name: str) -> tuple[str, ...]:
        """The parameters of a single light, without its own name; empty for any other name."""
        return self._lights.get(name, ())

    def place(self, name: str) -> ValuePlace:
        """The parameter, or the part of one, with a name. Raises ``ParameterError`` if there is
        none."""
        steps = _STEP.findall(name) if _NAME.fullmatch(name) else []
        self._check_whole(name)
        for end in range(len(steps), 0, -1):
            parameter = ".".join(steps[:end])
            if parameter in self.shapes:
                return self._inside(parameter, steps[end:], name)
        raise self._unknown(name)

    def _check_whole(self, name: str) -> None:
        """Raise ``ParameterError`` for a part of a storage buffer."""
        buffer, bracket, _ = name.partition("[")
        if bracket and buffer in self._buffers:
            raise ParameterError(
                name, f"`{buffer}` is a storage buffer, which is set and read as a whole"
            )

    def _inside(self, parameter: str, steps: list[str], name: str) -> ValuePlace:
        owner, shape, path = parameter, self.shapes[parameter], []
        for step in steps:
            position = _position(shape, step, owner, name)
            text, _, shape = part(shape, position)
            owner += text
            path.append(position)
        return ValuePlace(parameter, tuple(path), shape)

    def _unknown(self, name: str) -> UnknownParameterError:
        if name in self._lights:
            members = ", ".join(f"`{name}.{member}`" for member in self._lights[name])
            text = f"`{name}` is a light, whose parameters are {members}"
            return UnknownParameterError(name, text, names_no_value=True)
        if inputs := self._derived.get(name):
            listed = ", ".join(f"`{each}`" for each in inputs)
            text = f"`{name}` is not set but derived, from {listed}"
            return UnknownParameterError(name, text, names_no_value=True)
        names = [*self.shapes, *self.textures, *self.counters.values(), *self._lights]
        return UnknownParameterError(name, no_parameter(name, names))


def no_parameter(name: str, known: Sequence[str]) -> str:
    """The message about a name that no parameter has, of which these are all names.

    What a host writes may be misspelt as a whole, or in the part before its first dot.
    """
    root = name.partition(".")[0].partition("[")[0]
    roots = list(dict.fromkeys(each.partition(".")[0] for each in known))
    hint = _said_elsewhere(name, known) or suggestion(name, known) or suggestion(root, roots)
    hint = hint or f"there are {', '.join(roots)}"
    return f"there is no parameter `{name}`: {hint}"


def _said_elsewhere(name: str, known: Sequence[str]) -> str:
    """The question for a member that other systems call otherwise: ``torch.position``."""
    from ....stdlib.builtins.foreign_words import OF_LAMPS

    owner, dot, member = name.rpartition(".")
    meant = OF_LAMPS.get(member.replace("_", "").casefold(), ())
    found = next((each for each in meant if f"{owner}{dot}{each}" in known), "")
    return f"did you mean `{owner}{dot}{found}`?" if found else ""


def _inputs(steps: Steps) -> tuple[str, ...]:
    """The parameters from which something is computed."""
    read = (step.parameter for step in steps if isinstance(step, ParameterStep))
    return tuple(dict.fromkeys(read))


def _position(shape: Shape, step: str, owner: str, name: str) -> int:
    """The position of the element or member of ``owner`` that a step of a name means."""
    if isinstance(shape, Elements) and step.startswith("["):
        position = int(step[1:-1])
        if position < shape.count:
            return position
        last = shape.count - 1
        raise ParameterError(
            name, f"there is no `{owner}{step}`: the last element is `{owner}[{last}]`"
        )
    if isinstance(shape, Members) and not step.startswith("["):
        names = [member.name for member in shape.members]
        if step in names:
            return names.index(step)
        hint = suggestion(step, names) or f"there are {', '.join(names)}"
        raise ParameterError(name, f"`{owner}` has no member `{step}`: {hint}")
    raise ParameterError(name, f"`{owner}` ({shape.type}) has no part `{step}`")
