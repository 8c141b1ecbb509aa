"""Types of a document that have members, ``typedef``, as structures of Burnish."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from .expressions import Call, Expression, Member
from .model import Structure
from .names import Names, record_name, slot_name
from .problems import UnsupportedError
from .texts import File
from .values import BARE, TYPES, literal, zero

MOST_PARTS = 4096
"""The most numbers and vectors that a structure has with all that are within it, as in Burnish."""


class Structures:
    """The structures of a document. Each is declared in its file, if something reads it."""

    def __init__(self, own: File, known: Mapping[str, Structure]) -> None:
        self._own, self._known = own, known
        self._names: dict[str, str] = {}
        self._members: dict[str, dict[str, str]] = {}
        self._parts: dict[str, int] = {}
        self._open: set[str] = set()

    def has(self, kind: str) -> bool:
        """True for a type of the document that has members."""
        return kind in self._known

    def type(self, kind: str, *, bare: bool) -> str:
        """A type as Burnish has it; ``bare`` as in ``values.BARE``. Raises ``UnsupportedError``."""
        if self.has(kind):
            return self._name(kind)
        table = BARE if bare else TYPES
        if kind not in table:
            raise UnsupportedError(f"there are no values of the type {kind} in shaders")
        return table[kind]

    def value(self, text: str | None, kind: str) -> Expression:
        """A structure as it is written in documents, ``{0.5;{1;2}}``; without a text, each member
        has its own default. Raises ``UnsupportedError``."""
        name = self._name(kind)
        members = self._known[kind].members.values()
        texts = [member.value for member in members] if not text else _split(text, kind)
        if len(texts) != len(members):
            raise UnsupportedError(f"'{text}' is no value of the type {kind}")
        return Call(
            name,
            tuple(
                self._one(each, member.type) for each, member in zip(texts, members, strict=True)
            ),
        )

    def _one(self, text: str | None, kind: str) -> Expression:
        if self.has(kind):
            return self.value(text, kind)
        return literal(text, kind) if text else zero(kind)

    def member(self, value: Expression, kind: str, name: str) -> tuple[Expression, str]:
        """A member of a structure, with its type. Raises ``UnsupportedError``."""
        if not self.has(kind) or name not in self._known[kind].members:
            raise UnsupportedError(f"the type {kind} has no member '{name}'")
        structure = self._name(kind)
        found = self._known[kind].members
        if isinstance(value, Call) and value.name == structure:
            return value.arguments[list(found).index(name)], found[name].type
        return Member(value, self._members[kind][name]), found[name].type

    def _name(self, kind: str) -> str:
        if kind not in self._names:
            if kind in self._open:
                raise UnsupportedError(f"the type {kind} contains itself")
            self._open.add(kind)
            try:
                self._declare(kind)
            finally:
                self._open.discard(kind)
        return self._names[kind]

    def _declare(self, kind: str) -> None:
        members = self._known[kind].members
        types = [self.type(member.type, bare=False) for member in members.values()]
        parts = sum(self._parts.get(member.type, 1) for member in members.values())
        if parts > MOST_PARTS:
            raise UnsupportedError(f"the type {kind} has more than {MOST_PARTS} members in members")
        self._parts[kind] = parts
        names = Names()
        self._members[kind] = {member: names.fresh(slot_name(member)) for member in members}
        name = self._names[kind] = self._own.names.fresh(record_name(kind))
        rows = zip(self._members[kind].values(), types, strict=True)
        self._own.helper(name, structure_text(name, rows))


def structure_text(name: str, members: Iterable[tuple[str, str]]) -> str:
    """The declaration of a structure with these members and their types."""
    pairs = list(members)
    width = max(len(member) for member, _ in pairs)
    rows = [f"    {member:{width}} : {kind}" for member, kind in pairs]
    return "\n".join([f"struct {name} {{", *rows, "}"])


def _split(text: str, kind: str) -> list[str]:
    """The texts between the semicolons of a structure, but for those within a member."""
    text = text.strip()
    if not (text.startswith("{") and text.endswith("}")):
        raise UnsupportedError(f"'{text}' is no value of the type {kind}")
    parts, depth = [""], 0
    for letter in text[1:-1]:
        depth += (letter == "{") - (letter == "}")
        if letter == ";" and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]
