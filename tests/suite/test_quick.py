"""What ``make quick`` leaves out is there, and nothing else is left out."""

from __future__ import annotations

import sys

import pytest

from .processes import run
from .quick import LEFT_OUT, TESTS, is_left_out


@pytest.mark.parametrize("name", LEFT_OUT)
def test_what_is_left_out_exists(name: str) -> None:
    assert is_left_out(TESTS / name)
    assert (TESTS / name).exists()


def modules(*options: str) -> set[str]:
    """The modules in which pytest finds tests, relative to the folder of all tests."""
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-n", "0", *options]
    lines = run(command, cwd=TESTS.parent, check=True).stdout.splitlines()
    return {line.partition("::")[0].removeprefix("tests/") for line in lines if "::" in line}


def test_only_what_is_listed_is_left_out() -> None:
    lacking = modules() - modules("--quick")
    assert {name for name in lacking if name in LEFT_OUT} == {n for n in LEFT_OUT if "." in n}
    assert {name.split("/")[0] for name in lacking if name not in LEFT_OUT} == {
        name for name in LEFT_OUT if "." not in name
    }
