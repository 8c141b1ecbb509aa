"""Hints for equations and headers whose marks are missing, or those of other languages.

``Advice`` asks here where a member or a declaration begins, and goes on as none does:
``color vec3(1)``, ``material M() {``, ``param rough = 0.5``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from ..diagnostics.fixes import Hint
from .foreign_syntax import elsewhere
from .forms import DECLARATIONS
from .quoting import shortened
from .token_view import TokenView

_ASSIGNED = frozenset(("is", "be"))
"""Words that stand for ``=`` where somebody writes as they speak."""
_SURFACES = frozenset(("shader", "Shader", "surface", "class", "Material", "shader_type"))
"""Words that other languages declare a surface with."""
_TEXTURES = frozenset(("texture", "image", "tex"))
"""Words that other languages declare a texture with."""
_BEHIND_VALUES = frozenset(("(", ".", "+", "-", "*", "/"))
"""Marks that stand behind a value, and never behind a type."""
_LITERALS: Mapping[str, str] = MappingProxyType(
    {"NUMBER": "float", "COLOR": "rgb", "true": "bool", "false": "bool"}
)
"""The types of values that consist of one token, by the kind of the token."""
_VECTOR = re.compile(r"(?:rgba?|[iub]?vec[234])")


class EquationAdvice(TokenView):
    """Finds hints by looking at the tokens around the beginning of a member."""

    def of_missing_equals(self, index: int, start: int) -> Hint:
        """About ``color vec3(1)``, ``color (1, 0, 0)`` and ``color <- #fff``: where is the ``=``?

        ``start`` is the first token of the member.
        """
        name, found = self.token(index - 1), self.token(index)
        is_row = name.kind == "NAME" and not self.outline.begins_line(index)
        if index - 1 != start or not is_row or not self._begins(start):
            return ""
        if name.text in DECLARATIONS:
            return ""
        if name.text == "return" and self.value_end(index) > index + 1:
            value, end = self.quoted(index, self.value_end(index)), self.value_end(index)
            said = f"there are no statements: a surface shows its slot, `color = {value}`"
            return self.replace(said, start, end - 1, f"color = {self.written(index, end)}")
        if elsewhere(name.text):
            return ""
        first = index
        if found.text in _ASSIGNED:
            first += 1
        elif self.kinds(index, 2) == ["<", "-"]:
            first += 2
        elif not self._begins_value(index):
            return ""
        value = self._value(first)
        if not value:
            return ""
        said = f"a value follows `=`: `{name.text} = {shortened(value)}`"
        last = self.value_end(first) - 1
        return self.replace(said, index, last, f"= {value}")

    def _begins(self, start: int) -> bool:
        """True if a member begins with a token for sure: with its line, or behind a mark."""
        return self.outline.begins_line(start) or self.text(start - 1) in ("{", ";", ",")

    def _begins_value(self, index: int) -> bool:
        """True if a token begins a value that cannot be anything else behind a name."""
        found = self.token(index)
        if found.kind == "NAME":
            return self.text(index + 1) == "(" and not self._heads_function(index)
        if found.kind == "-":
            return self.token(index - 1).end < found.start == self.token(index + 1).start - 1
        return found.kind in ("NUMBER", "COLOR", "true", "false") or self._is_list(index)

    def _heads_function(self, index: int) -> bool:
        """True if a name is that of a function whose arguments have types, or which has a body."""
        closing = self.closing(index + 1)
        behind = self.text(closing + 1)
        inside = self.kinds(index + 2, 2)
        return behind in ("{", "->", "=", "=>") or inside == ["NAME", "NAME"] or ":" in inside

    def _is_list(self, index: int) -> bool:
        """True if two to four numbers stand in parentheses."""
        closing = self.closing(index)
        parts = self.kinds(index + 1, closing - index - 1)
        numbers, commas = parts[::2], parts[1::2]
        is_list = set(numbers) == {"NUMBER"} and set(commas) == {","} and len(parts) % 2
        return self.token(index).kind == "(" and bool(is_list) and len(numbers) <= 4

    def _value(self, first: int) -> str:
        """The value from a token on, as a program writes it; empty if it has no end."""
        value = self.written(first, self.value_end(first))
        if self._is_list(first):
            return f"vec{len(value.split(','))}{value}"
        return value

    def of_colon(self, index: int, start: int) -> Hint:
        """About ``color: vec3(1)`` or ``color: base * 2``; ``index`` is behind the first name."""
        is_slot = self.kinds(start, 3) == ["NAME", ":", "NAME"]
        goes_on = is_slot and self.token(index).kind in _BEHIND_VALUES
        if index != start + 3 or not goes_on or not self._begins(start):
            return ""
        name, value = self.text(start), self.quoted(start + 2, self.value_end(start + 2))
        said = f"a value follows `=`: `{name} = {value}`"
        return self.replace(said, start + 1, start + 1, " =")

    def of_type(self, index: int, expected: set[str], start: int, begin: int) -> Hint:
        """About a parameter, a texture or an argument whose type is missing, or written otherwise.

        ``start`` is the first token of the member, ``begin`` that of the declaration.
        """
        found, previous = self.token(index), self.token(index - 1)
        if found.kind == "(" and "in" in expected:
            return self._of_range(index, start)
        if self.text(begin) == "fn" and found.kind == ":" and "->" in expected:
            return self.replace("the type of a result follows `->`", index, index, " ->")
        if expected != {":"} or self.outline.begins_line(index - 1):
            return ""
        if self.text(begin) == "fn" and found.kind in (",", ")", "=") and previous.kind == "NAME":
            written = f"{previous.text}: float"
            said = f"an argument has a type: `{written}`"
            return self.replace(said, index - 1, index - 1, written)
        return self._of_parameter(index, self.text(start))

    def _of_parameter(self, index: int, word: str) -> Hint:
        """About a parameter or a texture without its type: ``param rough = 0.5``, ``map wood``."""
        name, found = self.token(index - 1), self.token(index)
        if name.kind != "NAME" or name.text == word:
            return ""
        if word == "map" and self.outline.begins_line(index):
            return self._inserted(f"map {name.text} : texture2d", index, " : texture2d")
        value = self.value_end(index + 1)
        type_ = self._type_of(index + 1, value)
        if word != "param" or found.kind != "=" or not type_:
            return ""
        written = f"param {name.text} : {type_} = {self.quoted(index + 1, value)}"
        return self._inserted(written, index, f" : {type_}")

    def _type_of(self, first: int, behind: int) -> str:
        """The type of a value that shows it: a literal, or a call that makes a vector."""
        if behind == first + 1:
            return _LITERALS.get(self.token(first).kind, "")
        is_call = _VECTOR.fullmatch(self.text(first)) and self.text(first + 1) == "("
        return self.text(first) if is_call else ""

    def _inserted(self, written: str, index: int, text: str) -> Hint:
        before = self.token(index - 1)
        said = f"a type follows the name: write `{written}`"
        return self.replace(said, index - 1, index - 1, before.text + text)

    def _of_range(self, index: int, start: int) -> Hint:
        """About ``param rough : float(0, 1)``, of which ``index`` is the bracket."""
        kinds = self.kinds(index - 1, 6)
        if self.text(start) != "param" or kinds != ["NAME", "(", "NUMBER", ",", "NUMBER", ")"]:
            return ""
        written = f"in {self.text(index + 1)}..{self.text(index + 3)}"
        said = f"a range follows the type: `{self.text(index - 1)} {written}`"
        return self.replace(said, index, index + 4, f" {written}")

    def of_header(self, index: int) -> Hint:
        """About ``material M() {``, ``material M = {`` and ``material "M" {``."""
        kinds = self.kinds(index, 3)
        word, name = self.text(index - 2), self.text(index - 1)
        if kinds == ["(", ")", "{"] or kinds[:2] == ["=", "{"]:
            behind = index + kinds.index("{")
            said = f"braces follow the name: `{word} {name} {{ … }}`"
            return self.without(said, index, behind)
        return ""

    def of_quoted_name(self, index: int) -> Hint:
        """About a name in quotes: ``material "M" { … }``."""
        name = self.text(index).strip('"')
        if self.token(index).kind != "STRING" or not name.isidentifier():
            return ""
        said = f"a name has no quotes: `{self.text(index - 1)} {name}`"
        return self.replace(said, index, index, name)

    def of_surface(self, index: int, *, outside: bool) -> Hint:
        """About ``surface M { … }`` and ``class M extends Base { … }`` of other languages."""
        name, behind = self.text(index), index + 1
        if not outside or self.text(index - 1) not in _SURFACES or not name.isidentifier():
            return ""
        head = f"material {name}"
        if self.text(behind) in ("extends", ":") and self.token(behind + 1).kind == "NAME":
            head += f" : {self.text(behind + 1)}"
            behind += 2
        if self.text(behind) != "{":
            return ""
        return self.replace(f"a surface is `{head} {{ … }}`", index - 1, behind - 1, head)

    def of_texture(self, index: int, *, outside: bool) -> Hint:
        """About ``texture wood`` and ``texture wood : texture2d``; ``index`` is the name."""
        name, behind = self.token(index), self.token(index + 1)
        is_row = name.kind == "NAME" and not self.outline.begins_line(index)
        ends = self.outline.begins_line(index + 1) or behind.kind in (";", "}")
        if outside or not is_row or self.text(index - 1) not in _TEXTURES:
            return ""
        if behind.kind == ":":
            said = f"a texture is a member: `map {name.text} : {self.text(index + 2)}`"
            return self.replace(said, index - 1, index - 1, "map")
        if not ends:
            return ""
        written = f"map {name.text} : texture2d"
        return self.replace(f"a texture is a member: `{written}`", index - 1, index, written)
