"""The names of one binding in one language."""

from __future__ import annotations

from ..support.frozen import frozen
from .naming import Case, Scope


@frozen(kw_only=True)
class Manner:
    """How a language spells names."""

    reserved: frozenset[str]
    """The words that are no names, with those of the skeleton."""
    type_case: Case
    function_case: Case
    value_case: Case
    """The manner of fields and variables."""
    constant_case: Case
    only_ascii: bool = False
    """True if not all compilers take letters beyond ASCII in names."""
    prefixed: bool = False
    """True if names of the whole text begin with the namespace."""


class Spelling:
    """Spells all names of a binding; equal names of different things do not collide."""

    def __init__(self, manner: Manner, namespace: str = "") -> None:
        """``namespace`` is what names of the whole text begin with, in languages that want it."""
        self._manner = manner
        self._globals = self._scope()
        self._members = self._scope()
        self._locals = self._scope(self._globals)
        self._choices: dict[str, Scope] = {}
        self.prefix = f"{self.namespace(namespace).replace('::', '_')}_" if manner.prefixed else ""
        """What names of the whole text begin with."""

    def _scope(self, outer: Scope | None = None) -> Scope:
        return Scope(self._manner.reserved, only_ascii=self._manner.only_ascii, outer=outer)

    def namespace(self, path: str) -> str:
        """The namespace of the whole text: ``scene::glass``."""
        parts = path.split("::")
        case = self._manner.value_case
        return "::".join(self._scope().name("namespace", part, case) for part in parts)

    def type(self, name: str) -> str:
        """The name of a block or a structure."""
        return self._global("type", name, self._manner.type_case)

    def enumeration(self, name: str) -> str:
        """The name of an enumeration."""
        return self._global("enumeration", name, self._manner.type_case)

    def constant(self, name: str) -> str:
        """The name of a constant of the whole text."""
        return self._global("constant", name, self._manner.constant_case)

    def function(self, name: str) -> str:
        """The name of a function of the whole text."""
        return self._global("function", name, self._manner.function_case)

    def _global(self, kind: str, name: str, case: Case) -> str:
        return self.prefix + self._globals.name(kind, name, case)

    def member(self, word: str) -> str:
        """The name of a field. Fields of all structures share names, which does no harm."""
        return self._members.name("field", word, self._manner.value_case)

    def setter(self, word: str) -> str:
        """The name of the function beside a field that sets an array and its number."""
        return self._members.name("setter", f"set.{word}", self._manner.value_case)

    def capacity(self, word: str) -> str:
        """The name of the constant beside a field that says how much room an array has."""
        return self._members.name("capacity", f"{word}.capacity", self._manner.value_case)

    def choice(self, enumeration: str, name: str) -> str:
        """The name of a member of an enumeration, which other enumerations may have as well."""
        scope = self._choices.setdefault(enumeration, self._scope())
        return scope.name("choice", name, self._manner.constant_case)

    def local(self, name: str) -> str:
        """The name of a variable or a parameter of a function."""
        return self._locals.name("local", name, self._manner.value_case)
