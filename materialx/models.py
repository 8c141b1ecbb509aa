"""Surface models, such as OpenPBR, as abstract materials whose inputs are slots with their
defaults."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .constants import constant, property_named
from .definitions import FOLDER, Functions
from .expressions import Expression, Name, flat
from .leaves import network as network_of
from .members import SURFACE, Members, surface_slots
from .mixes import Mixes
from .model import Definition, Port
from .names import record_name, slot_name
from .places import Scope
from .surface_terms import SurfaceTerm, SurfaceTerms
from .surfaces import root
from .texts import Equation, File, equations, one_line, wrapped
from .values import CLOSURES, TYPES, zero

SHADER = "surfaceshader"
_SHADED = {"normal": "Nworld", "tangent": "Tworld"}
"""Inputs that are slots of all surfaces, if they have these geometric defaults: materials override
them."""


class Model(NamedTuple):
    """An abstract material: its name, its file, and its slots by the inputs that they are."""

    name: str
    file: File
    slots: Mapping[str, str]
    defaults: Mapping[str, str]
    """The texts of the slots' defaults."""
    taken: frozenset[str]
    """All names of its slots."""


class Models:
    """The models of an import, each written once."""

    def __init__(self, functions: Functions, own: File) -> None:
        self._functions, self._own = functions, own
        self._models: dict[Definition, Model] = {}
        self._terms = SurfaceTerms(functions, own)

    def term(self, definition: Definition) -> SurfaceTerm | None:
        """The same as a term, for mixes; nothing for what is no model."""
        return self._terms.term(definition) if is_model(definition) else None

    def model(self, definition: Definition) -> Model | None:
        """The abstract material for a definition; nothing for what is no model."""
        if not is_model(definition):
            return None
        if definition not in self._models:
            self._models[definition] = self._written(definition)
        return self._models[definition]

    def _written(self, definition: Definition) -> Model:
        file = self._own
        title = f"`{definition.category}`"
        if definition.is_library:
            heading = (
                f"//! The surface {title} of MaterialX, as its own library defines it: "
                "set the slots that differ."
            )
            file = self._functions.file(f"{FOLDER}/{slot_name(definition.category)}", heading)
        slots = slots_of(definition)
        members = Members(file, self._functions, slots.values())
        rows = [
            _declared(members, port, slots[name])
            for name, port in definition.inputs.items()
            if name in slots and slots[name] not in _SHADED
        ]
        assert definition.graph is not None
        network = network_of(members)
        scope = Scope(definition.graph, bound={name: Name(slot) for name, slot in slots.items()})
        found = root(network, next(iter(definition.graph.outputs.values())), scope)
        name = file.names.fresh(model_name(definition.category))
        color: list[Equation] = []
        if found is not None:
            mixes = Mixes(members, network, self.term, slot_name(definition.category))
            look = mixes.shown(*found)
            color.append(Equation("color", look.color))
            if look.alpha is not None:
                color.append(Equation("alpha", look.alpha))
        file.imported("std.mtlx.surface", SURFACE)
        doc = [
            f"/// {line}"
            for line in wrapped(one_line(definition.hints.get("doc", "")), 110)
            if line
        ]
        parts = [*equations(rows), "", *members.lines(), "", *equations(color)]
        record = [*doc, f"abstract material {name} : {SURFACE} {{", *parts, "}"]
        file.declarations.insert(0, "\n".join(record))
        file.helpers[file.declarations[0]] = name
        taken = {*slots.values(), *(row.name for row in members.slots), *surface_slots()}
        defaults = {row.name: flat(row.value) for row in rows if row.value is not None}
        return Model(name, file, slots, defaults, frozenset(taken))


def is_model(definition: Definition) -> bool:
    """True for a surface whose inputs are all values of slots."""
    if definition.graph is None or list(map(_type, definition.outputs.values())) != [SHADER]:
        return False
    kinds = set(map(_type, definition.inputs.values()))
    return not kinds & {*CLOSURES, "filename"}


def _type(port: Port) -> str:
    return port.type


def model_name(category: str) -> str:
    """The name of the abstract material for a surface."""
    name = record_name(category)
    return name if name.endswith("Surface") else f"{name}Surface"


def slots_of(definition: Definition) -> dict[str, str]:
    """The slots of a model by the inputs that they are; other inputs are no values of slots."""
    inputs = definition.inputs.items()
    return {name: _slot(port) for name, port in inputs if port.type in TYPES}


def _slot(port: Port) -> str:
    """The name of the slot for an input: its own, unless it is one of all surfaces and means
    something else."""
    name = slot_name(port.name)
    if name in _SHADED and port.geometry == _SHADED[name]:
        return name
    return f"{name}_input" if name in surface_slots() else name


def _declared(members: Members, port: Port, name: str) -> Equation:
    """A slot with its type, its default and what its input is for."""
    doc = one_line(port.hints.get("doc", ""))
    value: Expression
    if port.geometry:
        value = property_named(members, port.geometry)
    elif port.value is None:
        value = zero(port.type)
    else:
        value = constant(members, port, port.type)
    group = one_line(port.hints.get("uifolder", ""))
    return Equation(name, value, TYPES[port.type], doc, group=group)
