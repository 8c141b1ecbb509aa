"""The names of one binding in one language."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from .fields import Field, Structure
from .naming import Scope

if TYPE_CHECKING:
    from .host_language import HostLanguage


class Spelling:
    """Spells all names of a binding; equal names of different things do not collide."""

    def __init__(self, language: HostLanguage) -> None:
        self._language = language
        self._globals = self._scope()
        self._members: dict[str, Scope] = {}
        self._locals = self._scope(self._globals)

    def _scope(self, outer: Scope | None = None) -> Scope:
        language = self._language
        return Scope(language.reserved, only_ascii=language.only_ascii, outer=outer)

    def type(self, name: str) -> str:
        """The name of a block or a structure."""
        return self._globals.name("type", name, self._language.type_case)

    def constant(self, name: str) -> str:
        """The name of a constant of the whole text."""
        return self._globals.name("constant", name, self._language.constant_case)

    def function(self, name: str) -> str:
        """The name of a function of the whole text."""
        return self._globals.name("function", name, self._language.function_case)

    def member(self, word: str) -> str:
        """The name of a field. Fields of all structures share names, which does no harm."""
        return self.field_scope.name("field", word, self._language.value_case)

    @property
    def field_scope(self) -> Scope:
        """The names of fields."""
        return self._members.setdefault("", self._scope())

    def local(self, name: str) -> str:
        """The name of a variable or a parameter of a function."""
        return self._locals.name("local", name, self._language.value_case)

    def fields(self, structure: Structure) -> Iterable[tuple[str, Field]]:
        """The fields of a structure with their names."""
        return [(self.member(field.word), field) for field in structure.fields]
