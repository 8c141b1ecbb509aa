"""Compares the marks of a page with the facts; ``test_pages.py`` shows what is not true."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Diagnostic
from burnish.compiler.diagnostics.render import render

from .facts import Equation, diagnostics, equations
from .marks import Mark, Program, programs
from .values import is_value, written


def untrue(page: Path) -> list[str]:
    """A message, which begins with the place, for each thing that a page says wrongly.

    Raises ``BadPageError`` for a page that cannot be tested as it is written.
    """
    return [message for program in programs(page) for message in _untrue(program)]


def _untrue(program: Program) -> Iterator[str]:
    known, reported = equations(program.text), diagnostics(program.text)
    for mark in program.marks:
        for complaint in _of_mark(mark, known.get(mark.line)):
            yield f"{program.place(mark.line)}: {complaint}"
    codes = {mark.line: mark.codes for mark in program.marks}
    for line in sorted(reported.keys() | codes.keys()):
        for complaint in _of_codes(codes.get(line, ()), reported.get(line, [])):
            yield f"{program.place(line)}: {complaint}"


def _of_mark(mark: Mark, equation: Equation | None) -> Iterator[str]:
    """The complaints about the type and the value that a mark claims."""
    if not mark.type and not mark.value:
        return
    if equation is None:
        yield "no equation of a material ends on this line, so the mark is about nothing"
    elif not equation.type:
        yield f"`{equation.name}` has no type and no value, because it is wrong"
    else:
        if mark.type and mark.type != equation.type:
            yield f"`{equation.name}` is `{equation.type}`, and not `{mark.type}`"
        value = equation.value
        if mark.value and value is None:
            yield f"`{equation.name}` has no value here: it reads what a host or a mesh gives"
        if mark.value and not (value is None or is_value(mark.value, value)):
            yield f"`{equation.name}` is {written(value)}, and not {mark.value}"


def _of_codes(claimed: tuple[str, ...], reported: list[Diagnostic]) -> Iterator[str]:
    """The complaints about the codes beside a line: each one is reported there."""
    missing = list(claimed)
    for diagnostic in reported:
        if diagnostic.rule.code in missing:
            missing.remove(diagnostic.rule.code)
        elif diagnostic.rule is not rules.WITHOUT_COLOR:  # Pages say what slots are, unread.
            yield f"no mark says that this is reported here:\n{render(diagnostic)}"
    for code in missing:
        yield f"{code} is not reported here"
