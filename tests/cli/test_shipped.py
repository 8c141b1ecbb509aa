"""The commands that give out pages and examples: all of them, and never over other files."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.commands.catalogue import catalogue
from burnish.commands.shipped import DOCS, EXAMPLES, groups

from .kit import invoke

NAMES = [
    each.name
    for group in catalogue(EXAMPLES)
    for each in group.files
    if not each.name.startswith("hosts/")
]


def files(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_all_pages_are_listed() -> None:
    """The list of pages has each of them once, with words about it."""
    rows = [row for listed in groups(DOCS).values() for row in listed.items()]
    pages = {path.stem for path in DOCS.glob("*.md")} - {"README"}
    assert sorted(name for name, _ in rows) == sorted(pages)
    assert all(what for _, what in rows)
    said = invoke("docs").stdout
    assert all(f"  {name} " in said for name in pages)


@pytest.mark.parametrize("name", ["plans", "plans.md", "docs/plans.md", "Plans"])
def test_a_page(name: str) -> None:
    text = (DOCS / "plans.md").read_text(encoding="utf-8")
    assert invoke("docs", name).stdout == text
    assert invoke("docs", name, "--path").stdout == f"{DOCS / 'plans.md'}\n"


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("docs tutrial", "there is no page `tutrial`; did you mean `tutorial`?"),
        ("docs xyzzy", "there is no page `xyzzy`; `burnish docs` lists them"),
        ("example plastik", "there is no example `plastik`; did you mean `plastic`?"),
        ("example glwo", "there is no example `glwo`; did you mean `frames/glow`?"),
        ("example ../setup.py", "there is no example `../setup.py`; "),
    ],
)
def test_names_that_are_not_there(command: str, said: str) -> None:
    result = invoke(*command.split())
    assert result.exit_code == 2
    assert said in result.stderr


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("plastic", {"plastic.burnish"}),
        ("marble", {"marble.burnish", "shared/noise.burnish"}),
        ("4_texture", {"tutorial/4_texture.burnish", "tutorial/pictures/bricks.png"}),
        ("glass", {"glass.burnish", "pictures/garden.hdr"}),
    ],
)
def test_an_example_is_whole(name: str, written: set[str], tmp_path: Path) -> None:
    """It has all that it imports and what its command reads."""
    assert invoke("example", name, "-o", tmp_path).exit_code == 0
    assert files(tmp_path) == written
    (file,) = (each for each in written if name in each)
    assert burnish.check(tmp_path / file) == ()


def test_all_examples_are_listed() -> None:
    said = invoke("example").stdout
    assert all(f"  {name.removesuffix('.burnish')}" in said for name in NAMES)


def test_files_that_are_there_stay(tmp_path: Path) -> None:
    """The same files may be written again; with other contents of one, nothing is written."""
    assert invoke("example", "glass", "-o", tmp_path).exit_code == 0
    again = invoke("example", "glass", "-o", tmp_path)
    assert again.exit_code == 0
    assert again.stdout.count("(was there already)") == 2

    (tmp_path / "own" / "shared").mkdir(parents=True)
    mine = tmp_path / "own" / "shared" / "noise.burnish"
    mine.write_text("mine")
    before = files(tmp_path)
    result = invoke("example", "marble", "-o", tmp_path / "own")
    assert result.exit_code == 1
    assert f"`{mine}` is there already, and nothing was written" in result.stderr
    assert (mine.read_text(), files(tmp_path)) == ("mine", before)
