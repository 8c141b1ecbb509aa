"""Hints for syntax errors: the probable meaning, and where possible the edit that writes it.

``SyntaxErrors`` asks here after it has decided which token is wrong.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..diagnostics.fixes import Hint
from ..diagnostics.nearest import nearest
from ..diagnostics.source import Source
from .ast import MEMBERS
from .equation_advice import EquationAdvice
from .expectations import may_begin_declaration, may_begin_member
from .expression_advice import ExpressionAdvice, array_elements
from .foreign_choices import if_before
from .foreign_functions import ENTRY_POINT, function_hint
from .foreign_syntax import QUALIFIERS, Row, elsewhere, rewritten, types
from .forms import DECLARATIONS
from .lalr_tables import END
from .outline import Outline
from .token_view import TokenView

_PLACES = (
    "the compiler assigns bindings, and the reflection lists them: remove this; "
    "only an `extern block` has bindings of its own"
)
_LAYOUTS: Mapping[str, str] = MappingProxyType(
    {
        "in": "an input from the mesh is `attribute name : type` in a material; what goes from one "
        "stage to the next is not declared",
        "out": "a pass writes to `target name : format = e`; what goes from one stage to the next "
        "is not declared",
        "uniform": "a value that the host sets is `param name : type` in a material, a texture "
        "`map name : texture2d`; the compiler lays out their blocks",
    }
)
"""The replacement for ``layout(…)``, by the word behind it."""
_STAGES = frozenset(("vertex", "fragment", "compute"))
"""The names of stages that WGSL writes behind ``@`` in front of an entry point."""
_EXTENDS = frozenset(("extends", "inherits", "implements", "from", "is"))
"""Words of other languages in front of a base."""
_OPENED_BY = {")": "(", "]": "[", "}": "{"}
_MARKS: Mapping[str, str] = MappingProxyType(
    {"@": _PLACES, "[": "attributes such as `[unroll]` do not exist: remove this"}
)
"""Hints about attributes of other languages, by the mark that they begin with."""


def _called(word: str) -> str:
    """The hint for a function that other languages call for its effect."""
    from ...stdlib.other_names import FUNCTIONS

    instead = FUNCTIONS.get(word)
    return instead.hint if instead is not None else ""


class Advice(TokenView):
    """Finds hints by looking at the tokens around a mistake."""

    def __init__(self, outline: Outline, source: Source) -> None:
        super().__init__(outline, source)
        self._expressions = ExpressionAdvice(outline, source)
        self._equations = EquationAdvice(outline, source)

    def at(self, index: int, expected: set[str], start: int, begin: int) -> Hint:
        """The hint for the token at ``index``; empty if the rule's own help is as good.

        What cannot be read starts at ``start``, and the declaration around it at ``begin``.
        """
        # Within parentheses `=` does not make an equation of a name, but an argument.
        outer = expected - {"="} if ")" in expected else expected
        ways: tuple[Callable[[], Hint], ...] = (
            lambda: self._of_body(index, begin),
            lambda: self._expressions.of_decimals(index),
            # A unit apart from its number was read as the name of the next equation.
            lambda: self._expressions.of_measure(index - 1) if "=" in expected else "",
            lambda: self._expressions.of_array(index),
            lambda: self._of_marks(index, expected),
            lambda: self._of_header(index, expected),
            lambda: self._equations.of_type(index, outer, start, begin),
            lambda: self._of_typed(index, outer, start, begin),
            lambda: self._of_name(index, outer, start, start == begin),
            lambda: self._expressions.at(index, expected, self.text(start)),
            lambda: MEMBERS[word].form if (word := self.text(start)) in MEMBERS else "",
            lambda: self._of_declaration(start, begin),
            lambda: "" if self.outline.begins_line(start) else elsewhere(self.text(start - 1)),
        )
        return next((hint for way in ways if (hint := way())), "")

    def misspelt(self, index: int, expected: set[str], start: int, begin: int) -> str:
        """The word of a declaration or member that is misspelt before ``index``, if one is."""
        previous = self.token(index - 1)
        is_word = previous.kind == "NAME" and self.token(index).kind == "NAME"
        if not is_word or "=" not in expected or index - 1 != start:
            return ""
        if self.outline.begins_line(index) or elsewhere(previous.text) or previous.text in types():
            return ""
        return nearest(previous.text, DECLARATIONS if start == begin else MEMBERS) or ""

    def _of_marks(self, index: int, expected: set[str]) -> Hint:
        """About punctuation that is wrong or superfluous."""
        found, previous = self.token(index), self.token(index - 1)
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if found.kind in _OPENED_BY and begins and found.kind not in expected:
            return self.without(f"no `{_OPENED_BY[found.kind]}` is open here", index, index + 1)
        at_start = self.outline.begins_line(index) or previous.kind in ("{", ";", ",")
        if self.kinds(index, 2) == ["-", "-"] and begins and at_start:
            return self.replace("a comment begins with `//`", index, index + 1, "//")
        if found.kind == "=" and begins and at_start:
            return "an equation begins with a name: `name = expression`"
        if found.text in MEMBERS and may_begin_declaration(expected):
            return _placed(found.text)
        if found.kind == "," == previous.kind and "NUMBER" in expected:
            return "an argument is missing between these commas"
        if found.kind == ";" and {",", ")"} <= expected:
            return self.replace("arguments are separated by commas", index, index, ",")
        if found.kind in ("NAME", "NUMBER", "COLOR") and expected & {")", "]"} and "+" in expected:
            return self._expressions.of_missing_mark(index)
        return ""

    def _of_header(self, index: int, expected: set[str]) -> Hint:
        """The hint for a token behind the name of a material, light or pass."""
        found, previous, following = (self.token(index + step) for step in (0, -1, 1))
        if expected == {"NAME"} and previous.text in DECLARATIONS:
            return self._equations.of_quoted_name(index)
        if "blend" not in expected or "{" not in expected:
            return ""
        if hint := self._equations.of_header(index):
            return hint
        if found.kind == "NAME" and following.kind in ("{", ":"):
            name = previous.text + found.text
            return self.replace(f"a name is one word: `{name}`", index - 1, index, name)
        if found.text in _EXTENDS and following.kind == "NAME":
            said = f"a base follows a colon: `{previous.text} : {following.text}`"
            return self.replace(said, index, index, ":")
        begins = self.outline.begins_line(index) and found.kind != END
        if begins and self.outline.begins_member(index):
            first = next(i for i in range(index - 1, -1, -1) if self.outline.begins_line(i))
            head = self.quoted(first, index)
            return f"the members need braces: `{head} {{ … }}`"
        return self._dashed(index)

    def behind_comparison(self, index: int) -> int | None:
        """The token behind ``if x = 1 then a else b``, if ``index`` is the ``=`` of that."""
        if self.token(index).kind != "=" or if_before(self, index) < 0:
            return None
        behind = self.value_end(index + 1)
        return behind if "then" in self.kinds(index, behind - index) else None

    def of_comparison(self, index: int) -> Hint:
        """About such a ``=``."""
        return self.replace("equality is `==`", index, index, "==")

    def of_blending(self, index: int) -> Hint:
        """About settings of a target's blending that begin at ``index`` without their braces."""
        behind = self.behind_settings(index)
        braced = f"{{ {self.quoted(index, behind)} }}"
        said = f"settings stand in braces: `blend {braced}`"
        return self.replace(said, index, behind - 1, braced)

    def behind_settings(self, index: int) -> int:
        """The token behind settings, ``source = one, mask = rgb``, that begin at ``index``."""
        while self.token(index + 3).kind == "," and self.token(index + 5).kind == "=":
            index += 4
        return index + 3

    def _of_typed(self, index: int, expected: set[str], start: int, begin: int) -> Hint:
        """About ``param``, ``map`` and ``attribute``, members of structures, arguments, lights."""
        found, previous, following = (self.token(index + step) for step in (0, -1, 1))
        word, within = self.text(start), self.text(begin)
        if expected == {":"}:
            if found.kind == "NAME" and (word in MEMBERS or within in ("struct", "fn", "term")):
                if within in ("fn", "term") and previous.text in QUALIFIERS:
                    return self._of_qualifier(index)
                first = start if word in MEMBERS and index - start < 4 else index - 1
                return rewritten(self._row(first), in_body=start != begin)
            if found.kind == "," and within != "fn":
                return "each name needs a declaration of its own"
            if found.kind == ">":
                name = f"{previous.text}: floats"
                said = f"a type parameter needs a family of types: `{name}`"
                return self.replace(said, index - 1, index - 1, name)
            if found.kind == "=" and within == "rig":
                entry = f"{previous.text} : {following.text}"
                said = f"the kind of a light follows `:`: `{entry}`"
                return self.replace(said, index, index, ":")
        if expected <= {"=", "."} and found.kind == ":":
            said = f"a value follows `=`: `{previous.text} = …`"
            return self.replace(said, index, index, "=")
        if found.kind == "=" and within == "enum":
            return (
                "members have no values: their numbers are 0, 1, 2 … in the order in which "
                "they stand"
            )
        if found.kind == "=" and within == "struct":
            return "members of a structure have no default values"
        if found.kind == ":" and word in MEMBERS and "per" in expected:
            return self.without(_PLACES, index, self.behind_brackets(index + 2))
        if found.kind == "NUMBER" and expected == {">", "NAME"}:
            return self._of_length(index)
        return ""

    def _of_qualifier(self, index: int) -> Hint:
        """About ``inout x: float`` or ``inout float x`` among arguments."""
        names = self.kinds(index, 2) == ["NAME", "NAME"]
        name, type_ = (index + 1, index) if names else (index, index + 2)
        if self.kinds(name, 1) + self.kinds(type_, 1) != ["NAME", "NAME"]:
            return ""
        written = f"{self.text(name)}: {types().get(self.text(type_), self.text(type_))}"
        said = f"arguments are values, and nothing changes them: `{written}`"
        return self.replace(said, index - 1, max(name, type_), written)

    def _of_length(self, index: int) -> Hint:
        """About a length among the arguments of a type: ``array<float, 3>``."""
        said = "an array is written `float[3]`"
        kinds = [self.token(index + step).kind for step in range(-4, 2)]
        if kinds != ["NAME", "<", "NAME", ",", "NUMBER", ">"]:
            return said
        element = types().get(self.text(index - 2), self.text(index - 2))
        return self.replace(said, index - 4, index + 1, f"{element}[{self.text(index)}]")

    def _of_body(self, index: int, begin: int) -> Hint:
        """About a function with a body in braces, as other languages have it."""
        word = self.text(begin)
        if word == "fn" and self.text(begin + 1) == "main":
            return ENTRY_POINT
        if word not in ("fn", "term") or self.text(index) != "{":
            return ""
        return function_hint(self, begin + 1) if word == "fn" else DECLARATIONS[word]

    def _of_name(self, index: int, expected: set[str], start: int, outside: bool) -> Hint:
        """The hint for a token where a member or declaration begins."""
        found, previous, before = (self.token(index - back) for back in range(3))
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if begins and found.kind in _MARKS:
            return self._of_attribute(index)
        if self.text(start) in MEMBERS and not self.outline.begins_line(index):
            return ""
        if hint := self._of_beginning(index, expected, start, outside):
            return hint
        if not expected & {"=", "when"}:
            return elsewhere(found.text) if begins else ""
        if found.kind == "==":
            return self.replace("an equation is written with a single `=`", index, index, "=")
        if previous.text == "layout" and found.kind == "(":
            return self._of_layout(index)
        if hint := elsewhere(previous.text):
            return self._of_row(index, start, previous.text, outside) or hint
        if found.text in ("in", "{") and (hint := elsewhere(before.text)):
            return hint
        if found.kind == "," and "=" in expected:
            return "each name needs an equation of its own"
        if hint := self._of_value(index):
            return hint
        if previous.kind == "NAME" and previous.text in DECLARATIONS and not outside:
            return f"`{previous.text}` belongs at the top level of a file"
        if previous.kind != "NAME" or self.outline.begins_line(index):
            return ""
        return self._dashed(index) or self._of_two_words(index, start, outside)

    def _of_beginning(self, index: int, expected: set[str], start: int, outside: bool) -> Hint:
        """About a function, a word of another language, or a name without its ``=``."""
        hint = self._equations.of_colon(index, start)
        if not hint and "=" in expected:
            hint = (
                self._equations.of_surface(index, outside=outside)
                or self._equations.of_texture(index, outside=outside)
                or ("" if outside else self._equations.of_missing_equals(index, start))
            )
        return hint or self._of_function(index, outside)

    def _of_attribute(self, index: int) -> Hint:
        """About ``@group(0)``, ``@fragment`` or ``[unroll]`` in front of a declaration."""
        mark = self.token(index).kind
        if self.text(index + 1) in _STAGES:
            return ENTRY_POINT
        opens = index + 2 if mark == "@" else index
        return self.without(_MARKS[mark], index, self.behind_brackets(opens))

    def _of_value(self, index: int) -> str:
        """About a value in front of ``index`` that is called, changed, or follows another one."""
        found, previous, before = (self.token(index - back) for back in range(3))
        if found.kind in (".", "(") and self._follows_value(index - 1):
            return f"an operator is missing before `{previous.text}`"
        if found.kind in (".", "[") and previous.kind == "NAME":
            return (
                "values are not changed in parts: an equation gives the whole value, "
                f"`{previous.text} = …`"
            )
        if found.kind == "(" and before.text == "vertex":
            return "write `@vertex e` to compute `e` at the vertices"
        return ""

    def _of_layout(self, index: int) -> str:
        """The hint for ``layout(…) in vec2 uv`` and the like, by the word behind parentheses."""
        return _LAYOUTS.get(self.text(self.closing(index) + 1)) or elsewhere("layout")

    def _of_function(self, index: int, outside: bool) -> Hint:
        """About a function with its type in front: ``float f(float x) { … }``."""
        kinds = self.kinds(index - 1, 3)
        words = (*types(), "void", "def", "func", "function")
        has_type = kinds == ["NAME", "NAME", "("] and self.text(index - 1) in words
        if not has_type or self.outline.begins_line(index):
            return ""
        return function_hint(self, index, outside=outside)

    def _dashed(self, index: int) -> Hint:
        """About a name with a dash in it."""
        kinds = [self.token(index + step).kind for step in (-1, 0, 1)]
        if kinds != ["NAME", "-", "NAME"]:
            return ""
        name = f"{self.text(index - 1)}_{self.text(index + 1)}"
        return self.replace(f"names have no `-`: `{name}`", index - 1, index + 1, name)

    def _follows_value(self, index: int) -> bool:
        """True if a name stands directly behind a value, on its line."""
        before = self.token(index - 1).kind
        is_called = before == "NAME" and not self.outline.begins_line(index - 1)
        ends = before in ("NUMBER", "COLOR", ")", "]") or is_called
        is_name = self.token(index).kind == "NAME"
        return ends and is_name and not self.outline.begins_line(index) and not self.is_cast(index)

    def _of_row(self, index: int, start: int, first: str, outside: bool) -> Hint:
        """About a declaration whose first word says nothing by itself."""
        if first in ("in", "out", "varying"):
            return ""
        if self.token(index).kind != "NAME" or self.outline.begins_line(index):
            return ""
        row = self._row(min(start, index - 1))
        return rewritten(row, in_body=not outside) if index - start < 4 else ""

    def _of_two_words(self, index: int, start: int, outside: bool) -> Hint:
        """The hint for a token behind a word in which no equation can go on."""
        found, previous = self.token(index), self.token(index - 1)
        if found.kind == "(":
            if self.token(index + 1).kind == "STRING":
                return f"a value that the host sets is a parameter: `param {previous.text} : type`"
            effect = (
                "a call is always part of an equation: `name = f(x)`" if index - 1 == start else ""
            )
            return _called(previous.text) or effect
        if outside and previous.text in MEMBERS:
            return _placed(previous.text)
        row = self._row(index - 1)
        if previous.text == "as":
            said = "an import has no `as`: the name stays as it is"
            return self.without(said, index - 1, index + 1) if found.kind == "NAME" else said
        if self.token(index + len(row.words) - 1).kind == "(":
            return function_hint(self, index + len(row.words) - 2, outside=outside)
        if found.kind == "NAME" and self._goes_on(index + len(row.words) - 1):
            return rewritten(row, in_body=not outside)
        return ""

    def _goes_on(self, index: int) -> bool:
        """True if the token behind a declared name belongs there elsewhere, or begins a line."""
        return self.token(index).kind in ("=", ":", ";", "[", ",") or self.outline.begins_line(
            index
        )

    def _row(self, first: int) -> Row:
        """The names in a row from ``first`` on."""
        end = first + 1
        while self.token(end).kind == "NAME" and not self.outline.begins_line(end):
            end += 1
        words = [self.text(index) for index in range(first, end)]
        length = ""
        if [self.token(end + step).kind for step in range(3)] == ["[", "NUMBER", "]"]:
            length, end = self.text(end + 1), end + 3
        return Row(words, length, self._row_value(end), self.span(first, end - 1))

    def _row_value(self, end: int) -> str:
        """The value of ``= …`` at ``end``, as messages show it; empty if there is none."""
        if self.token(end).kind != "=":
            return ""
        elements = array_elements(self, end + 1)
        if elements is not None:
            return f"[{self.quoted(*elements)}]"
        return self.quoted(end + 1, self.value_end(end + 1))

    def _of_declaration(self, start: int, begin: int) -> str:
        """The form of the declaration around, where the mistake is about that."""
        word = self.text(begin)
        inside = word in ("struct", "enum", "rig", "extern")
        if start != begin and not inside:
            return ""
        return DECLARATIONS.get(word, "")


def _placed(word: str) -> str:
    """The place of a member that begins with ``word``."""
    return f"`{word}` belongs in {MEMBERS[word].places}"
