"""The work for a text grows with its length, whatever is wrong with it."""

from __future__ import annotations

import sys
import tracemalloc
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import FrameType
from unittest.mock import patch

import pytest

import burnish
from burnish.compiler.diagnostics import nearest
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax import incremental
from burnish.compiler.syntax.incremental import KnownSections
from burnish.compiler.syntax.parser import parse


def calls(work: Callable[[], object]) -> int:
    """The number of functions that are called while ``work`` runs, and no text is known yet."""
    count = 0

    def profile(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(profile)
    try:
        with patch.object(incremental, "KNOWN_SECTIONS", KnownSections()):
            work()
    finally:
        sys.setprofile(None)
    return count


def material(members: str) -> str:
    return f"material M {{\n{members}\n}}"


SHAPES: dict[str, Callable[[int], str]] = {
    "signs": lambda n: material(f"alpha = {'- ' * n}1"),
    "unread slots": lambda n: material("\n".join(f"a{i} = 1" for i in range(n))),
    "unread misspelt slots": lambda n: material("\n".join(f"colour{i} = 1" for i in range(n))),
    "unknown members": lambda n: material("\n".join(f"a{i} = normal.foo{i}" for i in range(n))),
    "unknown types": lambda n: material("\n".join(f"a{i} : flaot{i} = 1" for i in range(n))),
    "broken members": lambda n: material("\n".join(f"a{i} = = 1" for i in range(n))),
    "open brackets": lambda n: material("\n".join(f"a{i} = (1" for i in range(n))),
    "words of declarations": lambda n: "material " * n,
    "foreign declarations": lambda n: "\n".join(f"const vec3 a{i} = 1;" for i in range(n)),
    "foreign loops": lambda n: "for (int i = 0; i < 3; i++) { x += 1; }\n" * n,
}


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
def test_twice_the_text_is_twice_the_work(shape: Callable[[int], str]) -> None:
    burnish.check(shape(10))
    once, twice = (calls(partial(burnish.check, shape(n))) for n in (400, 800))
    assert twice < 2.3 * once


def letters(source: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> int:
    """The number of pairs of letters that are compared when a text is checked."""
    compared = 0
    search = nearest.nearest

    def counted(name: str, known: set[str]) -> str | None:
        nonlocal compared
        compared += len(name) * sum(map(len, known))
        return search(name, known)

    monkeypatch.setattr(nearest, "nearest", counted)
    burnish.check(source, search_path=(folder,))
    return compared


def unknown_names(count: int, start: str) -> str:
    return "\n".join(f"{start}a{i} = {start}unk{i}" for i in range(count))


@pytest.mark.parametrize("start", ["", "x" * 30], ids=["short", "long"])
def test_unknown_names_are_compared_with_known_ones_only_so_often(
    start: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(nearest, "_MOST_COMPARED", 10**6)
    assert 10**6 < letters(material(unknown_names(400, start)), tmp_path, monkeypatch) < 2.5e6


def test_the_names_of_all_files_count_together(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(nearest, "_MOST_COMPARED", 10**6)
    imported = []
    for name in "ABC":
        text = f"material {name} {{ {unknown_names(400, '')} }}\n"
        (tmp_path / f"{name}.burnish").write_text(text)
        imported.append(f'import "{name}.burnish".{{{name}}}\nmaterial My{name} : {name} {{ }}\n')
    assert 10**6 < letters("".join(imported), tmp_path, monkeypatch) < 2.5e6


def test_names_of_very_many_letters_are_like_no_other() -> None:
    """Comparing takes the product of two lengths, or more."""
    name = "albedo" * 10
    assert nearest.nearest(name[:-1], [name]) == name
    assert nearest.nearest(f"{name}o", [name]) is None
    assert nearest.nearest(name, [f"{name}o"]) is None


LONG = {
    "operators": "a++ " * 40_000,
    "numbers": "20.5.1 = " * 40_000,
    "one name": "a" * 10_000_000,
}


@pytest.mark.parametrize("text", LONG.values(), ids=LONG)
def test_one_long_line_of_mistakes_is_read_at_once(text: str) -> None:
    report = Report()
    parse(Source("long", text), report)
    assert report.failed


def test_a_long_comment_takes_no_memory_of_its_own() -> None:
    """The memory is a few times that of the text, which the lexer and the parser keep."""
    burnish.check("material M { }")
    comment = "/* " + "x " * 500_000 + "*/"
    tracemalloc.start()
    assert burnish.check(f"{comment} material M {{ }}") == ()
    assert tracemalloc.get_traced_memory()[1] < 10 * len(comment)
    tracemalloc.stop()


@pytest.mark.parametrize("suffix", ["", "u"])
def test_a_literal_of_thousands_of_digits_is_too_large(suffix: str) -> None:
    type_ = {"": "int", "u": "uint"}[suffix]
    (found,) = burnish.check(material(f"n = {'9' * 5000}{suffix}"))
    assert render(found).splitlines()[0] == f"error[B0402]: `…` does not fit into {type_}"


def test_zeros_in_front_of_a_literal_are_no_digits() -> None:
    assert burnish.check(material(f"alpha = {'0' * 5000}1")) == ()
