"""JSON that was received takes no more memory than it may, and has no text that is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.documents import DocumentError, read_json

from ..suite.memory import measured

READING = """\
from pathlib import Path
from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.documents import read_json
with raised({"memory": int(sys.argv[2])}):
    try:
        read_json(Path(sys.argv[1]).read_bytes(), "x")
        print("read")
    except BudgetError as error:
        print(error)
"""
WIDE = '{"a":"' + "x" * 10_000_000 + '\\ud83d\\ude00😀","b":[%s]}'
"""Python has four bytes for each letter of this text."""


@pytest.mark.parametrize(
    "text",
    [
        WIDE % ",".join(['{"a":1.5}'] * 300_000),
        '{"b":{' + ",".join(f'"{n}":1' for n in range(600_000)) + "}}",
    ],
    ids=["wide", "names"],
)
def test_what_is_read_takes_no_more_than_is_counted(text: str, tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    path.write_text(text, "utf-8")
    said, before = measured(READING, str(path), "1000")
    assert said.startswith("reading x takes ")
    needed = 300_000_000
    said, peak = measured(READING, str(path), str(needed))
    assert said == "read"
    assert peak - before < needed


def test_memory_is_counted_before_values_are_made() -> None:
    with raised({"memory": 10**6}), pytest.raises(BudgetError, match=r"^reading x takes 2\.6 MB"):
        read_json(b"[" + b"0," * 9_999 + b"0]", "x")


@pytest.mark.parametrize(
    "text", [r'"\ud83d"', r'["a", {"b": "é\udc00"}]', r'{"a": {"\ud800x": 1}}', r'"\ude00\ud83d"']
)
def test_half_of_a_character_is_refused_wherever_it_stands(text: str) -> None:
    with pytest.raises(DocumentError, match="a text in it has half of a character"):
        read_json(text.encode(), "x")


def test_both_halves_are_a_character() -> None:
    assert read_json(rb'{"\ud83d\ude00": ["\\ud83d"]}', "x") == {"😀": ["\\ud83d"]}
