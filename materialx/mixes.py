"""Mixes of surfaces. A side that is a model is a call of its term, in a slot with the name of its
node; a side that is made of closures is written out."""

from __future__ import annotations

from collections.abc import Callable

from .expressions import Call, Expression, Member, Number
from .leaves.catalogue import module_of
from .members import Members
from .model import Definition, Node
from .names import slot_name
from .networks import Network
from .places import Scope
from .sides import Key, Place, Sides, key, sides_of
from .surface_terms import LOOK, SurfaceTerm
from .surfaces import Shown, shown, surface_root

TermOf = Callable[[Definition], SurfaceTerm | None]
"""Gives the term of a model; nothing for what is none."""
_BLACK = Shown(Call("vec3", (Number(0.0),)))


class Mixes:
    """Writes what one material looks like, whose terms begin with ``name``."""

    def __init__(self, members: Members, network: Network, term_of: TermOf, name: str) -> None:
        self._members, self._network = members, network
        self._term_of, self._name = term_of, name
        self._looks: dict[Key, Expression] = {}
        self._shown: dict[Key, Shown] = {}

    def shown(self, node: Node, scope: Scope) -> Shown:
        """The colour and the coverage of a surface, or of a mix of surfaces."""
        if node.category != "mix":
            return shown(self._members, self._network, node, scope, self._name)
        made = sides_of((node, scope), self._sides)
        if all(self._term(each) is None for each, _ in made.places):
            return self._written_out((node, scope), made)
        with self._network.counted():
            for place in made.places:
                self._count(*place)
        look = self._look(node, scope)
        return Shown(Member(look, "color"), Member(look, "alpha"))

    def _sides(self, node: Node, scope: Scope) -> list[Place | None]:
        """The back and the front of a mix; nothing for other nodes. Models are not entered, all
        other graphs are."""
        sides: list[Place | None] = []
        if node.category != "mix":
            return sides
        for name in ("bg", "fg"):
            port, found = node.inputs.get(name), None
            if port is not None:
                found = surface_root(self._network, port, scope, enter=False)
                if found is not None and self._term(found[0]) is None:
                    found = surface_root(self._network, port, scope)
            sides.append(found)
        return sides

    def _term(self, node: Node) -> SurfaceTerm | None:
        return None if node.definition is None else self._term_of(node.definition)

    def _count(self, node: Node, scope: Scope) -> None:
        """Ask for all values that a model or a mix reads, so that those of two are slots."""
        if node.category == "mix":
            self._network.input(node, "mix", scope)
        elif (term := self._term(node)) is not None:
            for name in term.arguments.keys() & node.inputs.keys():
                self._network.input(node, name, scope)

    def _look(self, node: Node, scope: Scope) -> Expression:
        """A surface as one value, in a slot of its name."""
        place = key((node, scope))
        if place not in self._looks:
            self._looks[place] = self._look_of(node, scope)
        return self._looks[place]

    def _look_of(self, node: Node, scope: Scope) -> Expression:
        term = self._term(node)
        if node.category == "mix":
            sides = [self._side(side) for side in self._sides(node, scope)]
            mixed = self._members.library("mixed")
            call = Call(mixed, (*sides, self._network.input(node, "mix", scope)))
        elif term is not None:
            call = self._call(term, node, scope)
        else:
            look = shown(self._members, self._network, node, scope, self._name_of(node))
            call = Call(
                self._members.file.imported(module_of(LOOK), LOOK),
                (look.color, look.alpha or Number(1.0)),
            )
        return self._members.part(slot_name(node.name), call, node)

    def _side(self, side: Place | None) -> Expression:
        if side is not None:
            return self._look(*side)
        look = self._members.file.imported(module_of(LOOK), LOOK)
        return Call(look, (_BLACK.color, Number(1.0)))

    def _call(self, term: SurfaceTerm, node: Node, scope: Scope) -> Call:
        """The call of a model's term with what its node sets."""
        self._members.file.imported_from(term.file, term.name)
        given = {
            argument: self._network.input(node, name, scope)
            for name, argument in term.arguments.items()
            if name in node.inputs and not self._network.is_default(node, name)
        }
        return Call(term.name, tuple(given.values()), tuple(given))

    def _written_out(self, place: Place, made: Sides) -> Shown:
        """A surface that is made of closures; one that several mixes use has slots."""
        if key(place) not in self._shown:
            node, scope = place
            if node.category == "mix":
                found = self._mixed(node, scope, made)
            else:
                found = shown(self._members, self._network, node, scope, self._name_of(node))
            self._shown[key(place)] = self._named(node, found) if made.is_shared(place) else found
        return self._shown[key(place)]

    def _mixed(self, node: Node, scope: Scope, made: Sides) -> Shown:
        amount = self._network.input(node, "mix", scope)
        back, front = (
            _BLACK if side is None else self._written_out(side, made)
            for side in self._sides(node, scope)
        )
        color = Call("mix", (back.color, front.color, amount))
        if back.alpha is None and front.alpha is None:
            return Shown(color)
        one = Number(1.0)
        return Shown(color, Call("mix", (back.alpha or one, front.alpha or one, amount)))

    def _named(self, node: Node, look: Shown) -> Shown:
        name = slot_name(node.name)
        color = self._members.part(f"{name}_color", look.color, node)
        if look.alpha is None:
            return Shown(color)
        return Shown(color, self._members.part(f"{name}_alpha", look.alpha, node))

    def _name_of(self, node: Node) -> str:
        return f"{self._name}_{slot_name(node.name)}"
