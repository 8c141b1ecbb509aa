"""The members of a material while it is written: what a network of nodes asks for, in order."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Container, Iterable
from dataclasses import replace
from functools import cache
from math import isfinite

from ..compiler.syntax import ast
from .constants import constant
from .definitions import Functions
from .expressions import Call, Expression, Name, flat, is_literal
from .leaves.catalogue import catalogue, module_of
from .library_files import declarations
from .model import Definition, Node, Port
from .names import Names, part_name, slot_name
from .pictures import files_of_set, without_tokens
from .places import Function, Sampling, Scope
from .structures import Structures
from .texts import Equation, File, equations, one_line
from .units import written_unit
from .values import TYPES, zero

SURFACE = "MaterialXSurface"
_WORD = re.compile(r"\w+")
_WRAPS = {"periodic": "repeat", "clamp": "clamp", "mirror": "mirror", "constant": "clamp"}
_FILTERS = {"closest": "nearest"}


@cache
def surface_slots() -> frozenset[str]:
    """The names that every imported material has from its base,
    which it must not take by accident."""
    found = {"pi"}
    for path in ("prelude.burnish", "tangents.burnish", "mtlx/surface.burnish"):
        for declaration in declarations(path):
            if isinstance(declaration, ast.Record) and declaration.name.text in (
                "Surface",
                "Tangents",
                SURFACE,
            ):
                found |= {
                    member.name.text for member in declaration.members if hasattr(member, "name")
                }
    return frozenset(found)


class Members:
    """The members of one material. It is what its networks write to."""

    def __init__(self, file: File, functions: Functions, taken: Iterable[str]) -> None:
        self.file = file
        self.slots: list[Equation] = []
        self.files: dict[str, tuple[str, ...]] = {}
        """The files of textures, by the names of their maps: one, or one for each layer."""
        self._functions = functions
        self._names = Names((*surface_slots(), *taken), catalogue())
        self._parameters: dict[tuple[str, str], Equation] = {}
        self._declared: dict[tuple[str, str], int] = {}
        """For each parameter, how many others its graph declares before it."""
        self._maps: dict[tuple[str, Sampling], Equation] = {}
        self._attributes: dict[str, Equation] = {}

    def rows(self) -> list[Equation]:
        """All members, in the order in which they are written."""
        declared = (self._attributes.values(), self._ordered(), self._maps.values())
        return [*(row for rows in declared for row in rows), *self.slots]

    def lines(self, kept: Container[Equation] | None = None) -> list[str]:
        """The lines between the braces, of all members or of those that are ``kept``."""
        found: list[str] = []
        for rows in (self._attributes.values(), self._ordered(), self._maps.values()):
            found += equations(_only(rows, kept))
        slots = _only(self.slots, kept)
        if found and slots:
            found.append("")
        return found + equations(slots)

    def _ordered(self) -> list[Equation]:
        """The parameters in the order in which the document declares them, graph by graph."""
        graphs = list(dict.fromkeys(path for path, _ in self._parameters))
        keys = sorted(self._parameters, key=lambda key: (graphs.index(key[0]), self._declared[key]))
        return [self._parameters[key] for key in keys]

    def take(self, names: Iterable[str]) -> None:
        """Keep names from being given to parts."""
        self._names.take(frozenset(names))

    def without_last_name(self, value: Expression) -> Expression:
        """A value that is the whole of a material, where it is a part that nothing else reads."""
        if self.slots and value == Name(self.slots[-1].name):
            return self.slots.pop().value or value
        return value

    def inlined(self, rows: list[Equation], terms: Iterable[str]) -> list[Equation]:
        """The same equations; a part that is the whole value of one of them, and that nothing else
        reads, neither the ``terms`` of the material, is written there."""
        values = [flat(row.value) for row in (*self.slots, *rows) if row.value is not None]
        uses = Counter(word for text in (*values, *terms) for word in _WORD.findall(text))
        parts = {Name(part.name): part for part in self.slots if uses[part.name] == 1}
        inner = {row.name: parts[row.value] for row in rows if row.value in parts}
        self.slots = [part for part in self.slots if part not in inner.values()]
        return [
            replace(row, value=inner[row.name].value, doc=row.doc or inner[row.name].doc)
            if row.name in inner
            else row
            for row in rows
        ]

    def value_of(self, expression: Expression) -> Expression:
        """What a name of a part stands for; any other expression itself."""
        values = {part.name: part.value for part in self.slots}
        name = expression.text if isinstance(expression, Name) else ""
        return values.get(name) or expression

    def shared(self, value: Expression) -> Expression:
        """The name of the part that has a value already; the value itself if there is none."""
        names = (part.name for part in self.slots if part.value == value)
        return next(map(Name, names), value)

    # ---- The ``Texts`` of networks

    @property
    def structures(self) -> Structures:
        return self._functions.structures

    def surface(self, slot: str) -> Expression:
        return Name(slot)

    def parameter(self, scope: Scope, port: Port) -> Expression:
        key = (scope.graph.path, port.name)
        if key not in self._parameters:
            if port.type not in TYPES and not self.structures.has(port.type):
                return zero(port.type)
            value, kind = self._default(port), self.structures.type(port.type, bare=False)
            self._declared[key] = list(scope.graph.inputs).index(port.name)
            name = self._names.fresh(slot_name(port.name))
            doc = port.hints.get("doc", "") or _other_than(name, port.hints.get("uiname", ""))
            self._parameters[key] = Equation(
                name, value, kind, one_line(doc),
                "param ", _range(port, value), one_line(port.hints.get("uifolder", "")),
            )  # fmt: skip
        return Name(self._parameters[key].name)

    def _default(self, port: Port) -> Expression:
        if self.structures.has(port.type):
            return self.structures.value(port.value, port.type)
        return zero(port.type) if port.value is None else constant(self, port, port.type)

    def texture(self, port: Port, sampling: Sampling, node: Node) -> Expression | None:
        if not port.value:
            return None
        path = port.value
        key = (path, sampling)
        if key not in self._maps:
            name = self._map_name(path, node)
            self.files[name] = files_of_set(path, sampling.tiles) or (path,)
            kind = "texture2d_array" if sampling.tiles else "texture2d"
            kind += " of rgb" if sampling.is_encoded else ""
            self._maps[key] = Equation(
                name, None, kind, f"`{one_line(path)}`", "map ", _settings(sampling)
            )
        return Name(self._maps[key].name)

    def _map_name(self, path: str, node: Node) -> str:
        """A name for the map of a file, which no material of the document has for another file."""
        stem = slot_name(
            without_tokens(path).replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
        )
        wanted = stem if stem != "unnamed" else slot_name(node.name)
        name = self._names.fresh(wanted)
        while self.file.maps.setdefault(name, path) != path:
            name = self._names.fresh(wanted)
        return name

    def tiles(self, file: str) -> tuple[int, ...]:
        return self._functions.tiles(file)

    def read(self, texture: str, place: Expression) -> Expression:
        return Call(texture, (place,))

    def text(self, name: str) -> str:
        raise AssertionError(f"the text '{name}' is asked for outside of a function")

    def attribute(self, name: str, kind: str, doc: str) -> str:
        if name not in self._attributes:
            fresh = self._names.fresh(name)
            self._attributes[name] = Equation(fresh, None, kind, one_line(doc), "attribute ")
        return self._attributes[name].name

    def function(self, definition: Definition) -> Function | None:
        place = self._functions.place(definition)
        if place is None:
            return None
        self.file.imported_from(place.file, place.function.name)
        return place.function

    def library(self, name: str) -> str:
        return self.file.imported(module_of(name), name)

    def part(self, name: str, value: Expression, node: Node | None = None) -> Expression:
        fresh = self._names.fresh(part_name(name, value))
        self.slots.append(
            Equation(fresh, value, doc=one_line(node.hints.get("doc", "") if node else ""))
        )
        return Name(fresh)


class MembersTexts:
    """The ``Texts`` of a material, for those who write some of its expressions elsewhere, or in
    another way: they replace methods."""

    def __init__(self, members: Members) -> None:
        self._members = members

    @property
    def structures(self) -> Structures:
        return self._members.structures

    def surface(self, slot: str) -> Expression:
        return self._members.surface(slot)

    def parameter(self, scope: Scope, port: Port) -> Expression:
        return self._members.parameter(scope, port)

    def texture(self, port: Port, sampling: Sampling, node: Node) -> Expression | None:
        return self._members.texture(port, sampling, node)

    def tiles(self, file: str) -> tuple[int, ...]:
        return self._members.tiles(file)

    def read(self, texture: str, place: Expression) -> Expression:
        return self._members.read(texture, place)

    def text(self, name: str) -> str:
        return self._members.text(name)

    def attribute(self, name: str, kind: str, doc: str) -> str:
        return self._members.attribute(name, kind, doc)

    def function(self, definition: Definition) -> Function | None:
        return self._members.function(definition)

    def library(self, name: str) -> str:
        return self._members.library(name)

    def part(self, name: str, value: Expression, node: Node) -> Expression:
        return self._members.part(name, value, node)


def _only(rows: Iterable[Equation], kept: Container[Equation] | None) -> list[Equation]:
    return [row for row in rows if kept is None or row in kept]


def _other_than(name: str, title: str) -> str:
    """The title of an input, unless it says no more than the name."""
    return "" if slot_name(title).replace("_", "") == name.replace("_", "") else title


def _range(port: Port, value: Expression) -> str:
    """The range of a parameter, from the ends of its slider; none if its value lies outside."""
    low = port.hints.get("uimin") or port.hints.get("uisoftmin")
    high = port.hints.get("uimax") or port.hints.get("uisoftmax")
    if not low or not high or port.type in ("boolean", "matrix33", "matrix44"):
        return ""
    try:
        lows, highs = _numbers(low), _numbers(high)
        values = _numbers(port.value or "0")
    except ValueError:
        return ""
    unit = written_unit(port)
    if (
        len(set(lows)) > 1
        or len(set(highs)) > 1
        or not lows[0] < highs[0]
        or (not is_literal(value) and port.type != "integer" and not unit)
        or (port.unit and not unit)
    ):
        return ""
    if not all(lows[0] <= number <= highs[0] for number in values):
        return ""
    return f" in {_number(lows[0])}{unit}..{_number(highs[0])}{unit}"


def _numbers(text: str) -> list[float]:
    numbers = [float(part) for part in text.split(",")]
    if not all(map(isfinite, numbers)):
        raise ValueError
    return numbers


def _number(value: float) -> str:
    from .expressions import number_text

    return number_text(value)


def _settings(sampling: Sampling) -> str:
    """The state of a sampler, as far as it is none of the usual."""
    # Whatever is no sRGB is decoded in the shader, or is none: hosts leave its numbers as they are.
    settings = [] if sampling.is_encoded else ["intent = data"]
    if sampling.filter in _FILTERS:
        settings += [f"filter = {_FILTERS[sampling.filter]}", f"mip = {_FILTERS[sampling.filter]}"]
    if sampling.tiles:
        return f" with {{ {', '.join([*settings, 'wrap = clamp'])} }}"
    u, v = _WRAPS.get(sampling.u, "repeat"), _WRAPS.get(sampling.v, "repeat")
    if u == v:
        settings += [f"wrap = {u}"] if u != "repeat" else []
    else:
        settings += [f"wrap_u = {u}", f"wrap_v = {v}"]
    return f" with {{ {', '.join(settings)} }}" if settings else ""
