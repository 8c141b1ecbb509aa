"""A file becomes only so many shaders and steps, so each compile ends soon."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import burnish
from burnish import Diagnostic
from burnish.compiler import opening
from burnish.compiler.semantics import work
from burnish.compiler.semantics.frames import steps
from burnish.compiler.semantics.shading import room, trials, unused

MANY = """import std.frames.{FullScreen}
material A { }
abstract material Unfinished { }
kernel B { result squares : float[4] = float(index * index) }
pass Sky : FullScreen { target color : rgba8 = vec4(uv, 0, 1) }
frame C { output o = Sky(screen).color }
"""


def complaint(source: str) -> str:
    """The only error of a text, with its place."""
    (found,) = burnish.check(source)
    return f"{found.span}: {found.rule.code} {found.message}"


def test_a_file_declares_only_so_many_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Abstract materials do not count, as others build on them, nor passes: frames draw them."""
    monkeypatch.setattr(opening, "MOST_PROGRAMS", 3)
    assert burnish.check(MANY) == ()
    assert complaint(f"{MANY}material D {{ }}\n") == (
        "<text>:7:10: B0015 `<text>` declares 4 materials, kernels and frames, and 3 are possible"
    )


def test_a_file_declares_only_so_many_records(monkeypatch: pytest.MonkeyPatch) -> None:
    """Abstract records and mixins count as well: each is put together with its bases."""
    monkeypatch.setattr(opening, "MOST_RECORDS", 5)
    assert burnish.check(MANY) == ()
    assert complaint(f"{MANY}mixin D {{ a = 1 }}\n") == (
        "<text>:7:7: B0015 `<text>` declares 6 records and mixins, and 5 are possible"
    )


def bases(count: int) -> str:
    """Abstract materials that all extend a large one."""
    slots = "".join(f" a{number} = {number}" for number in range(50))
    derived = "".join(f"abstract material D{number} : Base {{ }}\n" for number in range(count))
    return f"abstract material Base {{{slots} }}\n{derived}"


UNUSED = {
    "bases": bases,
    "mixins": lambda n: "".join(f"mixin A{i} {{ a{i} = uv.x }}\n" for i in range(n)),
    "wrong with every light": lambda n: (
        "".join(f"rig R{i} {{ }}\n" for i in range(n))
        + "".join(f"abstract material A{i} {{ a = {i} + true }}\n" for i in range(n))
    ),
    "wrong with every type": lambda n: "".join(
        f"fn f{i}<T: floats>(x: T) = x + true + {i}\n" for i in range(n)
    ),
}


@pytest.mark.parametrize("shape", UNUSED.values(), ids=UNUSED)
def test_only_so_much_is_tried(
    shape: Callable[[int], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unused, "MOST_TRIED", 20_000)
    tried, attempt = 0, trials.Trial.attempt

    def counted(*arguments: Any, **named: Any) -> Any:
        nonlocal tried
        tried += 1
        return attempt(*arguments, **named)

    monkeypatch.setattr(trials.Trial, "attempt", counted)
    codes = []
    for count in (2, 200):
        tried = 0
        codes.append([found.rule.code for found in burnish.check(shape(count))])
    assert "B0016" not in codes[0]
    assert codes[1].count("B0016") == 1
    assert tried < 1000


def test_what_is_imported_is_not_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opening, "MOST_PROGRAMS", 1)
    (tmp_path / "many.burnish").write_text(MANY, "utf-8")
    importing = 'import "many.burnish".{A}\nmaterial Mine : A { color = vec3(0.5) }\n'
    assert burnish.check(importing, search_path=(tmp_path,)) == ()


def test_all_frames_have_only_so_many_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(steps, "MOST_TOGETHER", 2)
    two = f"{MANY}frame D {{ output o = Sky(screen).color }}\n"
    assert burnish.check(two) == ()
    assert complaint(f"{two}frame E {{ output o = Sky(screen).color }}\n") == (
        "<text>:8:7: B0828 `E` has more than 2 steps together with the frames before it"
    )


SLOTS = "".join(f" a{number} = uv.x * {number}\n" for number in range(50))
SUM = " + ".join(f"a{number}" for number in range(50))
TOGETHER = {
    "materials": lambda n: (
        f"abstract material Base {{\n{SLOTS} color = vec3({SUM}) }}\n"
        + "".join(f"material M{i} : Base {{ a1 = {i} }}\n" for i in range(n))
    ),
    "kernels": lambda n: (
        f"fn f(x: float) = {SUM.replace('a', 'x * ')}\n"
        + "".join(f"kernel M{i} {{ result r : float[4] = f(float(index)) }}\n" for i in range(n))
    ),
    "frames": lambda n: (
        f"import std.frames.{{FullScreen}}\nfn f(x: float) = {SUM.replace('a', 'x * ')}\n"
        "pass Sky : FullScreen { target color : rgba8 = vec4(f(uv.x)) }\n"
        + "".join(f"frame M{i} {{ output o = Sky(screen).color }}\n" for i in range(n))
    ),
}


@pytest.mark.parametrize("shape", TOGETHER.values(), ids=TOGETHER)
def test_all_programs_together_have_only_so_many_nodes(
    shape: Callable[[int], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first one is told that is too much, whatever the command; alone, it is not."""
    monkeypatch.setattr(work, "MOST_NODES", 5000)
    monkeypatch.setattr(room, "MOST_NODES", 5000)
    assert burnish.check(shape(2)) == ()
    text = shape(60)
    compiled = []
    for compile_ in (burnish.check, partial(burnish.compile, targets=())):
        try:
            found = [each for each in compile_(text) if isinstance(each, Diagnostic)]
        except burnish.CompileError as error:
            found = list(error.diagnostics)
        compiled.append([each.message for each in found if each.severity == "error"])
    for (message,) in compiled:
        assert message.endswith(", what `<text>` declares has more than 5,000 operations")
    assert burnish.compile(text, (), material="M59")
