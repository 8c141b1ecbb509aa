"""The messages about the likeliest mistakes of users, as files to be read.

After a deliberate change, run with ``BURNISH_UPDATE_GOLDEN=1`` and read the difference.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from .kit import FOLDER, Case, cases, said, told

FILES = sorted(FOLDER.glob("*.txt"))


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs are written to a folder of their own."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_the_messages_are_the_expected_ones(path: Path) -> None:
    found = [case.shown(said(case)) for case in cases(path)]
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        path.write_text("\n".join(found), encoding="utf-8")
    expected = [case.shown(case.said) for case in cases(path)]
    assert found == expected


ONE = [case for path in FILES if path.stem != "several" for case in cases(path)]


@pytest.mark.parametrize("case", ONE, ids=lambda case: case.title)
def test_no_place_is_told_of_twice(case: Case) -> None:
    """A mistake is one message: no two of them begin at one place."""
    places = [found.span and found.span.start for found in told(case)]
    assert len(places) == len(set(places))


def test_there_are_many() -> None:
    assert len(ONE) > 250
    assert len({case.title for case in ONE}) == len(ONE)
