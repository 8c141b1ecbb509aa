"""Pictures on pages: each is drawn by the command that is quoted above it."""

from __future__ import annotations

import shlex
import shutil
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from click.testing import CliRunner
from PIL import Image

from burnish.commands.group import burnish as group

from .kit import EXAMPLES, Block, all_blocks


def among_examples(folder: Path) -> None:
    """Puts the examples into a reader's folder, and into its folder ``examples``."""
    shutil.copytree(EXAMPLES, folder, dirs_exist_ok=True)
    shutil.copytree(EXAMPLES, folder / "examples")


def output_of(block: Block) -> str:
    """The file that the command of a block writes."""
    words = shlex.split(block.text.partition("#")[0])
    return words[words.index("-o") + 1]


def draw_all() -> list[Path]:
    """Draws all pictures of all pages anew."""
    drawn = []
    for block in all_blocks("console"):
        if picture := block.value("picture"):
            drawn.append(block.page.parent / picture)
            _draw(block, drawn[-1])
    return drawn


def _draw(block: Block, picture: Path) -> None:
    with TemporaryDirectory() as folder:
        among_examples(Path(folder))
        with chdir(folder):
            words = shlex.split(block.text.partition("#")[0])
            result = CliRunner().invoke(group, words[2:])
            assert result.exit_code == 0, result.output
            picture.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(output_of(block), picture)


def assert_alike(drawn: Path, kept: Path) -> None:
    """The picture of a page is the one that its command draws now.

    Libraries of mathematics differ in last places, which may change a shade by one, and a pixel on
    an edge altogether: one of a thousand pixels may differ.
    """
    advice = f"{kept.name} is not current: run `python -m tests.docs.generate`"
    assert kept.exists(), advice
    now, before = (np.asarray(Image.open(path).convert("RGB"), int) for path in (drawn, kept))
    assert now.shape == before.shape, advice
    assert np.mean(np.abs(now - before).max(axis=-1) > 1) <= 1e-3, advice
