"""Compiles texts of which nothing is known. ``test_robustness.py`` and ``make fuzz`` call it."""

from __future__ import annotations

import time
import traceback
from collections.abc import Iterator
from contextlib import suppress
from itertools import count

import burnish
from burnish.api.compiled import CompiledFrame, CompiledMaterial
from burnish.api.entry_points import equations
from burnish.commands.graph.command import as_svg
from burnish.compiler.diagnostics.diagnostic import CompileError, Diagnostic
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.semantics.equations.model import Equations
from burnish.targets.toolchain import Job, Toolchain

from ..examples.kit import jobs_of
from .mutations import mutated, search_path

SHARE_CHECKED = 0.5
"""The share of the time in which the compilers behind Burnish may check texts, at most."""


def problem(text: str, native_stages: bool = False) -> str | None:
    """The traceback of what checking, compiling or drawing the graph raises beside errors in the
    text; ``None`` if nothing."""
    try:
        burnish.check(text + "\n", search_path=search_path())
        result = _compiled(text, native_stages)
        for material in result.materials if result else ():
            _show(material)
        for frame in result.frames if result else ():
            _show(frame)
        if result and not result.frames:
            with suppress(CompileError):  # There may be kernels only.
                for graph in equations(text + "\n", search_path=search_path()):
                    _show(graph)
    except Exception:
        return traceback.format_exc()
    return None


def refused(text: str, toolchain: Toolchain) -> str | None:
    """The compilers' errors about the shaders of a text; ``None`` if there are none."""
    verdicts = toolchain.check(list(jobs(text)))
    reports = [each.report() for each in verdicts if each.status != "accepted"]
    return "\n".join(reports) or None


def jobs(text: str) -> Iterator[Job]:
    """The checks of the shaders of a text by the compilers behind Burnish, if it compiles."""
    result = _compiled(text)
    for material in result.materials if result else ():
        yield from jobs_of(material)


def found(seed: int, seconds: float) -> Iterator[tuple[int, str, str]]:
    """Mutated programs for so many seconds: the seed, text and trouble of those with any."""
    start, checking = time.monotonic(), 0.0
    with Toolchain() as toolchain:
        for number in count(seed):
            begin = time.monotonic()
            if begin - start >= seconds:
                return
            text = mutated(number)
            trouble = problem(text, native_stages=number % 4 < 2)
            if trouble is None and checking <= SHARE_CHECKED * (begin - start):
                trouble = refused(text, toolchain)
                checking += time.monotonic() - begin
            if trouble is not None:
                yield number, text, trouble


def _compiled(text: str, native_stages: bool = False) -> burnish.CompileResult | None:
    """The result, if there is one. Diagnostics can be shown, and their edits lie in the text."""
    try:
        result = burnish.compile(
            text + "\n", "all", search_path=search_path(), partial=True,
            native_stages=native_stages,
        )  # fmt: skip
        diagnostics = result.diagnostics
    except CompileError as error:
        result, diagnostics = None, error.diagnostics
        assert diagnostics, "an error that says nothing"
    render_all(diagnostics)
    assert all(map(_is_inside, diagnostics))
    return result


def _show(subject: CompiledMaterial | CompiledFrame | Equations) -> None:
    """Draw the graph, unless it is too large for people."""
    with suppress(CompileError):
        as_svg(subject)


def _is_inside(found: Diagnostic) -> bool:
    spans = [edit.span for fix in found.fixes for edit in fix.edits]
    return all(0 <= span.start <= span.end <= len(span.source.text) for span in spans)
