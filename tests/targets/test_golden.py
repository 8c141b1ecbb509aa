"""Whole texts, to be read in review. ``BURNISH_UPDATE_GOLDEN=1`` writes them anew."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.compiler.ir.program import Program
from burnish.targets.emit.emitter import EmitOptions

from .kit import PROFILES, Selected, can_have, printed
from .programs import odd, plastic

GOLDEN = Path(__file__).parent / "golden"
PROGRAMS = [plastic(), odd()]


def check(name: str, text: str) -> None:
    path = GOLDEN / name
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("selected", PROFILES, ids=str)
@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.shader.name)
def test_text(program: Program, selected: Selected) -> None:
    if not can_have(selected, program):
        assert (program.shader.name, str(selected)) == ("Odd", "glsl:es100")
        return
    for file in printed(program, selected).files:
        check(f"{program.shader.name.lower()}.{selected.profile.name}.{file.suffix}", file.text)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.shader.name)
def test_single_file(program: Program, selected: Selected) -> None:
    options = EmitOptions(single_file=True)
    if not selected.profile.single_file:
        with pytest.raises(ValueError, match="no single-file form"):
            printed(program, selected, options)
        return
    (file,) = printed(program, selected, options).files
    assert file.entries == {"vertex": "vs_main", "fragment": "fs_main"}
    check(f"{program.shader.name.lower()}.{selected.profile.name}.{file.suffix}", file.text)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_printing_twice_gives_the_same_text(selected: Selected) -> None:
    first, second = (printed(plastic(), selected) for _ in range(2))
    assert [file.text for file in first.files] == [file.text for file in second.files]
    assert [list(f.origins()) for f in first.files] == [list(f.origins()) for f in second.files]


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_flip(selected: Selected) -> None:
    upright = printed(odd(), selected)
    flipped = printed(odd(), selected, EmitOptions(flip_y=True))
    added = {*flipped.files[0].text.split("\n")} - {*upright.files[0].text.split("\n")}
    assert any("-" in line for line in added)
    assert bool(upright.host_uniforms) == selected.profile.framebuffer.rows_up
    assert not flipped.host_uniforms
