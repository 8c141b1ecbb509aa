"""Command lines that are read without click mean what click reads in them."""

from __future__ import annotations

import os
from pathlib import Path

import click
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from burnish.commands.compile import compile_
from burnish.commands.compile_options import (
    OPTIONS,
    CompileRequest,
    Option,
    plain_request,
)

from .kit import PLAIN, shell

FLAGS = [name for row in OPTIONS if not row.metavar for name in (*row.names, row.off) if name]
NAMES = [name for row in OPTIONS if row.metavar for name in row.names]
NEEDED = {
    "depfile_target": ["--depfile", "d"],
    "optimize": ["--emit", "spirv"],
    **{field: ["--emit", "functions"] for field in ("slots", "together", "prefix")},
}
"""What goes with an option that means nothing by itself, by its field."""
VALUES = ["m.burnish", "out", "-", "a,b", "-t", "--", "", "=", "x=y", "a b", "ü", "@file", "--rig"]


def read_by_click(words: list[str]) -> CompileRequest | None:
    """The request in a command line; ``None`` if click ends with a message."""
    try:
        with compile_.make_context("compile", list(words)) as context:
            chosen = dict(context.params)
            return None if chosen.pop("watch") else CompileRequest(**chosen)
    except (click.UsageError, click.exceptions.Exit):
        return None


words = st.one_of(
    st.sampled_from([*FLAGS, *NAMES, *VALUES, "--watch", "--help"]),
    st.builds("{}={}".format, st.sampled_from([*NAMES, *FLAGS]), st.sampled_from(VALUES)),
    st.builds("{}{}".format, st.sampled_from(NAMES), st.sampled_from(VALUES)),
)


@given(st.lists(words, max_size=8))
@example(["m.burnish", "-o", "out", "-t", "glsl", "-t", "wgsl,hlsl", "--no-hoist", "-I", "a"])
@example(["--output=-", "m.burnish", "--rig", "One", "--rig", "Two", "--hoist", "--no-hoist"])
def test_they_mean_the_same(line: list[str]) -> None:
    found = plain_request(["compile", *line])
    if found is not None:
        assert found == read_by_click(line)


@pytest.mark.parametrize("row", OPTIONS, ids=lambda row: str(row.field))
def test_each_option_can_be_plain(row: Option) -> None:
    for name in filter(None, (*row.names, row.off)):
        value = row.choices[0] if row.choices else "name=value"
        value = {"emit": "spirv", "prefix": "name"}.get(row.field, value)
        needed = NEEDED.get(row.field, [])
        line = ["m.burnish", "-o", "out", *needed, name, *([value] if row.metavar else [])]
        found = plain_request(["compile", *line])
        assert found is not None
        assert found == read_by_click(line)


@pytest.mark.parametrize(
    "line",
    [
        "", "--help", "m.burnish", "-o out", "m.burnish -o",
        "m.burnish -o out --watch", "m.burnish -o out --wach", "m.burnish -oout",
        "m.burnish -o out -t --rig", "m.burnish -o out --flip-y=1", "-- m.burnish -o out",
    ],
)  # fmt: skip
def test_click_reads_what_is_unusual(line: str) -> None:
    assert plain_request(["compile", *line.split()]) is None
    assert plain_request(["check", "m.burnish"]) is None
    assert plain_request([]) is None


def test_what_may_not_be_read_is_told_by_click(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "m.burnish"
    line = ["compile", str(file), "-o", "out"]
    assert plain_request(line) is not None
    file.touch()
    assert plain_request(line) is not None
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert plain_request(line) is None


def test_a_compile_tells_the_same_either_way(tmp_path: Path) -> None:
    """``-oNAME`` is unusual, and so is read by click."""
    for text in (PLAIN, "material M { colour = vec3(1) }\n", "material M { color = 1 }\n"):
        (tmp_path / "m.burnish").write_text(text)
        plain = shell("compile", "m.burnish", "-t", "glsl", "-o", "out", folder=tmp_path)
        click_ = shell("compile", "m.burnish", "-t", "glsl", "-oout", folder=tmp_path)
        assert (plain.returncode, plain.stdout, plain.stderr) == (
            click_.returncode, click_.stdout, click_.stderr
        )  # fmt: skip
