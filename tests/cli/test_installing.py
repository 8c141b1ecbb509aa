"""Messages about what is missing have one command, for this Python, which installs all of it."""

from __future__ import annotations

import sys

import pytest

from burnish.support.installing import install_command


@pytest.mark.parametrize(
    ("python", "extras", "command"),
    [
        ("/usr/bin/python3", ["watch"], "/usr/bin/python3 -m pip install 'burnish[watch]'"),
        (
            "/v/python",
            ["render", "view", "scenes"],
            "/v/python -m pip install 'burnish[scenes,view]'",
        ),
        ("/v/python", ["render", "watch"], "/v/python -m pip install 'burnish[render,watch]'"),
        ("/my tools/python", ["run"], "'/my tools/python' -m pip install 'burnish[run]'"),
        ("", ["run"], "python -m pip install 'burnish[run]'"),
    ],
)
def test_the_command(
    python: str, extras: list[str], command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", python)
    assert install_command(extras) == command
