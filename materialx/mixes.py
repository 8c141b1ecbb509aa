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

    def shown(self, node: Node, scope: Scope) -> Shown:
        """The colour and the coverage of a surface, or of a mix of surfaces."""
        if node.category != "mix":
            return shown(self._members, self._network, node, scope, self._name)
        if not self._has_model(node, scope):
            return self._written_out(node, scope)
        with self._network.counted():
            self._count(node, scope)
        look = self._look(node, scope)
        return Shown(Member(look, "color"), Member(look, "alpha"))

    def _sides(self, node: Node, scope: Scope) -> list[tuple[Node, Scope] | None]:
        """What is behind and what is in front. Models are not entered, all other graphs are."""
        sides = []
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

    def _has_model(self, node: Node, scope: Scope) -> bool:
        if node.category != "mix":
            return self._term(node) is not None
        return any(self._has_model(*side) for side in self._sides(node, scope) if side is not None)

    def _count(self, node: Node, scope: Scope) -> None:
        """Ask for all values that models and mixes read, so that those of two are slots."""
        if node.category == "mix":
            self._network.input(node, "mix", scope)
            for side in self._sides(node, scope):
                if side is not None:
                    self._count(*side)
        elif (term := self._term(node)) is not None:
            for name in term.arguments.keys() & node.inputs.keys():
                self._network.input(node, name, scope)

    def _look(self, node: Node, scope: Scope) -> Expression:
        """A surface as one value, in a slot of its name."""
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

    def _side(self, side: tuple[Node, Scope] | None) -> Expression:
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

    def _written_out(self, node: Node, scope: Scope) -> Shown:
        amount = self._network.input(node, "mix", scope)
        back, front = (
            _BLACK if side is None
            else self._written_out(*side) if side[0].category == "mix"
            else shown(self._members, self._network, *side, self._name_of(side[0]))
            for side in self._sides(node, scope)
        )  # fmt: skip
        color = Call("mix", (back.color, front.color, amount))
        if back.alpha is None and front.alpha is None:
            return Shown(color)
        one = Number(1.0)
        return Shown(color, Call("mix", (back.alpha or one, front.alpha or one, amount)))

    def _name_of(self, node: Node) -> str:
        return f"{self._name}_{slot_name(node.name)}"
