"""Finds the slots of a material that a text reads, through the functions and terms that it calls.

``building.py`` asks, after everything has been checked. Names mean here what ``checking/lookup.py``
and ``checking/calls.py`` say.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ....support.frozen import changed, frozen
from ...syntax import ast
from ..checking.calls import is_texture
from ..names.modules import Module, Symbol
from ..state.scope import OUTERMOST, Instance

Key = tuple[str, int]
"""A slot's name, and the level at which it is read: ``OUTERMOST``, or that of ``inherited``."""


@frozen
class Where:
    """The surroundings of a text, as far as they say what its names mean."""

    module: Module
    surface: Instance
    instance: Instance | None = None
    """The record that contains the text: the material or the pass; ``None`` for functions."""
    level: int = 0
    own: frozenset[str] = frozenset()
    """The names of arguments, loops and ``where`` equations."""
    replaced: frozenset[str] = frozenset()
    """The slots that a ``with`` around the text gives other values."""

    def inside(self, names: Iterable[ast.Name | None]) -> Where:
        """The same with names of its own, such as the variable of a loop."""
        further = {name.text for name in names if name is not None}
        return changed(self, own=self.own | further)


@frozen
class MeantSlot:
    """The slot of a record that a name means."""

    instance: Instance
    key: Key


Called = MeantSlot | Sequence[Symbol] | None
"""A texture, the declarations of a function or structure, or ``None`` for what is built in."""


@frozen
class Reads:
    """Everything of the surface that a text reads."""

    slots: tuple[Key, ...]
    """In the order of the record's declarations."""
    lights: bool
    """True if it is summed over the lights."""


def meant(name: str, where: Where) -> MeantSlot | Sequence[Symbol] | None:
    """The meaning of a bare name; ``None`` for one of the text's own, or of the language."""
    if name in where.own:
        return None
    instance = where.instance
    if instance is not None and instance.declares(name, where.level):
        return MeantSlot(instance, (name, OUTERMOST))
    if symbols := where.module.known(name):
        return symbols
    for holder in (instance, where.surface):
        if holder is not None and holder.has(name):
            return MeantSlot(holder, (name, OUTERMOST))
    return None


def called(name: str, where: Where) -> Called:
    """The meaning of a name that is called."""
    found = meant(name, where)
    if not isinstance(found, MeantSlot):
        return found
    if is_texture(found.instance.record.definitions.get(name)):
        return found
    return where.module.known(name) or None


def inherited(e: ast.Field, where: Where) -> MeantSlot | None:
    """The slot that ``inherited.name`` means, or ``material.name``; ``None`` for other members."""
    if not isinstance(e.operand, ast.Reference) or e.operand.name in where.own:
        return None
    word, name, instance = e.operand.name, e.name.text, where.instance
    if word == "material" and where.surface.has(name):
        return MeantSlot(where.surface, (name, OUTERMOST))
    if word != "inherited" or instance is None:
        return None
    above = instance.record.above(name, where.level)
    if above is not None:
        return MeantSlot(instance, (name, above.level))
    return MeantSlot(where.surface, (name, 0)) if where.surface.has(name) else None


def reads_of(texts: Iterable[object], where: Where) -> Reads:
    """The slots of the surface that syntax trees read, and if they are summed over lights."""
    walk = _Walk(where.surface)
    walk.run([(text, where) for text in texts])
    return walk.found()


def reads_of_callee(e: ast.Call, where: Where) -> Reads:
    """What a function, or a term, that a call names reads besides the arguments."""
    assert isinstance(e.callee, ast.Reference)
    walk = _Walk(where.surface)
    walk.run(list(walk.called(e, called(e.callee.name, where), where)))
    return walk.found()


class _Walk:
    """A walk over texts, and over the functions that they call; each once."""

    def __init__(self, surface: Instance) -> None:
        self.slots: dict[Key, None] = {}
        self.lights = False
        self._surface = surface
        self._known: set[object] = set()

    def found(self) -> Reads:
        """What was read, the slots in the order of the surface."""
        slots = list(self.slots)
        if len(slots) > 1:
            order = {name: number for number, name in enumerate(self._surface.record.definitions)}
            slots.sort(key=lambda key: (order[key[0]], key[1]))
        return Reads(tuple(slots), self.lights)

    def run(self, pending: list[tuple[object, Where]]) -> None:
        while pending:
            node, where = pending.pop()
            match node:
                case ast.Reference():
                    pending += self._read(meant(node.name, where), where)
                case ast.Call(callee=ast.Reference(name=name)):
                    pending += self.called(node, called(name, where), where)
                    pending += ((argument, where) for argument in node.arguments)
                case ast.Field() if (slot := inherited(node, where)) is not None:
                    pending += self._read(slot, where)
                case _:
                    pending += _parts(node, where)

    def _read(
        self, found: MeantSlot | Sequence[Symbol] | None, where: Where
    ) -> Iterator[tuple[object, Where]]:
        """Note a slot of the surface; a slot of the pass is read through."""
        if not isinstance(found, MeantSlot) or found.key[0] in where.replaced:
            return
        if found.instance is self._surface:
            self.slots[found.key] = None
        elif self._is_new((found.key, where.replaced)):
            name, level = found.key
            definition = found.instance.record.at(name, level)
            module = definition.owner.module
            yield (
                definition.member,
                Where(module, self._surface, found.instance, definition.level),
            )

    def called(self, e: ast.Call, found: Called, where: Where) -> Iterator[tuple[object, Where]]:
        """What a call reads: a texture, or what stands in a function."""
        if found is None or isinstance(found, MeantSlot):
            yield from self._read(found, where)
            return
        for symbol in found:
            function = symbol.declaration
            if not isinstance(function, ast.Function):
                continue
            self.lights = self.lights or function.per is not None
            names = [each.name for each in function.arguments]
            around = Where(symbol.module, self._surface, replaced=where.replaced)
            yield from ((f.default, around.inside(names)) for f in _left_out(function, e))
            if self._is_new((symbol, where.replaced)):
                names += [each.name for each in function.parts]
                inside = around.inside([*names, function.per])
                yield function.body, inside
                yield from ((part.value, inside) for part in function.parts)

    def _is_new(self, key: object) -> bool:
        is_new = key not in self._known
        self._known.add(key)
        return is_new


def _left_out(function: ast.Function, e: ast.Call) -> Iterator[ast.Argument]:
    """The arguments with a default that a call does not give."""
    named = {name.text for name in e.names if name is not None}
    for formal in function.arguments[len(e.arguments) - len(named) :]:
        if formal.default is not None and formal.name.text not in named:
            yield formal


def _parts(node: object, where: Where) -> Iterator[tuple[object, Where]]:
    """The parts of a syntax tree, each with its surroundings."""
    match node:
        case ast.Fold():
            outer: Sequence[object] = (node.turns, node.initial)
            inner: Sequence[object] = (node.body,)
            names: Sequence[ast.Name | None] = (node.turns.variable,)
        case ast.FoldOver():
            outer, inner, names = (node.over,), (node.body,), (node.variable,)
        case ast.Iterate():
            outer = (node.turns, node.initial)
            inner, names = (node.condition, node.body), (node.state, node.turns.variable)
        case ast.Strips():
            turns = () if node.turns is None else (node.turns.variable,)
            outer, inner, names = (), ast.parts(node), (node.vertex, *turns)
        case ast.Tessellate():
            outer, inner, names = (), ast.parts(node), (node.coordinate,)
        case ast.With():
            replaced = frozenset(name.text for name, _value in node.replacements)
            yield node.operand, changed(where, replaced=where.replaced | replaced)
            outer, inner, names = [value for _name, value in node.replacements], (), ()
        case _:
            outer, inner, names = ast.parts(node), (), ()
    yield from ((part, where) for part in outer)
    if inner:
        inside = where.inside(names)
        yield from ((part, inside) for part in inner)


def is_knob(member: object) -> bool:
    """True if a base declares something to be set: a parameter, or a slot with a constant."""
    if isinstance(member, ast.Param):
        return member.group is None
    return isinstance(member, ast.Slot) and member.value is not None and _is_constant(member.value)


def _is_constant(e: ast.Expression) -> bool:
    """True for literals, and for constructors of literals."""
    pending = [e]
    while pending:
        match pending.pop():
            case ast.Call(callee=ast.Reference(), arguments=arguments):
                pending += arguments
            case ast.Unary(operand=operand):
                pending.append(operand)
            case ast.Number() | ast.Color() | ast.Boolean():
                pass
            case _:
                return False
    return True


class Behind:
    """Finds what is behind inherited slots: the material's own slots, and the bases' knobs."""

    def __init__(self, surface: Instance) -> None:
        self._surface = surface
        self._order = {name: i for i, name in enumerate(surface.record.definitions)}
        self._known: dict[Key, tuple[Key, ...]] = {}
        self._read: dict[Key, Sequence[Key]] = {}

    def is_own(self, key: Key) -> bool:
        """True if the material itself declares the slot."""
        return self._surface.record.at(*key).level == 0

    def of(self, key: Key) -> tuple[Key, ...]:
        """The own slots and the knobs from which an inherited slot is computed."""
        pending, entered = [key], set[Key]()
        while pending:
            top = pending[-1]
            if top in self._known:
                pending.pop()
            elif top in entered:
                pending.pop()
                self._known[top] = self._ends(top)
            else:
                entered.add(top)
                pending += (each for each in self._next(top) if each not in entered)
        return self._known[key]

    def depends_on_own(self, key: Key) -> bool:
        """True if anything that the material says changes the slot."""
        return any(map(self.is_own, (key, *self.of(key))))

    def _ends(self, key: Key) -> tuple[Key, ...]:
        """The ends behind a slot, when those behind all that it reads are known."""
        found: dict[Key, None] = {}
        for each in self._next(key):
            if self.is_own(each) or self._is_set_by_bases(each):
                found[each] = None
            else:
                found.update(dict.fromkeys(self._known.get(each, ())))
        return tuple(sorted(found, key=lambda key: self._order[key[0]]))

    def _is_set_by_bases(self, key: Key) -> bool:
        """True for a knob, but not for those of the root, which are about meshes."""
        record = self._surface.record
        is_of_root = record.declaration(key[0]).owner is record.root
        return not is_of_root and is_knob(record.at(*key).member)

    def _next(self, key: Key) -> Sequence[Key]:
        """The slots that an inherited slot reads; nothing for an end."""
        if key not in self._read:
            definition = self._surface.record.at(*key)
            is_end = self.is_own(key) or not isinstance(definition.member, ast.Slot)
            where = Where(definition.owner.module, self._surface, self._surface, definition.level)
            read = () if is_end else reads_of([definition.member], where).slots
            self._read[key] = read
        return self._read[key]
