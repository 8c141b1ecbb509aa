"""Programs with mistakes: all sources of the tree, with tokens and lines changed at random.

``test_robustness.py`` and ``make fuzz`` compile them. Whatever a text says, the compiler either
reports errors or makes shaders that the compilers behind it accept: it neither raises anything
else nor hangs. A program follows from its seed alone.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("examples", "stdlib", "tests")
"""The folders whose programs, at any depth, are changed: they have every kind of declaration."""

TOKEN = re.compile(
    r"\s+|//[^\n]*|[A-Za-z_]\w*|#[0-9a-fA-F]+|[\d.]+\w*|\"[^\"\n]*\"|->|\.\.|[<>=!]=|."
)
EXTREMES = (
    "0", "1", "2147483647", "2147483648", "4294967295u", "4294967296u", "0u", "1e38", "3.5e38",
    "1e-45", "1e-400", "1e400", "0.0", "0x7fffffff", "99999999999999999999", "1e", "360deg",
    "5mm", "1.5turn", "2in", "3px",
)  # fmt: skip
ODD = (
    "(", ")", "{", "}", "[", "]", "<", ">", "..", "=", ":", ",", ".", "->", "@", "@vertex", "with",
    "inherited", "material", "light", "per", "abstract", "texture2d", "mat4", "bool", "vec3[4]",
    "sum i in 0..3 :", "if", "then", "else", "discard when", "target", "\0", "é", "\u2028", "\\",
    '"', "/*", "///", "\ufeff",
)  # fmt: skip

Tokens = list[str]
Change = Callable[[random.Random, Tokens, Sequence[str]], None]


@cache
def files() -> tuple[Path, ...]:
    """The files whose texts are changed."""
    return tuple(path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.burnish")))


@cache
def sources() -> tuple[str, ...]:
    """The texts that are changed."""
    return tuple(path.read_text("utf-8") for path in files())


@cache
def search_path() -> tuple[Path, ...]:
    """The folders by which the imports of these texts are found."""
    return tuple(dict.fromkeys(path.parent for path in files()))


def mutated(seed: int) -> str:
    """A text with one to four changes; every tenth one consists of tokens in any order.

    Every other one has a single change that a compiler may well accept.
    """
    chance = random.Random(seed)
    tokens = TOKEN.findall(chance.choice(sources()))
    others = TOKEN.findall(chance.choice(sources()))
    if seed % 10 == 0:
        return " ".join(chance.choices([*tokens, *ODD], k=chance.randrange(1, 200)))
    if seed % 2:
        chance.choice(GENTLE)(chance, tokens, others)
        return "".join(tokens)
    for _ in range(chance.randrange(1, 5)):
        chance.choice(CHANGES)(chance, tokens, others)
    return "".join(tokens)


def _place(chance: random.Random, tokens: Tokens, wanted: str = r"[^\s/]") -> int:
    """The place of a token that begins like ``wanted``, if there is one, or of any."""
    fitting = [at for at, token in enumerate(tokens) if re.match(wanted, token)]
    return chance.choice(fitting or range(len(tokens))) if tokens else 0


def _delete(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    at = _place(chance, tokens)
    del tokens[at : at + chance.choice((1, 1, 1, 5, 50))]


def _duplicate(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    at, count = _place(chance, tokens), chance.choice((1, 1, 5, 50))
    tokens[at:at] = tokens[at : at + count]


def _swap(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    if tokens:
        one, other = _place(chance, tokens), _place(chance, tokens)
        tokens[one], tokens[other] = tokens[other], tokens[one]


def _number(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    at = _place(chance, tokens, r"\d")
    tokens[at : at + 1] = [chance.choice(EXTREMES)]


def _name(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """One name becomes another one of the file."""
    if tokens:
        at, other = _place(chance, tokens, r"[A-Za-z_]"), _place(chance, tokens, r"[A-Za-z_]")
        tokens[at] = tokens[other]


def _operator(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    at = _place(chance, tokens, r"[-+*/]$")
    tokens[at : at + 1] = [chance.choice(("+", "-", "*", "/", " mod ", "<", " in "))]


def _argument(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """A name becomes a call or a swizzle, or something of it is taken."""
    at = _place(chance, tokens, r"[A-Za-z_]")
    change = chance.choice(("(0.5 * {})", "abs({})", "{}.xx", "{}[1]", "unguarded({})", "-{}"))
    tokens[at : at + 1] = [change.format(tokens[at] if tokens else "")]


def _odd(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    at = _place(chance, tokens)
    tokens[at:at] = [" ", chance.choice(ODD), " "]


def _line(tokens: Tokens, at: int) -> tuple[int, int]:
    """The tokens of the line in which one stands, without the space at its ends."""
    start, end = at, at
    while start > 0 and "\n" not in tokens[start - 1]:
        start -= 1
    while end < len(tokens) and "\n" not in tokens[end]:
        end += 1
    return start, end


def _half_line(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """Nothing stands behind a token in its line, as if somebody were still writing it."""
    at = _place(chance, tokens)
    del tokens[at + 1 : _line(tokens, at)[1]]


def _without_line(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    start, end = _line(tokens, _place(chance, tokens))
    del tokens[start:end]


def _line_elsewhere(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """A line stands once more, behind another one."""
    if tokens:
        start, end = _line(tokens, _place(chance, tokens))
        behind = _line(tokens, _place(chance, tokens))[1]
        tokens[behind:behind] = ["\n", *tokens[start:end]]


def _misspelt(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """A name that nothing has, in one place: a base, an import, a type, a slot."""
    at = _place(chance, tokens, r"[A-Za-z_]")
    tokens[at : at + 1] = [f"{tokens[at] if tokens else ''}_gone"]


def _unfinished(chance: random.Random, tokens: Tokens, _others: Sequence[str]) -> None:
    """The file ends early."""
    del tokens[_place(chance, tokens) :]


def _splice(chance: random.Random, tokens: Tokens, others: Sequence[str]) -> None:
    """A piece of another file."""
    at, start = _place(chance, tokens), chance.randrange(len(others) or 1)
    tokens[at:at] = others[start : start + chance.choice((3, 20, 200))]


GENTLE: Sequence[Change] = (_number, _name, _operator, _argument)
CHANGES: Sequence[Change] = (
    _delete, _duplicate, _swap, _number, _name, _name, _odd, _splice,
    _half_line, _half_line, _without_line, _line_elsewhere, _misspelt, _unfinished,
)  # fmt: skip
