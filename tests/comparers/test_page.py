"""The examples of the page about comparers are compiled, and judge a good and a bad picture."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from ..docs.kit import ROOT, all_blocks
from ..suite.processes import run
from .cases import case, filled
from .folders import FILES, OUTPUT
from .kit import LANGUAGES, SUFFIXES, compiled

pytestmark = pytest.mark.xdist_group("comparers")  # One process compiles the programs.

PAGE = ROOT / "docs" / "comparers.md"
NAMES = {"c++": "cpp", "python": "python", "rust": "rust", "typescript": "typescript"}
"""The names of languages in the page's source."""

RENDERERS = {
    "c++": (
        "renderer.hpp",
        "#include <cstdlib>\n"
        "inline std::vector<std::uint8_t> draw() {\n"
        '  const int level = std::atoi(std::getenv("LEVEL"));\n'
        "  return std::vector<std::uint8_t>(72 * 56 * 4, static_cast<std::uint8_t>(level));\n"
        "}\n",
    ),
    "python": (
        "renderer.py",
        "import os\ndef draw():\n    return bytes([int(os.environ['LEVEL'])]) * (72 * 56 * 4)\n",
    ),
    "rust": (
        "renderer.rs",
        "pub fn draw() -> Vec<u8> {\n"
        '    vec![std::env::var("LEVEL").unwrap().parse().unwrap(); 72 * 56 * 4]\n'
        "}\n",
    ),
    "typescript": (
        "renderer.ts",
        'import { env } from "node:process";\n'
        'export const draw = () => new Uint8Array(72 * 56 * 4).fill(Number(env["LEVEL"]));\n',
    ),
}
"""The renderer that the examples test: its file and its text. It draws a grey of the level that the
environment tells."""

RUN = {"python": "\n\ntest_plastic()\n"}
"""What has to be added where pytest would call a test."""
OPTIONS = {"rust": ("--test",)}

BAD = (
    "bad: 4032 pixels compared, 0 undecided, 4032 outside of the bounds; the worst, at "
    "x 0, y 0, lane 0, is 40, not within 136 .. 225"
)


@pytest.mark.parametrize("language", LANGUAGES)
def test_examples(language: str, tmp_path: Path) -> None:
    write_golden(tmp_path / "golden" / "Plastic" / "defaults")
    (block,) = (each for each in all_blocks(NAMES[language]) if "comparer" in each.marks)
    assert block.page == PAGE
    name, text = RENDERERS[language]
    (tmp_path / name).write_text(text, encoding="utf-8")
    program = block.text + RUN.get(language, "")
    command = compiled(language, program, tmp_path, *OPTIONS.get(language, ()))
    for level, is_good in (("150", True), ("40", False)):
        done = run(command, cwd=tmp_path, env={**os.environ, "LEVEL": level})
        assert (done.returncode == 0) == is_good, done
        assert (BAD in done.stdout + done.stderr) == (not is_good), done


def write_golden(folder: Path) -> None:
    """A golden folder for 72 × 56 pixels that have a quarter to three quarters of the light."""
    shape = (56, 72, 4)
    lower, upper = filled(0.25, shape=shape), filled(0.75, shape=shape)
    marks = filled(0, "u1", shape=shape[:2])
    golden = case("golden", "", lower=lower, upper=upper, undecided=marks)
    folder.mkdir(parents=True)
    for name in FILES[:3]:
        of_output = name if name == "undecided.npy" else f"{OUTPUT}.{name}"
        (folder / of_output).write_bytes(golden.files[name])


def test_the_message_is_as_comparers_say_it() -> None:
    (shown,) = (each for each in all_blocks("text") if each.page == PAGE)
    in_words = re.sub(r"\d+", "0", shown.text.rstrip("\n"))
    assert in_words == re.sub(r"\d+", "0", BAD)


def test_each_language_has_an_ending() -> None:
    assert SUFFIXES.keys() == NAMES.keys() == RENDERERS.keys() == set(LANGUAGES)
