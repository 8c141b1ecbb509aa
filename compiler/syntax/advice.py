"""Hints for syntax errors: what was probably meant, and where possible the edit that writes it.

``SyntaxErrors`` asks here after it has decided which token is wrong.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..diagnostics.fixes import Hint, fix_it
from ..diagnostics.nearest import nearest
from ..diagnostics.source import Source, Span
from .ast import MEMBERS
from .expectations import may_begin_declaration, may_begin_member
from .foreign_syntax import Row, rewritten, types
from .forms import DECLARATIONS, FOLDS
from .lalr_tables import END
from .outline import Outline
from .tokens import RESERVED, Token

_IF = "every `if` needs both branches: `if condition then a else b`"
_CHOICE = "there are no statements: choose a value by `name = if condition then a else b`"
_FOLD = "`{0} i in a..b : e` repeats, or `{0} i in a..b up to 16 : e`"
_ITERATE = "`iterate x from start up to n while condition : next` repeats"
_VECTOR = "a vector is written `vec3(x, y, z)`, an array `[a, b]`"
_PLACES = (
    "the compiler assigns bindings, and the reflection lists them: remove this; "
    "only an `extern block` has bindings of its own"
)
_OPENED_BY = {")": "(", "]": "[", "}": "{"}
_MARKS: Mapping[str, str] = MappingProxyType(
    {"@": _PLACES, "[": "attributes such as `[unroll]` do not exist: remove this"}
)
"""Hints about attributes of other languages, by the mark that they begin with."""
_CONVERSIONS = frozenset(("float", "int", "uint", "bool"))

STATEMENTS: Mapping[str, str] = MappingProxyType({"if": _CHOICE, "else": _CHOICE, "then": _IF})
"""What to write instead of a statement, by the reserved word that it begins with."""

_FOUND: Mapping[str, str] = MappingProxyType(
    {
        "as": "`as` stands in parentheses: `(x as type)`",
        "{": f"{_VECTOR}, a structure `Name(a, b)`",
        "STRING": "quoted texts are only used in imports; a colour is written `#ff0000`",
    }
)
"""Hints by the token that stands where an expression or an operator was expected."""


_BRACKETS = {"(": ")", "[": "]"}


def elsewhere(word: str) -> str:
    """What to write instead of a statement of another language that begins with ``word``."""
    from ...stdlib.builtins.elsewhere import KEYWORDS

    return KEYWORDS.get(word, "")


def _called(word: str) -> str:
    """What to write instead of a function that other languages call for its effect."""
    from ...stdlib.builtins.elsewhere import FUNCTIONS

    instead = FUNCTIONS.get(word)
    return instead.hint if instead is not None else ""


class Advice:
    """Finds hints by looking at the tokens around a mistake."""

    def __init__(self, outline: Outline, source: Source) -> None:
        self._outline = outline
        self._source = source
        self._tokens = outline.tokens

    def at(self, index: int, expected: set[str], start: int, begin: int) -> Hint:
        """The hint for the token at ``index``; empty if the rule's own help is as good.

        What cannot be read starts at ``start``, and the declaration around it at ``begin``.
        """
        ways: tuple[Callable[[], Hint], ...] = (
            lambda: self._of_body(index, begin),
            lambda: self._of_decimals(index),
            lambda: self._of_marks(index, expected),
            lambda: self._of_header(index, expected),
            lambda: self._of_typed(index, expected, start, begin),
            lambda: self._of_name(index, expected, start, start == begin),
            lambda: self._of_expression(index, expected, self._text(start)),
            lambda: MEMBERS[word].form if (word := self._text(start)) in MEMBERS else "",
            lambda: self._of_declaration(start, begin),
            lambda: "" if self._outline.begins_line(start) else elsewhere(self._text(start - 1)),
        )
        return next((hint for way in ways if (hint := way())), "")

    def misspelt(self, index: int, expected: set[str], start: int, begin: int) -> str:
        """The word of a declaration or member that is misspelt before ``index``, if one is."""
        previous = self._token(index - 1)
        is_word = previous.kind == "NAME" and self._token(index).kind == "NAME"
        if not is_word or "=" not in expected or index - 1 != start:
            return ""
        if self._outline.begins_line(index) or elsewhere(previous.text) or previous.text in types():
            return ""
        return nearest(previous.text, DECLARATIONS if start == begin else MEMBERS) or ""

    def _tokens_span(self, first: int, last: int) -> Span:
        """From the beginning of one token to the end of another."""
        return Span(self._source, self._token(first).start, self._token(last).end)

    def _replace(self, said: str, first: int, last: int, text: str, *, sure: bool = False) -> Hint:
        """A hint to write ``text`` in place of the tokens from ``first`` to ``last``."""
        return fix_it(said, (self._tokens_span(first, last), text), sure=sure)

    def _behind_brackets(self, index: int) -> int:
        """The token behind the brackets that open at ``index``; ``index`` itself if none do."""
        if self._token(index).kind not in _BRACKETS:
            return index
        depth, end = self._outline.depths[index], index + 1
        while end < len(self._tokens) and self._outline.depths[end] > depth:
            end += 1
        return end + (self._token(end).kind in _BRACKETS.values())

    def _without(self, said: str, first: int, behind: int) -> Hint:
        """A hint to remove the tokens from ``first`` up to ``behind``."""
        return self._replace(said, first, min(behind, len(self._tokens)) - 1, "")

    def _of_decimals(self, index: int) -> Hint:
        """About a decimal comma."""
        found, comma, before = (self._token(index - back) for back in range(3))
        kinds = [found.kind, comma.kind, before.kind]
        if kinds != ["NUMBER", ",", "NUMBER"] or found.start != before.end + 1:
            return ""
        number = f"{before.text}.{found.text}"
        return self._replace(
            f"the decimal separator is a point: `{number}`", index - 2, index, number
        )

    def _of_marks(self, index: int, expected: set[str]) -> Hint:
        """About punctuation that is wrong or superfluous."""
        found, previous = self._token(index), self._token(index - 1)
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if found.kind in _OPENED_BY and begins and found.kind not in expected:
            return self._without(f"no `{_OPENED_BY[found.kind]}` is open here", index, index + 1)
        at_start = self._outline.begins_line(index) or previous.kind in ("{", ";", ",")
        if found.kind == "=" and begins and at_start:
            return "an equation begins with a name: `name = expression`"
        if found.text in MEMBERS and may_begin_declaration(expected):
            return _placed(found.text)
        if found.kind == "," == previous.kind and "NUMBER" in expected:
            return "an argument is missing between these commas"
        if found.kind == ";" and {",", ")"} <= expected:
            return self._replace("arguments are separated by commas", index, index, ",")
        if found.kind in ("NAME", "NUMBER", "COLOR") and expected & {")", "]"} and "+" in expected:
            return self._of_missing_mark(index)
        return ""

    def _of_missing_mark(self, index: int) -> str:
        """About a value directly after another one."""
        found = self._token(index)
        if self._is_cast(index) or elsewhere(found.text) or found.text in ("as", "while"):
            return ""
        return f"a comma or an operator is missing before `{found.text}`"

    def _of_header(self, index: int, expected: set[str]) -> Hint:
        """About what follows the name of a material, light or pass."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        if "blend" not in expected or "{" not in expected:
            return ""
        if found.kind == "NAME" and following.kind in ("{", ":"):
            name = previous.text + found.text
            return self._replace(f"a name is one word: `{name}`", index - 1, index, name)
        return self._dashed(index)

    def _of_typed(self, index: int, expected: set[str], start: int, begin: int) -> Hint:
        """About ``param``, ``map`` and ``attribute``, members of structures, arguments, lights."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        word, within = self._text(start), self._text(begin)
        if expected == {":"}:
            if found.kind == "NAME" and (word in MEMBERS or within in ("struct", "fn", "term")):
                first = start if word in MEMBERS and index - start < 4 else index - 1
                return rewritten(self._row(first), in_body=start != begin)
            if found.kind == ",":
                return "each name needs a declaration of its own"
            if found.kind == ">":
                name = f"{previous.text}: floats"
                said = f"a type parameter needs a family of types: `{name}`"
                return self._replace(said, index - 1, index - 1, name)
            if found.kind == "=" and within == "rig":
                entry = f"{previous.text} : {following.text}"
                said = f"the kind of a light follows `:`: `{entry}`"
                return self._replace(said, index, index, ":")
        if expected == {"="} and found.kind == ":":
            said = f"a value follows `=`: `{previous.text} = …`"
            return self._replace(said, index, index, "=")
        if found.kind == "=" and within == "struct":
            return "members of a structure have no default values"
        if found.kind == ":" and word in MEMBERS and "per" in expected:
            return self._without(_PLACES, index, self._behind_brackets(index + 2))
        if found.kind == "NUMBER" and expected == {">", "NAME"}:
            return self._of_length(index)
        return ""

    def _of_length(self, index: int) -> Hint:
        """About a length among the arguments of a type: ``array<float, 3>``."""
        said = "an array is written `float[3]`"
        kinds = [self._token(index + step).kind for step in range(-4, 2)]
        if kinds != ["NAME", "<", "NAME", ",", "NUMBER", ">"]:
            return said
        element = types().get(self._text(index - 2), self._text(index - 2))
        return self._replace(said, index - 4, index + 1, f"{element}[{self._text(index)}]")

    def _of_body(self, index: int, begin: int) -> str:
        """About braces around a function's body, as other languages have them."""
        in_braces = self._text(index) == "{" and self._text(index - 1) == "="
        word = self._text(begin)
        return DECLARATIONS[word] if in_braces and word in ("fn", "term") else ""

    def _of_name(self, index: int, expected: set[str], start: int, outside: bool) -> Hint:
        """About what stands where a member or declaration begins."""
        found, previous, before = (self._token(index - back) for back in range(3))
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if begins and found.kind in _MARKS:
            opens = index + 2 if found.kind == "@" else index
            return self._without(_MARKS[found.kind], index, self._behind_brackets(opens))
        if self._text(start) in MEMBERS and not self._outline.begins_line(index):
            return ""
        if not expected & {"=", "when"}:
            return elsewhere(found.text) if begins else ""
        if found.kind == "==":
            return self._replace("an equation is written with a single `=`", index, index, "=")
        if hint := elsewhere(previous.text):
            return self._of_row(index, start, previous.text, outside) or hint
        if found.text in ("in", "{") and (hint := elsewhere(before.text)):
            return hint
        if found.kind == "," and "=" in expected:
            return "each name needs an equation of its own"
        if found.kind in (".", "(") and self._follows_value(index - 1):
            return f"an operator is missing before `{previous.text}`"
        if found.kind in (".", "[") and previous.kind == "NAME":
            return (
                "values are not changed in parts: an equation gives the whole value, "
                f"`{previous.text} = …`"
            )
        if found.kind == "(" and before.text == "vertex":
            return "write `@vertex e` to compute `e` at the vertices"
        if previous.kind == "NAME" and previous.text in DECLARATIONS and not outside:
            return f"`{previous.text}` belongs at the top level of a file"
        if previous.kind != "NAME" or self._outline.begins_line(index):
            return ""
        return self._dashed(index) or self._of_two_words(index, start, outside)

    def _dashed(self, index: int) -> Hint:
        """About a name with a dash in it."""
        kinds = [self._token(index + step).kind for step in (-1, 0, 1)]
        if kinds != ["NAME", "-", "NAME"]:
            return ""
        name = f"{self._text(index - 1)}_{self._text(index + 1)}"
        return self._replace(f"names have no `-`: `{name}`", index - 1, index + 1, name)

    def _follows_value(self, index: int) -> bool:
        """Whether a name stands directly behind a value, on its line."""
        before = self._token(index - 1).kind
        is_called = before == "NAME" and not self._outline.begins_line(index - 1)
        ends = before in ("NUMBER", "COLOR", ")", "]") or is_called
        is_name = self._token(index).kind == "NAME"
        return (
            ends and is_name and not self._outline.begins_line(index) and not self._is_cast(index)
        )

    def _of_row(self, index: int, start: int, first: str, outside: bool) -> Hint:
        """About a declaration whose first word says nothing by itself."""
        if first in ("out", "varying"):
            return ""
        if self._token(index).kind != "NAME" or self._outline.begins_line(index):
            return ""
        row = self._row(min(start, index - 1))
        return rewritten(row, in_body=not outside) if index - start < 4 else ""

    def _of_two_words(self, index: int, start: int, outside: bool) -> Hint:
        """About what follows a word in which no equation can go on."""
        found, previous = self._token(index), self._token(index - 1)
        if found.kind == "(":
            if self._token(index + 1).kind == "STRING":
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
            return self._without(said, index - 1, index + 1) if found.kind == "NAME" else said
        if self._token(index + len(row.words) - 1).kind == "(":
            return DECLARATIONS["fn"]
        if found.kind == "NAME" and self._goes_on(index + len(row.words) - 1):
            return rewritten(row, in_body=not outside)
        return ""

    def _goes_on(self, index: int) -> bool:
        """Whether the token behind a declared name belongs there elsewhere, or begins a line."""
        return self._token(index).kind in ("=", ":", ";", "[", ",") or self._outline.begins_line(
            index
        )

    def _row(self, first: int) -> Row:
        """The names in a row from ``first`` on."""
        end = first + 1
        while self._token(end).kind == "NAME" and not self._outline.begins_line(end):
            end += 1
        words = [self._text(index) for index in range(first, end)]
        length = ""
        if [self._token(end + step).kind for step in range(3)] == ["[", "NUMBER", "]"]:
            length, end = self._text(end + 1), end + 3
        span = self._tokens_span(first, end - 1)
        return Row(words, length, self._token(end).kind == "=", span)

    def _of_expression(self, index: int, expected: set[str], member: str) -> Hint:
        """About what stands where an expression is to begin or to go on."""
        found, previous = self._token(index), self._token(index - 1)
        if expected & {"then", "else"} and not may_begin_member(expected):
            return _IF
        if expected == {"NAME"}:
            return self._of_missing_name(index, member)
        if ".." in expected:
            return "a range is written `low..high`"
        if found.kind == "..":
            return "`..` is used in folds, `sum i in a..b : e`, and in the range of a parameter"
        if hint := self._of_loop(index, expected) or self._of_argument(index, expected):
            return hint
        if found.kind == "]" and previous.kind == "[":
            return "write the length: `float[4]`"
        if found.kind == "," and "as" in expected:
            return _VECTOR
        if self._is_cast(index):
            return self._of_cast(index)
        if found.kind in RESERVED and found.kind not in ("true", "false"):
            return self._of_reserved(index, expected)
        return self._of_operand(index, expected)

    def _of_loop(self, index: int, expected: set[str]) -> str:
        """About the parts of a fold or an iteration."""
        found, previous = self._token(index), self._token(index - 1)
        if previous.text == "iterate" or "while" in (previous.text, found.text):
            return _ITERATE
        if found.kind == "NAME" and previous.text in FOLDS:
            return _FOLD.format(previous.text)
        if ":" in expected and "from" in expected and found.kind == "{":
            return f"the body of a loop follows a colon: {_FOLD.format('sum')}"
        return ""

    def _of_argument(self, index: int, expected: set[str]) -> str:
        """About arguments that are given by name."""
        found = self._token(index)
        if found.kind == "=" and expected & {")", "+"}:
            return "arguments are given by position, without names and without defaults"
        if found.kind == ":" and "," in expected and ")" in expected:
            return "arguments are given by position, without names"
        return ""

    def _of_cast(self, index: int) -> Hint:
        """About ``(float)x``, which can be rewritten where the operand is one token."""
        name = self._text(index - 2)
        type_, operand = types().get(name, name), self._token(index)
        said = f"a conversion is a call: `{type_}(x)`"
        if operand.kind == "(" or self._token(index + 1).kind in (".", "(", "["):
            return said
        return self._replace(said, index - 3, index, f"{type_}({operand.text})")

    def _of_as(self, index: int) -> Hint:
        """About ``x as float``, likewise."""
        type_, operand = types()[self._text(index + 1)], self._token(index - 1)
        said = f"a conversion is a call: `{type_}(x)`"
        if operand.kind not in ("NAME", "NUMBER") or self._token(index - 2).kind == ".":
            return said
        return self._replace(said, index - 1, index + 1, f"{type_}({operand.text})")

    def _of_operand(self, index: int, expected: set[str]) -> Hint:
        """About a token that no expression has in its place, by what it is."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        if found.kind == "STRING" and found.text.startswith('"#'):
            color = found.text[1:-1]
            said = f"a colour is written without quotes: `{color}`"
            return self._replace(said, index, index, color)
        if found.text == "as" and types().get(following.text) in _CONVERSIONS:
            return self._of_as(index)
        if found.kind == "{" and previous.kind == "NAME" and "+" in expected:
            return f"a structure is made by a call: `{previous.text}(a, b)`"
        if found.kind in _FOUND and ({"NUMBER", "NAME"} <= expected or "+" in expected):
            return _FOUND[found.kind]
        if found.text == "as":
            return _FOUND["as"]
        return elsewhere(found.text) if found.kind == "NAME" and "+" in expected else ""

    def _of_missing_name(self, index: int, member: str) -> Hint:
        """About what stands where only a name can: a type, a space, what a texture is at first."""
        found, previous, before = (self._token(index - back) for back in range(3))
        if found.kind == "STRING" and member == "map":
            return "the host binds the picture; the default is a colour such as `white` or `black`"
        if previous.text == "in" and member != "param":
            return (
                "`in` needs the name of a space, as in `x in world`; a fold is `sum i in a..b : e`"
            )
        is_value = found.kind in ("COLOR", "NUMBER", "(", "-", "[", "true", "false")
        if is_value and previous.kind == ":" and before.text == member:
            said = f"a value follows `=`: `{before.text} = …`"
            return self._replace(said, index - 1, index - 1, "=")
        return ""

    def _of_reserved(self, index: int, expected: set[str]) -> str:
        """About a reserved word where a value begins or goes on."""
        found = self._token(index)
        if found.kind == "mod" and self._token(index + 1).kind == "(":
            return "`mod` stands between its operands: `x mod y`"
        if found.kind == "if" and "+" in expected:
            return "the condition comes first: `if condition then a else b`"
        return f"`{found.text}` is a reserved word" if "NUMBER" in expected else ""

    def _is_cast(self, index: int) -> bool:
        """Whether a name in parentheses stands directly in front, as in ``(float)x``."""
        before = [self._token(index - back).kind for back in (3, 2, 1)]
        return before == ["(", "NAME", ")"] and self._token(index).kind in ("NUMBER", "NAME", "(")

    def _of_declaration(self, start: int, begin: int) -> str:
        """How the declaration around is written, where that is what the mistake is about."""
        word = self._text(begin)
        inside = word in ("struct", "rig", "extern")
        if start != begin and not inside:
            return ""
        return DECLARATIONS.get(word, "")

    def _text(self, index: int) -> str:
        return self._token(index).text

    def _token(self, index: int) -> Token:
        """The token at ``index``; outside of the file one for its end."""
        if 0 <= index < len(self._tokens):
            return self._tokens[index]
        return Token(END, "", 0, 0)


def _placed(word: str) -> str:
    """Where a member belongs that begins with ``word``."""
    return f"`{word}` belongs in {MEMBERS[word].places}"
