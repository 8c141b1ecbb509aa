"""Hints for syntax errors within expressions.

``Advice`` asks here for a token that stands where an expression is to begin or to go on.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from ..diagnostics.fixes import Edit, Fix, FixIt, Hint, fix_it
from ..diagnostics.source import Span
from ..units import ANGLES, UNITS
from .expectations import may_begin_member
from .foreign_choices import unfinished_if
from .foreign_syntax import elsewhere, types
from .forms import FOLDS
from .quoting import closed, shortened
from .token_view import TokenView
from .tokens import RESERVED

_NUMBER = rf"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:{'|'.join(UNITS)})?"
_RANGE = re.compile(rf"\s*([\[(]?)\s*({_NUMBER})\s*(?:-|–|,|:|;|to\b)\s*({_NUMBER})(?:\s*([\])]))?")
"""Two numbers with something else than ``..`` between them."""
_FAR = 12
"""The number of tokens before a mistake among which its range may begin."""


def fold_form(word: str) -> str:
    """The form of the fold that begins with ``word``."""
    return f"`{word} i in a..b : e` repeats, or `{word} i in a..b up to 16 : e`"


def range_hint(view: TokenView, index: int) -> Hint:
    """About a range before ``index`` that is not written ``low..high``: ``0-1``, ``[0, 1]``."""
    for before in range(index - 1, index - _FAR, -1):
        if view.text(before) == "in":
            found = _RANGE.match(view.source.text, view.token(before).end)
            if found is None or bool(found[1]) != bool(found[4]):
                break
            start = found.start(1) if found[1] else found.start(2)
            written = f"{found[2]}..{found[3]}"
            span = Span(view.source, start, found.end())
            return fix_it(f"a range is written with two dots: `{written}`", (span, written))
    return "a range is written `low..high`"


def called_fold(view: TokenView, index: int) -> Hint:
    """About ``sum(i in 0..4) e`` and ``sum(i in 0..4 : e)``, of which ``index`` is the ``0``."""
    fold, opening = index - 4, index - 3
    if view.kinds(opening, 3) != ["(", "NAME", "NAME"] or FOLDS.get(view.text(fold)) != "in":
        return ""
    closing = view.closing(opening)
    if view.token(closing).kind != ")":
        return ""
    head = view.quoted(opening + 1, closing)
    open_, close = view.span(opening, opening), view.span(closing, closing)
    if ":" in view.kinds(opening, closing - opening):
        said = f"parentheses belong around the whole loop: `({view.text(fold)} {head})`"
        before = Span(view.source, view.token(fold).start, view.token(fold).start)
        return fix_it(said, (before, "("), (open_, " "))
    edits = [Edit(open_, " ")]
    body = closing + 1
    end = view.value_end(body)
    if view.token(body).kind == ":":
        edits.append(Edit(close, ""))
        body += 1
    elif view.token(body).kind == "{":
        end = view.closing(body)
        if view.token(end).kind != "}":
            return ""
        edits += [Edit(close, " :"), Edit(view.span(body, body), ""), Edit(view.span(end, end), "")]
        body += 1
    else:
        edits.append(Edit(close, " :"))
    shown = f"{view.text(fold)} {head} : {view.quoted(body, end)}"
    return FixIt(f"the head of a loop has no parentheses: `{shown}`", (Fix(tuple(edits)),))


_ITERATE = "`iterate x from start up to n while condition : next` repeats"
_VECTOR = "a vector is written `vec3(x, y, z)`, an array `[a, b]`"
_CONVERSIONS = frozenset(("float", "int", "uint", "bool"))

_FOUND: Mapping[str, str] = MappingProxyType(
    {
        "as": "`as` stands in parentheses: `(x as type)`",
        "{": f"{_VECTOR}, a structure `Name(a, b)`",
        "STRING": "quoted texts are only used in imports; a colour is written `#ff0000`, and a "
        "member of an enumeration `Mode.mix`",
    }
)
"""Hints by the token that stands where an expression or an operator was expected."""


_ARRAY = ("NAME", "<", "NAME", ",", "NUMBER", ">")
_ARRAY_OF = ("NAME", "<", "NAME", ">")


class ExpressionAdvice(TokenView):
    """Finds hints by looking at the tokens around a mistake in an expression."""

    def of_decimals(self, index: int) -> Hint:
        """About a decimal comma."""
        found, comma, before = (self.token(index - back) for back in range(3))
        kinds = [found.kind, comma.kind, before.kind]
        if kinds != ["NUMBER", ",", "NUMBER"] or found.start != before.end + 1:
            return ""
        number = f"{before.text}.{found.text}"
        return self.replace(
            f"the decimal separator is a point: `{number}`", index - 2, index, number
        )

    def of_measure(self, index: int) -> Hint:
        """About a unit that stands at ``index``, apart from its number."""
        found, previous = self.token(index), self.token(index - 1)
        is_unit = found.kind == "NAME" and found.text in UNITS and previous.kind == "NUMBER"
        if not is_unit or self.outline.begins_line(index):
            return ""
        what = "an angle" if found.text in ANGLES else "a length"
        measure = previous.text + found.text
        return self.replace(f"{what} is one word: `{measure}`", index - 1, index, measure)

    def of_array(self, index: int) -> Hint:
        """About ``array<float, 3>(…)``, of which ``index`` is the length."""
        elements = array_elements(self, index - 4)
        if elements is None or self.token(index).kind != "NUMBER":
            return ""
        inside = self.written(*elements)
        said = f"an array is written `[{self.quoted(*elements)}]`"
        return self.replace(said, index - 4, elements[1], f"[{inside}]") if inside else said

    def of_missing_mark(self, index: int) -> str:
        """About a value directly after another one."""
        found = self.token(index)
        if self.is_cast(index) or elsewhere(found.text) or found.text in ("as", "while"):
            return ""
        if self.text(index - 1) in (*FOLDS, "iterate", "while"):
            return ""
        return f"a comma or an operator is missing before `{found.text}`"

    def at(self, index: int, expected: set[str], member: str) -> Hint:
        """The hint for the token at ``index``, in a member that begins with the word ``member``.

        An expression is to begin or to go on there.
        """
        found, previous = self.token(index), self.token(index - 1)
        if expected & {"then", "else"} and not may_begin_member(expected):
            return unfinished_if(self, index, expected)
        if expected == {"NAME"}:
            return self._of_missing_name(index, member)
        if ".." in expected:
            return range_hint(self, index)
        if found.kind == "..":
            return "`..` is used in folds, `sum i in a..b : e`, and in the range of a parameter"
        if hint := self._of_loop(index, expected) or self._of_argument(index, expected):
            return hint
        if found.kind == "]" and previous.kind == "[":
            return "write the length: `float[4]`"
        if found.kind == "," and "as" in expected:
            return _VECTOR
        if self.is_cast(index):
            return self._of_cast(index)
        if found.kind in RESERVED and found.kind not in ("true", "false"):
            return self._of_reserved(index, expected)
        return self._of_operand(index, expected)

    def _of_loop(self, index: int, expected: set[str]) -> str:
        """About the parts of a fold or an iteration."""
        found, previous = self.token(index), self.token(index - 1)
        if previous.text == "iterate" or "while" in (previous.text, found.text):
            return _ITERATE
        if found.kind == "NAME" and previous.text in FOLDS:
            return fold_form(previous.text)
        if ":" in expected and "from" in expected and found.kind == "{":
            return f"the body of a loop follows a colon: {fold_form('sum')}"
        return ""

    def _of_argument(self, index: int, expected: set[str]) -> Hint:
        """About arguments that are given by name in another way."""
        found, name = self.token(index), self.token(index - 1)
        if found.kind not in ("=", ":") or not {")", ","} <= expected:
            return ""
        if found.kind == ":" and "=" in expected:
            said = f"an argument is given by name with `=`: `{name.text} = …`"
            return self.replace(said, index - 1, index, f"{name.text} =")
        return "only an argument has a name in a call: `f(x, width = 2)`"

    def _of_cast(self, index: int) -> Hint:
        """About ``(float)x``, which can be rewritten where the operand is one token."""
        name = self.text(index - 2)
        type_, operand = types().get(name, name), self.token(index)
        said = f"a conversion is a call: `{type_}(x)`"
        if operand.kind == "(" or self.token(index + 1).kind in (".", "(", "["):
            return said
        return self.replace(said, index - 3, index, f"{type_}({operand.text})")

    def _of_as(self, index: int) -> Hint:
        """About ``x as float``, likewise."""
        type_, operand = types()[self.text(index + 1)], self.token(index - 1)
        said = f"a conversion is a call: `{type_}(x)`"
        if operand.kind not in ("NAME", "NUMBER") or self.token(index - 2).kind == ".":
            return said
        return self.replace(said, index - 1, index + 1, f"{type_}({operand.text})")

    def _of_operand(self, index: int, expected: set[str]) -> Hint:
        """The hint for a token that no expression has in its place, by the kind of token."""
        found, previous, following = (self.token(index + step) for step in (0, -1, 1))
        if found.kind == "|" and "NUMBER" in expected:
            return self._of_bars(index)
        if hint := self.of_measure(index):
            return hint
        if found.kind == "STRING" and found.text.startswith('"#'):
            color = found.text[1:-1]
            said = f"a colour is written without quotes: `{color}`"
            return self.replace(said, index, index, color)
        if found.text == "as" and types().get(following.text) in _CONVERSIONS:
            return self._of_as(index)
        if found.kind == "{" and previous.kind == "NAME" and "+" in expected:
            return self._of_braces(index)
        if found.kind in _FOUND and ({"NUMBER", "NAME"} <= expected or "+" in expected):
            return _FOUND[found.kind]
        if found.text == "as":
            return _FOUND["as"]
        return elsewhere(found.text) if found.kind == "NAME" and "+" in expected else ""

    def _of_missing_name(self, index: int, member: str) -> Hint:
        """The hint for a token where only a name can stand: a type, a space, a default."""
        found, previous, before = (self.token(index - back) for back in range(3))
        if found.kind == "STRING" and member == "map":
            return "the host binds the picture; the default is a colour such as `white` or `black`"
        if previous.text == "in" and member != "param":
            return called_fold(self, index) or (
                "`in` needs the name of a space, as in `x in world`; a fold is `sum i in a..b : e`"
            )
        is_value = found.kind in ("COLOR", "NUMBER", "(", "-", "[", "true", "false")
        if is_value and previous.kind == ":" and before.text == member:
            said = f"a value follows `=`: `{before.text} = …`"
            return self.replace(said, index - 1, index - 1, "=")
        return ""

    def _of_reserved(self, index: int, expected: set[str]) -> Hint:
        """About a reserved word where a value begins or goes on."""
        found = self.token(index)
        if found.kind == "mod" and self.token(index + 1).kind == "(":
            return self._of_mod(index)
        if found.kind == "if" and "+" in expected:
            return "the condition comes first: `if condition then a else b`"
        return f"`{found.text}` is a reserved word" if "NUMBER" in expected else ""

    def _of_braces(self, index: int) -> Hint:
        """About ``vec3 { 1, 0, 0 }``, of which ``index`` is the brace."""
        name, closing = self.text(index - 1), self.closing(index)
        inside = self.written(index + 1, closing)
        has_names = {"=", ":"} & set(self.kinds(index, closing - index))
        if self.token(closing).kind != "}" or not inside or has_names:
            return f"a structure is made by a call: `{name}(a, b)`"
        written = f"{types().get(name, name)}({inside.strip()})"
        said = f"a value is made by a call: `{shortened(written)}`"
        return self.replace(said, index - 1, closing, written)

    def _of_mod(self, index: int) -> Hint:
        """About ``mod(x, y)``, whose name stands at ``index``."""
        said = "`mod` stands between its operands: `{}`"
        opening, closing = index + 1, self.closing(index + 1)
        behind = self.value_end(opening + 1)
        left, right = self.written(opening + 1, behind), self.written(behind + 1, closing)
        if self.token(behind).kind != "," or not left or not right:
            return said.format("x mod y")
        written = f"({closed(left)} mod {closed(right)})"
        return self.replace(said.format(shortened(written[1:-1])), index, closing, written)

    def _of_bars(self, index: int) -> Hint:
        """About ``|x|``, of which the first bar stands at ``index``."""
        end = self.value_end(index + 1)
        bars = (i for i in range(index + 2, end) if self.token(i).kind == "|")
        behind = next(bars, index)
        if value := self.written(index + 1, behind):
            said = f"it is `abs({shortened(value)})` here"
            return self.replace(said, index, behind, f"abs({value})")
        return ""


def array_elements(view: TokenView, first: int) -> tuple[int, int] | None:
    """The first element of an array as in other languages, and the bracket behind the last one.

    That is ``{1, 2}``, ``float[](1, 2)``, ``float[2](1, 2)`` or ``array<f32, 2>(1, 2)``.
    """
    kinds = view.kinds(first, 7)
    heads = ((), ("NAME", "[", "]"), ("NAME", "[", "NUMBER", "]"), _ARRAY, _ARRAY_OF)
    for head in heads:
        opening = first + len(head)
        brackets = "(" if head else "{"
        if tuple(kinds[: len(head)]) == head and view.token(opening).kind == brackets:
            closing = view.closing(opening)
            is_closed = view.token(closing).kind in (")", "}")
            return (opening + 1, closing) if is_closed else None
    return None
