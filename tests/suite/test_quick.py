"""The folders and modules that ``make quick`` leaves out exist, and no others are left out."""

from __future__ import annotations

import sys

import pytest

from .processes import run
from .quick import LEFT_OUT, TESTS, is_left_out


@pytest.mark.parametrize("name", LEFT_OUT)
def test_what_is_left_out_exists(name: str) -> None:
    assert is_left_out(TESTS / name)
    assert (TESTS / name).exists()


def test_only_what_is_listed_is_left_out() -> None:
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-n", "0", "--quick"]
    lines = run(command, cwd=TESTS.parent, check=True).stdout.splitlines()
    found = {line.partition("::")[0].removeprefix("tests/") for line in lines if "::" in line}
    modules = {path.relative_to(TESTS).as_posix() for path in TESTS.rglob("test_*.py")}
    assert found == {
        name for name in modules if name not in LEFT_OUT and name.split("/")[0] not in LEFT_OUT
    }
