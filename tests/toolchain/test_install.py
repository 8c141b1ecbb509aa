"""The installer leaves a tool whole or not there, and does nothing twice."""

from __future__ import annotations

import fcntl
import multiprocessing
import os
import sys
import time
from pathlib import Path

import pytest

from burnish.targets.toolchain import install, installer_commands
from burnish.targets.toolchain.installer_commands import InstallError
from burnish.targets.toolchain.tools import DXC_LIBRARY

from ..suite.processes import LIMIT, until


def _no_install(_version: str, _folder: Path) -> None:
    raise AssertionError("it was there already")


def _good_install(_version: str, folder: Path) -> None:
    (folder / DXC_LIBRARY).write_text("a library")


def _broken_install(_version: str, folder: Path) -> None:
    (folder / "half").write_text("of it")
    raise InstallError("the line went dead")


def _empty_install(_version: str, folder: Path) -> None:
    (folder / "something-else").write_text("")


def _folders(cache: Path) -> set[str]:
    return {path.name for path in cache.iterdir() if path.is_dir()}


def test_a_tool_is_installed_once(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(install.INTO_CACHE, "dxc", _good_install)
    assert install.main(["dxc"]) == 0
    assert _folders(no_tools) == {"dxc-3.7"}
    assert "dxc: installed" in capsys.readouterr().out
    monkeypatch.setitem(install.INTO_CACHE, "dxc", _no_install)
    assert install.main(["dxc"]) == 0
    assert capsys.readouterr().out == f"dxc: 3.7 at {no_tools / 'dxc-3.7' / DXC_LIBRARY}\n"


@pytest.mark.parametrize("installer", [_broken_install, _empty_install])
def test_a_failure_is_loud_and_leaves_nothing(
    no_tools: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    installer: object,
) -> None:
    monkeypatch.setitem(install.INTO_CACHE, "dxc", installer)
    assert install.main(["dxc"]) == 1
    assert _folders(no_tools) == set()
    assert "dxc: FAILED" in (said := capsys.readouterr().err)
    assert "NOT installed: dxc" in said


def test_what_a_killed_run_left_behind_is_cleared_away(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (no_tools / f"{install.PARTIAL}dead").mkdir()
    (no_tools / "dxc-3.7").mkdir()
    monkeypatch.setitem(install.INTO_CACHE, "dxc", _good_install)
    assert install.main(["dxc"]) == 0
    assert _folders(no_tools) == {"dxc-3.7"}


def _count_and_install(_version: str, folder: Path) -> None:
    with (folder.parent / "runs").open("a") as runs:
        runs.write("x")
    time.sleep(0.2)
    _good_install(_version, folder)


def _install_in_child() -> None:
    install.INTO_CACHE["dxc"] = _count_and_install
    raise SystemExit(install.main(["dxc"]))


def test_two_runs_at_once_install_once(no_tools: Path) -> None:
    fork = multiprocessing.get_context("fork")
    children = [fork.Process(target=_install_in_child, daemon=True) for _ in range(2)]
    for child in children:
        child.start()
    for child in children:
        child.join(timeout=LIMIT)
    assert [child.exitcode for child in children] == [0, 0]
    assert (no_tools / "runs").read_text() == "x"


@pytest.mark.usefixtures("no_tools")
def test_without_apt_it_says_what_to_do(capsys: pytest.CaptureFixture[str]) -> None:
    assert install.main(["glslang"]) == 1
    assert "glslang-tools" in capsys.readouterr().err


@pytest.mark.usefixtures("no_tools")
def test_without_cargo_it_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    assert install.main(["naga"]) == 1
    assert "it needs cargo" in capsys.readouterr().err


CARGO = """#!/bin/sh
echo "$1" >> {folder}/calls
[ "$1" = vendor ] || exit 0
printf '[[package]]\\nname = "naga-cli"\\nversion = "30.0.1"\\nchecksum = "{digest}"\\n' \\
    > "$(/usr/bin/dirname "$3")/Cargo.lock"
"""
"""Downloads a crate with some digest."""


@pytest.mark.parametrize(("digest", "calls"), [
    (install.NAGA_HASH, ["vendor", "install"]), ("0" * 64, ["vendor"]),
])  # fmt: skip
def test_a_crate_with_another_digest_is_not_built(
    no_tools: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    digest: str,
    calls: list[str],
) -> None:
    (no_tools / "cargo").write_text(CARGO.format(folder=no_tools, digest=digest))
    (no_tools / "cargo").chmod(0o755)
    monkeypatch.setenv("PATH", str(no_tools))
    assert install.main(["naga"]) == 1
    assert (no_tools / "calls").read_text().splitlines() == calls
    assert ("naga-cli 30.0.1 is not what it was" in capsys.readouterr().err) == (len(calls) == 1)
    assert _folders(no_tools) == set()


APT = """#!/bin/sh
echo "$*" >> {folder}/calls
case "$*" in
    *update*) : > {folder}/lists ;;
    *install*)
        [ -e {folder}/lists ] || exit 100
        printf '#!/bin/sh\\necho Glslang Version: 11:12.0.0\\n' > {folder}/glslangValidator
        /bin/chmod +x {folder}/glslangValidator ;;
esac
"""
"""Installs nothing before it has lists, as on a fresh system."""


@pytest.mark.parametrize(("fresh", "wanted"), [(True, "iui"), (False, "i")])
def test_lists_of_packages_are_fetched_only_when_needed(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch, fresh: bool, wanted: str
) -> None:
    folder = no_tools / "bin"
    folder.mkdir()
    (folder / "apt-get").write_text(APT.format(folder=folder))
    (folder / "apt-get").chmod(0o755)
    if not fresh:
        (folder / "lists").write_text("")
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    assert install.main(["glslang"]) == 0
    calls = (folder / "calls").read_text().splitlines()
    assert "".join("u" if call.endswith("update") else "i" for call in calls) == wanted
    assert calls[-1].endswith("install -y --no-install-recommends glslang-tools")
    assert install.main(["glslang"]) == 0
    assert (folder / "calls").read_text().splitlines() == calls


@pytest.mark.usefixtures("no_tools")
@pytest.mark.parametrize(
    ("tool", "way_out"),
    [
        ("chromium", "it needs chromium: "),
        ("lavapipe", "it needs mesa-vulkan-drivers, libvulkan1: "),
        ("moderngl", f"{sys.executable} -m pip install 'burnish[run]'"),
    ],
)
def test_what_cannot_be_installed_is_not_passed_over(
    tool: str, way_out: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    assert install.main([tool]) == 1
    said = capsys.readouterr().err
    assert way_out in said
    assert f"NOT installed: {tool}" in said


def test_a_run_does_not_wait_for_another_one_for_ever(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(install, "PATIENCE", 0.3)
    monkeypatch.setitem(install.INTO_CACHE, "dxc", _no_install)
    with (no_tools / ".lock").open("w") as other:
        fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
        assert install.main(["dxc"]) == 1
    said = capsys.readouterr()
    assert said.out == "waiting for another run, which is installing ...\n"
    assert said.err == (
        "dxc: FAILED: another run has been installing for 0.005 minutes, and holds "
        f"{no_tools / '.lock'}: end it, then try again\nburnish: NOT installed: dxc\n"
    )


HANGS = """#!/bin/sh
echo "fetching packages ..."
/bin/sleep 3600 &
echo "$$ $!" > {folder}/pids
wait
"""
"""Waits for a program that it has started, as npm does for a download."""


def test_a_command_that_hangs_is_ended(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(installer_commands, "PATIENCE", 1.2)
    (no_tools / "npm").write_text(HANGS.format(folder=no_tools))
    (no_tools / "npm").chmod(0o755)
    monkeypatch.setenv("PATH", str(no_tools))
    assert install.main(["tint"]) == 1
    assert capsys.readouterr().err == (
        "tint: FAILED: npm did not end within 0.02 minutes, and was stopped: does the network "
        "answer?\nfetching packages ...\n\nburnish: NOT installed: tint\n"
    )
    places = [Path("/proc", pid) for pid in (no_tools / "pids").read_text().split()]
    until(lambda: not any(place.exists() for place in places), "the end of all processes")
    assert _folders(no_tools) == set()


@pytest.mark.usefixtures("no_tools")
def test_on_windows_it_says_what_it_cannot_do(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(install, "ON_WINDOWS", True)
    assert install.main(["tint"]) == 1
    assert "on Linux only; `burnish doctor` says what is missing" in capsys.readouterr().err
