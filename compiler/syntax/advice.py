"""The edit that is probably wanted where a text cannot be read."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..diagnostics.nearest import nearest
from .chunks import Outline
from .forms import DECLARATIONS, MEMBERS
from .tables import END
from .tokens import Token

_DECLARATORS = frozenset(("let", "var", "const", "auto", "local"))
_IF = "every `if` is a value and has both sides: `if condition then a else b`"
_CHOICE = "there are no statements: `name = if condition then a else b` chooses a value"
_FOLD = "`{0} i in a..b : e` repeats, or `{0} i in a..b up to 16 : e`"
_ITERATE = "`iterate x from start up to n while condition : next` repeats"
_VECTOR = "a vector is written `vec3(x, y, z)`, an array `[a, b]`"

STATEMENTS: Mapping[str, str] = MappingProxyType({"if": _CHOICE, "else": _CHOICE})
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


def _type(word: str) -> str:
    """A type of this language for one that may be another's."""
    from ...stdlib.builtins.elsewhere import TYPES

    return TYPES.get(word, word)


class Advice:
    """Looks at the tokens around a mistake."""

    def __init__(self, outline: Outline) -> None:
        self._outline = outline
        self._tokens = outline.tokens

    def at(self, index: int, expected: set[str], start: int, begin: int) -> str:
        """What to do about the token at ``index``; empty where the rule's help is as good.

        What cannot be read starts at ``start``, and the declaration around it at ``begin``.
        """
        return (
            self._of_body(index, begin)
            or self._of_name(index, expected, start, start == begin)
            or self._of_expression(index, expected, self._text(start))
            or MEMBERS.get(self._text(start), "")
            or self._of_declaration(start, begin)
        )

    def _of_body(self, index: int, begin: int) -> str:
        """About braces around a function's body, as other languages have them."""
        in_braces = self._text(index) == "{" and self._text(index - 1) == "="
        word = self._text(begin)
        return DECLARATIONS[word] if in_braces and word in ("fn", "term") else ""

    def _of_name(self, index: int, expected: set[str], start: int, outside: bool) -> str:
        """About what stands where a member or declaration begins."""
        found, previous, before = (self._token(index - back) for back in range(3))
        if not expected & {"=", "when"}:
            return elsewhere(found.text) if expected & {"param", "material"} else ""
        if found.kind == "==":
            return "an equation is written with a single `=`"
        if hint := elsewhere(previous.text):
            return hint
        if found.text == "in" and (hint := elsewhere(before.text)):
            return hint
        if found.kind in (".", "[") and previous.kind == "NAME":
            return (
                "nothing is changed part by part: an equation gives the whole value, "
                f"`{previous.text} = …`"
            )
        if found.kind == "(" and before.text == "vertex":
            return "what is computed at the vertices is `@vertex e`"
        if previous.kind != "NAME" or self._outline.begins_line(index):
            return ""
        return self._of_two_words(index, start, outside)

    def _of_two_words(self, index: int, start: int, outside: bool) -> str:
        """About a name behind another word, where none belongs."""
        found, previous = self._token(index), self._token(index - 1)
        if previous.text in _DECLARATORS:
            return f"equations need no `{previous.text}`: write `{found.text} = …`"
        word = nearest(previous.text, DECLARATIONS if outside else MEMBERS)
        if word is not None and index - 1 == start:
            return f"did you mean `{word}`?"
        if self._token(index + 1).kind == "(":
            return DECLARATIONS["fn"]
        if found.kind == "NAME" and self._token(index + 1).kind in ("=", ";", "["):
            type_ = _type(previous.text)
            return f"a type stands behind the name: write `{found.text} : {type_} = …`"
        return ""

    def _of_expression(self, index: int, expected: set[str], member: str) -> str:
        """About what stands where an expression is to begin or to go on."""
        found, previous = self._token(index), self._token(index - 1)
        if expected & {"then", "else"} and "param" not in expected:
            return _IF
        if expected == {"NAME"} and previous.text == "in" and member != "param":
            return "spaces are named, `x in world`; a fold is `sum i in a..b : e`"
        if ".." in expected:
            return "a range is written `low..high`"
        if previous.text == "iterate" or "while" in (previous.text, found.text):
            return _ITERATE
        if found.kind == "NAME" and previous.text in ("sum", "product", "min", "max", "any", "all"):
            return _FOLD.format(previous.text)
        if found.kind == "]" and previous.kind == "[":
            return "the length is written: `float[4]`"
        if found.kind == "=" and expected & {")", "+"}:
            return "arguments are given by their position, without names or defaults"
        if found.kind == ":" and "," in expected and ")" in expected:
            return "arguments are given by their position, without names"
        if found.kind == "," and "as" in expected:
            return _VECTOR
        if self._is_cast(index):
            return f"a conversion is a call: `{self._token(index - 2).text}(x)`"
        if found.kind in _FOUND and ("NUMBER" in expected or "+" in expected):
            return _FOUND[found.kind]
        return _FOUND["as"] if found.text == "as" else ""

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
