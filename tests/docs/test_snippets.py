"""Every snippet in the documentation does what the page says; ``kit`` tells how they are marked."""

from __future__ import annotations

import contextlib
import io
import json
import re
import shlex
from itertools import pairwise
from pathlib import Path

import pytest
from click.testing import CliRunner

import burnish
from burnish.commands.group import burnish as group
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.documents.writing import to_json

from .kit import EXAMPLES, PAGES, ROOT, Block, all_blocks, blocks
from .outcomes import declare_files, outcome, source_of, told
from .pictures import among_examples, assert_alike, output_of

(PLASTIC,) = burnish.compile(EXAMPLES / "plastic.burnish").materials


ENDLESS = frozenset(("--watch", "view"))
"""Words of commands that run until somebody ends them."""


@pytest.mark.parametrize("block", all_blocks("burnish"), ids=str)
def test_burnish(block: Block, tmp_path: Path) -> None:
    found = outcome(block, tmp_path)
    codes = {diagnostic.rule.code for diagnostic in found}
    expected = {"B0206"} if block.value("file") and "material " not in block.text else set()
    if code := block.value("error"):
        expected = {code}
    assert codes == expected, render_all(found)


@pytest.mark.parametrize("block", all_blocks("text"), ids=str)
def test_text(block: Block, tmp_path: Path) -> None:
    if block.value("from") is None:
        return
    assert block.text == told(source_of(block), tmp_path)


QUOTED = [
    block for block in (*all_blocks("wgsl"), *all_blocks("hlsl")) if "made" not in block.marks
]


@pytest.mark.parametrize("block", QUOTED, ids=str)
def test_excerpt(block: Block) -> None:
    example, stage = (block.value("from") or ":").split(":")
    (material,) = burnish.compile(EXAMPLES / f"{example}.burnish", (block.language,)).materials
    assert stage in ("vertex", "fragment")
    text = material.text(block.language, "vertex" if stage == "vertex" else "fragment")
    assert_in_order(block.text, text)


def assert_in_order(quoted: str, text: str) -> None:
    """A text has the quoted lines, with others where there is a `…` alone on a line."""
    parts = [part.strip("\n") for part in re.split(r"^\s*…$", quoted, flags=re.MULTILINE)]
    places = [text.find(part) for part in parts if part]
    assert -1 not in places, parts[places.index(-1)]
    assert all(before <= after for before, after in pairwise(places))


@pytest.mark.parametrize("block", all_blocks("json"), ids=str)
def test_json(block: Block) -> None:
    """A quoted row stands in the example's reflection, where it may have more keys."""
    quoted = json.loads(block.text)
    example = block.value("from") or "plastic"
    (material,) = burnish.compile(EXAMPLES / f"{example}.burnish", ("glsl",)).materials
    reflection = to_json(material.reflection)
    rows = [
        row for key in ("parameters", "derived", "promises", "blocks") for row in reflection[key]
    ]
    rows.append(reflection["draw"])
    assert any(quoted.items() <= row.items() for row in rows)


def test_the_table_of_buffers() -> None:
    text = (ROOT / "docs" / "reflection.md").read_text(encoding="utf-8")
    table = re.findall(
        r"^\| `(\w+)` \| (\d+) \| (\d), (\d) \| `(\w\d), space(\d)`", text, re.MULTILINE
    )
    sizes = {block.name: block.size for block in PLASTIC.reflection.blocks}
    assert {name: int(size) for name, size, *_ in table} == sizes
    for backend in PLASTIC.reflection.backends.values():
        for name, _, set_, binding, register, space in table:
            point = backend.blocks[name]
            assert (point.group, point.binding) == (int(set_), int(binding))
            assert set_ == space
            assert point.register in (None, register)


@pytest.fixture
def reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder like a reader's: the examples lie in it."""
    among_examples(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)


@pytest.mark.usefixtures("reader")
@pytest.mark.parametrize("page", [p for p in PAGES if blocks(p, "python")], ids=lambda p: p.name)
def test_python(page: Path) -> None:
    names: dict[str, object] = {}
    for block in blocks(page, "python"):
        if "comparer" in block.marks:
            continue
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(block.text, str(block), "exec"), names)


@pytest.mark.usefixtures("reader")
@pytest.mark.parametrize("block", all_blocks("console"), ids=str)
def test_console(block: Block) -> None:
    """Every command succeeds, and prints what is quoted below it; `…` stands for other lines."""
    declare_files(block, Path.cwd())
    for part in re.split(r"^(?=\$)", block.text, flags=re.MULTILINE):
        line, _, quoted = part.partition("\n")
        command = shlex.split(line.partition("#")[0])
        if command[:2] == ["$", "burnish"] and not ENDLESS.intersection(command):
            result = CliRunner().invoke(group, command[2:])
            assert result.exit_code == 0, result.output
            assert_in_order(quoted, result.stdout)
    if picture := block.value("picture"):
        assert_alike(Path(output_of(block)), block.page.parent / picture)
