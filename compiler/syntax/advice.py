"""The edit that is probably wanted where a text cannot be read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..diagnostics.nearest import nearest
from .ast import MEMBERS
from .expectations import may_begin_declaration, may_begin_member
from .foreign_syntax import Row, rewritten, types
from .forms import DECLARATIONS, FOLDS
from .lalr_tables import END
from .outline import Outline
from .tokens import RESERVED, Token

_IF = "every `if` is a value and has both sides: `if condition then a else b`"
_CHOICE = "there are no statements: `name = if condition then a else b` chooses a value"
_FOLD = "`{0} i in a..b : e` repeats, or `{0} i in a..b up to 16 : e`"
_ITERATE = "`iterate x from start up to n while condition : next` repeats"
_VECTOR = "a vector is written `vec3(x, y, z)`, an array `[a, b]`"
_PLACES = (
    "places are not written: the compiler assigns them, and the reflection names them; "
    "`extern block` is for those of the host's"
)
_OPENED_BY = {")": "(", "]": "[", "}": "{"}
_MARKS: Mapping[str, str] = MappingProxyType(
    {"@": _PLACES, "[": "nothing is said in brackets: how loops and stages are made is not written"}
)
"""By the mark that begins an attribute elsewhere."""
_CONVERSIONS = frozenset(("float", "int", "uint", "bool"))

STATEMENTS: Mapping[str, str] = MappingProxyType({"if": _CHOICE, "else": _CHOICE, "then": _IF})
"""What there is in place of a statement, by a reserved word that it begins with."""

_FOUND: Mapping[str, str] = MappingProxyType(
    {
        "as": "another meaning is given in parentheses: `(x as type)`",
        "{": f"{_VECTOR}, a structure `Name(a, b)`",
        "STRING": "quoted texts are for imports; a colour is written `#ff0000`",
    }
)
"""By the token that is found where an expression or an operator could be."""


def elsewhere(word: str) -> str:
    """What there is in place of a statement or declaration that begins with ``word`` elsewhere."""
    from ...stdlib.builtins.elsewhere import KEYWORDS

    return KEYWORDS.get(word, "")


def _called(word: str) -> str:
    """What there is for a function that is called elsewhere for what it does."""
    from ...stdlib.builtins.elsewhere import FUNCTIONS

    instead = FUNCTIONS.get(word)
    return instead.hint if instead is not None else ""


class Advice:
    """Looks at the tokens around a mistake."""

    def __init__(self, outline: Outline) -> None:
        self._outline = outline
        self._tokens = outline.tokens

    def at(self, index: int, expected: set[str], start: int, begin: int) -> str:
        """What to do about the token at ``index``; empty where the rule's help is as good.

        What cannot be read starts at ``start``, and the declaration around it at ``begin``.
        """
        ways: tuple[Callable[[], str], ...] = (
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
        """The word that the token in front of ``index`` was to be, where that begins something."""
        previous = self._token(index - 1)
        is_word = previous.kind == "NAME" and self._token(index).kind == "NAME"
        if not is_word or "=" not in expected or index - 1 != start:
            return ""
        if self._outline.begins_line(index) or elsewhere(previous.text) or previous.text in types():
            return ""
        return nearest(previous.text, DECLARATIONS if start == begin else MEMBERS) or ""

    def _of_decimals(self, index: int) -> str:
        """About a decimal comma."""
        found, comma, before = (self._token(index - back) for back in range(3))
        kinds = [found.kind, comma.kind, before.kind]
        if kinds != ["NUMBER", ",", "NUMBER"] or found.start != before.end + 1:
            return ""
        return f"decimals follow a point: `{before.text}.{found.text}`"

    def _of_marks(self, index: int, expected: set[str]) -> str:
        """About marks that are one too many, or the wrong ones."""
        found, previous = self._token(index), self._token(index - 1)
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if found.kind in _OPENED_BY and begins and found.kind not in expected:
            return f"no `{_OPENED_BY[found.kind]}` is open here"
        at_start = self._outline.begins_line(index) or previous.kind in ("{", ";", ",")
        if found.kind == "=" and begins and at_start:
            return "a name stands in front: `name = expression`"
        if found.text in MEMBERS and may_begin_declaration(expected):
            return _placed(found.text)
        if found.kind == "," == previous.kind and "NUMBER" in expected:
            return "between these commas an argument is missing"
        if found.kind == ";" and {",", ")"} <= expected:
            return "arguments are parted by commas"
        if found.kind in ("NAME", "NUMBER", "COLOR") and expected & {")", "]"} and "+" in expected:
            return self._of_missing_mark(index)
        return ""

    def _of_missing_mark(self, index: int) -> str:
        """About a value directly behind another, unless a word of another language is between."""
        found = self._token(index)
        if self._is_cast(index) or elsewhere(found.text) or found.text in ("as", "while"):
            return ""
        return f"a comma or an operator is missing in front of `{found.text}`"

    def _of_header(self, index: int, expected: set[str]) -> str:
        """About what stands behind the name of a material, light or pass."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        if "blend" not in expected or "{" not in expected:
            return ""
        if found.kind == "NAME" and following.kind in ("{", ":"):
            return f"a name is one word: `{previous.text}{found.text}`"
        return _dashed(previous, found, following)

    def _of_typed(self, index: int, expected: set[str], start: int, begin: int) -> str:
        """About ``param``, ``map`` and ``attribute``, members of structures, arguments, lights."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        word, within = self._text(start), self._text(begin)
        if expected == {":"}:
            if found.kind == "NAME" and (word in MEMBERS or within in ("struct", "fn", "term")):
                first = start if word in MEMBERS and index - start < 4 else index - 1
                return rewritten(self._row(first))
            if found.kind == ",":
                return "each name has a declaration of its own"
            if found.kind == ">":
                return f"a type parameter names its family: `{previous.text}: floats`"
            if found.kind == "=" and within == "rig":
                return (
                    f"the kind of a light stands behind `:`: `{previous.text} : {following.text}`"
                )
        if expected == {"="} and found.kind == ":":
            return f"a value stands behind `=`: `{previous.text} = …`"
        if found.kind == "=" and within == "struct":
            return "members of a structure have no values of their own"
        if found.kind == ":" and word in MEMBERS and "per" in expected:
            return _PLACES
        if found.kind == "NUMBER" and expected == {">", "NAME"}:
            return "an array is written `float[3]`"
        return ""

    def _of_body(self, index: int, begin: int) -> str:
        """About braces around a function's body, as other languages have them."""
        in_braces = self._text(index) == "{" and self._text(index - 1) == "="
        word = self._text(begin)
        return DECLARATIONS[word] if in_braces and word in ("fn", "term") else ""

    def _of_name(self, index: int, expected: set[str], start: int, outside: bool) -> str:
        """About what stands where a member or declaration begins."""
        found, previous, before = (self._token(index - back) for back in range(3))
        begins = may_begin_member(expected) or may_begin_declaration(expected)
        if begins and found.kind in _MARKS:
            return _MARKS[found.kind]
        if self._text(start) in MEMBERS and not self._outline.begins_line(index):
            return ""
        if not expected & {"=", "when"}:
            return elsewhere(found.text) if begins else ""
        if found.kind == "==":
            return "an equation is written with a single `=`"
        if hint := elsewhere(previous.text):
            return self._of_row(index, start, previous.text) or hint
        if found.text in ("in", "{") and (hint := elsewhere(before.text)):
            return hint
        if found.kind == "," and "=" in expected:
            return "each name has an equation of its own"
        if found.kind in (".", "(") and self._follows_value(index - 1):
            return f"an operator is missing in front of `{previous.text}`"
        if found.kind in (".", "[") and previous.kind == "NAME":
            return (
                "nothing is changed part by part: an equation gives the whole value, "
                f"`{previous.text} = …`"
            )
        if found.kind == "(" and before.text == "vertex":
            return "what is computed at the vertices is `@vertex e`"
        if previous.kind == "NAME" and previous.text in DECLARATIONS and not outside:
            return f"`{previous.text}` stands outside of other declarations"
        if previous.kind != "NAME" or self._outline.begins_line(index):
            return ""
        dashed = _dashed(previous, found, self._token(index + 1))
        return dashed or self._of_two_words(index, start, outside)

    def _follows_value(self, index: int) -> bool:
        """Whether a name stands directly behind a value, on its line."""
        before = self._token(index - 1).kind
        is_called = before == "NAME" and not self._outline.begins_line(index - 1)
        ends = before in ("NUMBER", "COLOR", ")", "]") or is_called
        is_name = self._token(index).kind == "NAME"
        return (
            ends and is_name and not self._outline.begins_line(index) and not self._is_cast(index)
        )

    def _of_row(self, index: int, start: int, first: str) -> str:
        """About a declaration whose first word says nothing by itself."""
        if first in ("out", "varying"):
            return ""
        if self._token(index).kind != "NAME" or self._outline.begins_line(index):
            return ""
        return rewritten(self._row(min(start, index - 1))) if index - start < 4 else ""

    def _of_two_words(self, index: int, start: int, outside: bool) -> str:
        """About what follows a word in which no equation can go on."""
        found, previous = self._token(index), self._token(index - 1)
        if found.kind == "(":
            if self._token(index + 1).kind == "STRING":
                return f"a value from the host is a parameter: `param {previous.text} : type`"
            effect = "nothing is called for its effect: `name = f(x)`" if index - 1 == start else ""
            return _called(previous.text) or effect
        if outside and previous.text in MEMBERS:
            return _placed(previous.text)
        row = self._row(index - 1)
        if previous.text == "as":
            return "what is imported keeps its name"
        if self._token(index + len(row.words) - 1).kind == "(":
            return DECLARATIONS["fn"]
        if found.kind == "NAME" and self._goes_on(index + len(row.words) - 1):
            return rewritten(row)
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
        return Row(words, length, self._token(end).kind == "=")

    def _of_expression(self, index: int, expected: set[str], member: str) -> str:
        """About what stands where an expression is to begin or to go on."""
        found, previous = self._token(index), self._token(index - 1)
        if expected & {"then", "else"} and not may_begin_member(expected):
            return _IF
        if expected == {"NAME"}:
            return self._of_missing_name(index, member)
        if ".." in expected:
            return "a range is written `low..high`"
        if found.kind == "..":
            return "numbers in a row stand in `sum i in a..b : e`, and in the range of a parameter"
        if hint := self._of_loop(index, expected) or self._of_argument(index, expected):
            return hint
        if found.kind == "]" and previous.kind == "[":
            return "the length is written: `float[4]`"
        if found.kind == "," and "as" in expected:
            return _VECTOR
        if self._is_cast(index):
            name = self._text(index - 2)
            return f"a conversion is a call: `{types().get(name, name)}(x)`"
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
            return f"what is repeated stands behind a colon: {_FOLD.format('sum')}"
        return ""

    def _of_argument(self, index: int, expected: set[str]) -> str:
        """About arguments that are given by name."""
        found = self._token(index)
        if found.kind == "=" and expected & {")", "+"}:
            return "arguments are given by their position, without names or defaults"
        if found.kind == ":" and "," in expected and ")" in expected:
            return "arguments are given by their position, without names"
        return ""

    def _of_operand(self, index: int, expected: set[str]) -> str:
        """About a token that no expression has in its place, by what it is."""
        found, previous, following = (self._token(index + step) for step in (0, -1, 1))
        if found.kind == "STRING" and found.text.startswith('"#'):
            return f"a colour is written without quotes: `{found.text[1:-1]}`"
        if found.text == "as" and types().get(following.text) in _CONVERSIONS:
            return f"a conversion is a call: `{types()[following.text]}(x)`"
        if found.kind == "{" and previous.kind == "NAME" and "+" in expected:
            return f"a structure is made by a call: `{previous.text}(a, b)`"
        if found.kind in _FOUND and ({"NUMBER", "NAME"} <= expected or "+" in expected):
            return _FOUND[found.kind]
        if found.text == "as":
            return _FOUND["as"]
        return elsewhere(found.text) if found.kind == "NAME" and "+" in expected else ""

    def _of_missing_name(self, index: int, member: str) -> str:
        """About what stands where only a name can: a type, a space, what a texture is at first."""
        found, previous, before = (self._token(index - back) for back in range(3))
        if found.kind == "STRING" and member == "map":
            return "the host binds the picture; until then a texture is `white`, `black` …"
        if previous.text == "in" and member != "param":
            return "spaces are named, `x in world`; a fold is `sum i in a..b : e`"
        is_value = found.kind in ("COLOR", "NUMBER", "(", "-", "[", "true", "false")
        if is_value and previous.kind == ":" and before.text == member:
            return f"a value stands behind `=`: `{before.text} = …`"
        return ""

    def _of_reserved(self, index: int, expected: set[str]) -> str:
        """About a reserved word where a value begins or goes on."""
        found = self._token(index)
        if found.kind == "mod" and self._token(index + 1).kind == "(":
            return "the remainder stands between its operands: `x mod y`"
        if found.kind == "if" and "+" in expected:
            return "the condition stands in front: `if condition then a else b`"
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


def _dashed(previous: Token, found: Token, following: Token) -> str:
    """About a name with a dash in it."""
    if found.kind != "-" or previous.kind != "NAME" or following.kind != "NAME":
        return ""
    return f"names have no `-`: `{previous.text}_{following.text}`"
