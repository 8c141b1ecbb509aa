"""Every comparer says the same of every case of the table, and that is right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from .cases import CASES
from .folders import FILES, Case
from .kit import LANGUAGES, Said, verdicts

pytestmark = pytest.mark.xdist_group("comparers")  # One process compiles the programs.

NO_SUCH_FILE = re.compile(": (No such file|ENOENT).*")
"""The reason for which a file cannot be read: languages and systems have words of their own."""


def test_cases_have_names_of_their_own() -> None:
    assert len({case.name for case in CASES}) == len(CASES)


@pytest.mark.parametrize("language", LANGUAGES)
def test_cases(language: str, tmp_path: Path) -> None:
    lines = [case.write(tmp_path / str(number)) for number, case in enumerate(CASES)]
    said = verdicts(language, lines, tmp_path)
    found = {case.name: _found(case, each) for case, each in zip(CASES, said, strict=True)}
    expected = {case.name: (case.expected,) * 2 for case in CASES}
    assert {name: each for name, each in found.items() if each != expected[name]} == {}


def _found(case: Case, said: Said) -> tuple[str, str]:
    """What was said, in the words of the case."""
    loaded = case.named(said.loaded)
    if case.files.keys() == set(FILES):
        return loaded, said.parsed
    return NO_SUCH_FILE.sub("", loaded), case.expected  # A file that is missing has no bytes.
