"""Programs that the installer puts into the cache folder: nobody else can have put them there."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path

import pytest

from burnish.targets.toolchain import install
from burnish.targets.toolchain.places import is_trusted
from burnish.targets.toolchain.sources import OwnInstaller
from burnish.targets.toolchain.tools import cache_folder, tool_named

from .conftest import PlantTool


@pytest.fixture
def naga(plant_tool: PlantTool, no_tools: Path) -> Path:
    """A folder of tools that contains naga."""
    tool = tool_named("naga")
    plant_tool(f"{tool.folder}/bin/naga", "30.0.1", "")
    assert tool.find() is not None
    return no_tools


@pytest.mark.parametrize("mode", [0o777, 0o775, 0o757])
def test_a_folder_that_others_can_write(
    naga: Path, mode: int, capsys: pytest.CaptureFixture[str]
) -> None:
    naga.chmod(mode)
    assert tool_named("naga").find() is None
    assert install.main(["naga"]) == 1
    assert "naga: FAILED:" in capsys.readouterr().err


def test_a_folder_of_another_user(naga: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    owner = naga.stat().st_uid
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    assert (tool_named("naga").find() is None) == (owner != 0)


def test_a_link(naga: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    link = tmp_path / "link"
    link.symlink_to(naga)
    monkeypatch.setenv("BURNISH_TOOLS", str(link))
    assert tool_named("naga").find() == (link / tool_named("naga").folder / "bin" / "naga",)
    naga.chmod(0o777)
    assert tool_named("naga").find() is None


def test_a_link_of_another_user(
    naga: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The other user could point the link to another folder of programs, even to one of root."""
    link = tmp_path / "link"
    link.symlink_to(naga)
    found = Path.lstat

    def of_another(path: Path) -> os.stat_result:
        status = list(found(path))
        if path == link:
            status[stat.ST_UID] = os.geteuid() + 1
        return os.stat_result(status)

    monkeypatch.setattr(Path, "lstat", of_another)
    assert is_trusted(naga)
    assert not is_trusted(link)


@pytest.mark.parametrize("home", ["", "~", "relative"])
def test_without_a_home_nothing_is_found_in_the_current_folder(
    home: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("BURNISH_TOOLS", "BURNISH_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", home)
    assert cache_folder() == Path(os.devnull) / "burnish" / "tools"


@pytest.mark.parametrize(("tool", "package"), install.NPM_PACKAGES.items())
def test_packages_of_npm_have_digests(tool: str, package: str) -> None:
    """The wanted package has the version that the table of tools pins."""
    packages = json.loads(install.npm_lock(tool).read_text("utf-8"))["packages"]
    source = tool_named(tool).source
    assert isinstance(source, OwnInstaller)
    wanted = packages.pop("")
    assert wanted == {"dependencies": {package: source.pinned}}
    assert packages[f"node_modules/{package}"]["version"] == source.pinned
    assert all(package["integrity"].startswith("sha512-") for package in packages.values())
