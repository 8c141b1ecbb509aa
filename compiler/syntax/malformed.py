"""Texts that are nearly tokens, such as ``1.0f`` or ``&&``.

The lexer calls ``mend`` for each of them. It reports the mistake, and returns the token that was
probably meant, so that the rest of the file can still be parsed.
"""

from __future__ import annotations

import re

from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.fixes import Hint, fix_it, write, write_color
from ..diagnostics.source import Span
from .tokens import Token

PERCENT = r"%(?=\s*(?:$|[\n,;)\]}=]|\.\.))"
"""A percent sign after a number that no second operand follows."""

MALFORMED = [
    ("CONFLICT", r"(?m:^)<{7}[^\n]*"),
    ("OTHER_SIDE", r"(?m:^)={7}[\s\S]*?(?:\n>{7}[^\n]*|\Z)"),
    (
        "DIRECTIVE",
        r"#(?:define|undef|include|version|pragma|extension|ifn?def|if|elif|else|endif|line|error)\b[^\n]*",
    ),
    ("HASH", r"#(?![\w])[^\n]*"),
    ("BAD_NAME", r"[^\W\d]\w*"),
    ("PERCENT", rf"(?:[0-9]+(?:\.(?!\.)[0-9]*)?|\.[0-9]+){PERCENT}"),
    (
        "BAD_NUMBER",
        r"(?:[0-9]+(?:\.[0-9]+){2,}|[0-9]+(?:\.(?!\.)[0-9]*)?|\.[0-9]+)(?:[eE][+-][0-9]+)?\w*",
    ),
    ("BAD_COLOR", r"#\w*"),
    ("BAD_STRING", r'"[^"\n]*'),
    ("BAD_COMMENT", r"/\*[\s\S]*"),
    ("FOREIGN", r"&&|\|\||\+\+|\*\*|:=|<>|[=!]==|\.\.=|(?:[-+*/%&|^]|<<|>>)=|::|=>|!(?!=)|[%?]"),
]
"""Tried after the patterns of the grammar and before punctuation."""

_SIMPLE = {
    "BAD_NAME": (rules.BAD_NAME, "NAME", ""),
    "BAD_COLOR": (rules.BAD_COLOR, "COLOR", "#000"),
    "BAD_STRING": (rules.UNFINISHED_TEXT, "STRING", ""),
}
"""The broken rule, and kind and text of the token that is used instead."""

_INSTEAD = {
    "&&": "and", "||": "or", "!": "not", "%": "mod", ":=": "=", "<>": "!=", "===": "==",
    "!==": "!=", "..=": "..", "::": ".",
}  # fmt: skip

_CONFLICT_END = "\n>>>>>>>"
"""The mark behind the side of a merge conflict that is not read."""

_SAME = frozenset(("&&", "||", "!", ":=", "<>", "===", "!=="))
"""Operators whose replacement means the same for all operands."""

_HINTS = {
    "=>": "an equation is written `name = expression`",
    ":=": "an equation is written `name = expression`",
    "..=": "write `..`; a fold leaves out its upper bound",
    "**": "a power is written `pow(x, y)`",
    **dict.fromkeys(
        ("+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="),
        "values do not change: an equation `name = expression` names the new value",
    ),
}


_CHARACTERS = {
    "°": "deg", "×": "*", "·": "*", "÷": "/", "–": "-", "−": "-", "≤": "<=", "≥": ">=", "≠": "!=",
    "\N{LEFT DOUBLE QUOTATION MARK}": '"', "\N{RIGHT DOUBLE QUOTATION MARK}": '"', "π": "pi",
}  # fmt: skip
"""The meaning of characters that word processors and painting programs insert."""


_NEARBY = 80
"""The number of characters around a place that are looked at: the work must not grow."""


def mend(kind: str, word: str, span: Span, report: Report) -> Token | None:
    """Report the mistake; returns the token that was probably meant, or None to leave it out."""
    if kind == "BAD_NUMBER":
        return _number(word, span, report)
    if kind == "PERCENT":
        share = f"{float(word.rstrip('%')) / 100:g}"
        report.add(rules.BAD_NUMBER, span, text=word, hint=write(span, share, sure=True))
        return Token("NUMBER", share, span.start, span.end)
    if kind == "FOREIGN":
        return _foreign(word, span, report)
    if kind == "BAD_COMMENT":
        report.add(rules.UNFINISHED_COMMENT, Span(span.source, span.start, span.start + 2))
        return None
    if kind == "CONFLICT" or (kind == "OTHER_SIDE" and _CONFLICT_END not in word):
        report.add(rules.MERGE_CONFLICT, Span(span.source, span.start, span.start + 7))
    if kind in ("CONFLICT", "OTHER_SIDE"):
        return None
    if kind in ("DIRECTIVE", "HASH"):
        _hash(word, span, report)
        return None
    if kind not in _SIMPLE:
        meant = _CHARACTERS.get(word[0], "")
        first = Span(span.source, span.start, span.start + 1)
        hint = write(first, meant, sure=True) if meant else ""
        report.add(rules.UNKNOWN_CHARACTER, span, character=_character(word[0]), hint=hint)
        return Token("FOREIGN", word, span.start, span.end)
    rule, symbol, instead = _SIMPLE[kind]
    report.add(rule, span, text=word)
    if kind == "BAD_STRING":
        instead = f'{word}"'
    return Token(symbol, instead or word, span.start, span.end)


def _hash(line: str, span: Span, report: Report) -> None:
    """Report a line that begins with `#`: a foreign comment or a preprocessor directive."""
    words = line.split()
    if words[0] in ("#elif", "#else", "#endif") and report.failed:
        return
    sign = Span(span.source, span.start, span.start + 1)
    hint: Hint = fix_it("a comment begins with `//`", (sign, "//"))
    if words[0] != "#":
        hint = _instead_of_directive(line, span)
        report.unread(word.partition("(")[0] for word in words[1:2])
    mark = Span(span.source, span.start, span.start + len(words[0]))
    report.add(rules.UNKNOWN_CHARACTER, mark, character=_character("#"), hint=hint)


def _instead_of_directive(line: str, span: Span) -> Hint:
    """The hint for a preprocessor directive."""
    said = "there is no preprocessor"
    macro = re.match(r"#define\s+(\w+)\(([\w\s,]*)\)\s*(.*)", line)
    if macro:
        arguments = ", ".join(f"{name.strip()}: float" for name in macro[2].split(","))
        body = macro[3].strip()
        function = f"fn {macro[1]}({arguments}) = {body}"
        if not body:
            return f"{said}: a function is `{function}…`"
        return fix_it(f"{said}: a function is `{function}`", (span, function))
    constant = re.match(r"#define\s+(\w+)\s+(\S.*)", line)
    if constant:
        equation = f"{constant[1]} = {constant[2].strip()}"
        return fix_it(f"{said}: a constant is `{equation}`", (span, equation))
    if line.split(maxsplit=1)[0] in ("#version", "#extension", "#pragma", "#line"):
        return fix_it(f"{said}: remove this line", (span, ""))
    return f"{said}: a constant is `name = expression`, a file is imported"


_BITS = r"([0-9.]+)([iuf])(?:8|16|32|64)"
"""A number with its width, as in Rust."""


def _number(word: str, span: Span, report: Report) -> Token:
    from ..units import listed, named

    if re.fullmatch(r"[0-9]+[A-Za-z_]\w*", word) and _is_defined(span):
        name = re.sub("[0-9]+", "", word, count=1)
        begun = fix_it(f"names begin with a letter: `{name}`", (span, name))
        report.add(rules.BAD_NAME, span, text=word, hint=begun)
        return Token("NAME", word, span.start, span.end)
    if re.fullmatch(r"(?=.*[a-fA-F])(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{8})", word):
        report.add(rules.BAD_NUMBER, span, text=word, hint=write_color(span, word))
        return Token("COLOR", f"#{word}", span.start, span.end)
    measured = re.fullmatch(r"([0-9.]+)(°|[A-Za-z]+)", word)
    unit = "" if measured is None else "deg" if measured[2] == "°" else named(measured[2])
    if measured is not None and unit:
        better = f"{measured[1]}{unit}"
        report.add(rules.BAD_NUMBER, span, text=word, hint=write(span, better, sure=True))
        return Token("NUMBER", better, span.start, span.end)
    suffixed = re.fullmatch(_BITS, word)
    digits = suffixed[1] if suffixed else word.rstrip("fFhHlL")
    better = f"{digits}0" if digits.endswith(".") else digits
    proper = better.replace(".", "", 1).isdigit()
    if suffixed and suffixed[2] == "u" and better.isdigit():
        better += "u"
    hint: Hint = write(span, better, sure=True) if proper else ""
    if not proper and measured is not None:
        hint = listed()
    report.add(rules.BAD_NUMBER, span, text=word, hint=hint)
    return Token("NUMBER", better if proper else "0", span.start, span.end)


def _is_defined(span: Span) -> bool:
    """True if the text here is given a value or a type, as only names are."""
    behind = span.source.text[span.end : span.end + _NEARBY]
    return re.match(r"\s*(?:=(?!=)|:)", behind) is not None


def _foreign(word: str, span: Span, report: Report) -> Token:
    instead = _INSTEAD.get(word, "")
    hint: Hint = _HINTS.get(word, "")
    if instead:
        said = _HINTS.get(word, f"write `{instead}`")
        hint = fix_it(said, (span, _set_apart(instead, span)), sure=word in _SAME)
    if word == "?":
        from .foreign_choices import ternary_hint

        hint = ternary_hint(span)
    if word == "++":
        hint = _joined_or_counted(span)
    if word == "=>":
        hint = _lambda(span) or hint
    report.add(rules.FOREIGN_OPERATOR, span, operator=word, hint=hint)
    return Token(instead or "FOREIGN", instead or word, span.start, span.end)


_ARROW = r"(\w+)\s*=\s*\(?\s*(\w+(?:\s*,\s*\w+)*)\s*\)?\s*$"
"""What stands in front of ``=>`` in the function ``f = (x) => x * 2``."""


def _lambda(span: Span) -> str:
    """The hint for ``f = (x) => x * 2``, by the text of its line."""
    line = span.source.text.rfind("\n", 0, span.start) + 1
    head = re.search(_ARROW, span.source.text[max(line, span.start - _NEARBY) : span.start])
    body = span.source.text[span.end : span.end + _NEARBY].partition("\n")[0].strip(" ;")
    if head is None or not body:
        return ""
    arguments = ", ".join(f"{name.strip()}: float" for name in head[2].split(","))
    return f"a function stands outside of all materials: `fn {head[1]}({arguments}) = {body}`"


def _set_apart(word: str, span: Span) -> str:
    """A word with spaces where it would run together with the text beside the place."""
    if not word.isalpha():
        return word
    text = span.source.text
    before, behind = text[max(span.start - 1, 0) : span.start], text[span.end : span.end + 1]
    return f"{' ' * before.isalnum()}{word}{' ' * behind.isalnum()}"


def _joined_or_counted(span: Span) -> Hint:
    """The hint for ``a ++ b``, which joins elsewhere, or for ``a++``, which counts."""
    text, start = span.source.text, max(span.start - _NEARBY, 0)
    before = re.search(r"\w+(?= *$)", text[start : span.start])
    if before and re.match(r" *[\w(\[#.]", text[span.end : span.end + _NEARBY]):
        return fix_it("numbers are added by `+`; arrays are not joined", (span, "+"))
    name = before[0] if before else "x"
    return f"values do not change: an equation gives a new name to `{name} + 1`"


def _character(character: str) -> str:
    """The character as a reader can tell it: its number, and itself where that is harmless."""
    number = f"U+{ord(character):04X}"
    return f"`{character}` ({number})" if character.isprintable() else number
