"""The command that lists, prints and gives out what other build systems need."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pytest

from burnish import __version__
from burnish.commands.integration import WHAT
from burnish.commands.shipped import INTEGRATIONS

from .kit import invoke, tree


def test_all_are_listed() -> None:
    said = invoke("integration").stdout
    assert all(f"  {name} " in said for name in WHAT)
    own = {path.name for path in INTEGRATIONS.iterdir() if path.name != "github"}
    assert own == set(WHAT)


@pytest.mark.parametrize("name", WHAT)
def test_how_each_is_used(name: str) -> None:
    """The section of the page, and no other one."""
    said = invoke("integration", name).stdout
    assert f"burnish integration {name} --path" in said
    assert "\n## " not in said


@pytest.mark.parametrize("name", WHAT)
def test_a_copy(name: str, tmp_path: Path) -> None:
    folder = INTEGRATIONS / name
    assert invoke("integration", name, "--path").stdout == f"{folder}\n"
    assert invoke("integration", name, "-o", tmp_path / "own").exit_code == 0
    assert tree(tmp_path / "own") == tree(folder)
    assert invoke("integration", name, "-o", tmp_path / "own").exit_code == 0


def test_a_copy_that_was_changed_stays(tmp_path: Path) -> None:
    invoke("integration", "vite", "-o", tmp_path)
    (tmp_path / "index.js").write_text("mine")
    (tmp_path / "told.js").unlink()
    result = invoke("integration", "vite", "-o", tmp_path)
    assert result.exit_code == 1
    assert f"`{tmp_path / 'index.js'}` has other contents, and nothing was written" in result.stderr
    assert (tmp_path / "index.js").read_text() == "mine"
    assert not (tmp_path / "told.js").exists()


def test_a_name_that_is_not_there() -> None:
    result = invoke("integration", "cmaek")
    assert result.exit_code == 2
    assert "there is no integration `cmaek`; did you mean `cmake`?" in result.stderr


def test_all_have_the_version_of_burnish() -> None:
    cmake = (INTEGRATIONS / "cmake" / "BurnishConfigVersion.cmake").read_text()
    (of_cmake,) = re.findall(r"^set\(PACKAGE_VERSION (.+)\)$", cmake, re.MULTILINE)
    of_rust = tomllib.loads((INTEGRATIONS / "rust" / "Cargo.toml").read_text())["package"]
    of_vite = json.loads((INTEGRATIONS / "vite" / "package.json").read_text())
    assert {of_cmake, of_rust["version"], of_vite["version"]} == {__version__}
