"""Packages of Debian unstable are unpacked whole or not at all, and no script of them is run."""

from __future__ import annotations

import os
import platform
import re
from pathlib import Path

import pytest

from burnish.targets.toolchain import install, unstable
from burnish.targets.toolchain.tools import tool_named

APT = """#!/bin/sh
echo "$*" >> {folder}/calls
while read line; do echo "$line" >> {folder}/settings; done < "${{APT_CONFIG:-/dev/null}}"
case "$*" in
    *indextargets*) echo http://mirror.example/debian/ ;;
    *update*) exit {update} ;;
    *--simulate*) for each in libc6 godot libllvm22 mesa-libgallium perl-base; do
        echo "Inst $each (1.0 Debian:unstable [amd64])"; done ;;
    *download*) shift 2; for each in "$@"; do : > "$each.deb"; done ;;
esac
"""
DPKG = """#!/bin/sh
echo "$2" >> {folder}/unpacked
/bin/mkdir -p "$3/usr/lib/{machine}-linux-gnu"
printf '#!/bin/sh\\necho {version}.stable\\n' > "$3/usr/lib/{machine}-linux-gnu/{loader}"
/bin/chmod +x "$3/usr/lib/{machine}-linux-gnu/{loader}"
"""
"""What it unpacks is a C library whose loader says the version, whatever it is to run."""


def _plant(
    folder: Path, monkeypatch: pytest.MonkeyPatch, *,
    update: int = 0, loader: str = "ld-linux-x86-64.so.2", version: str = "4.6.3",
) -> None:  # fmt: skip
    """Put an apt and a dpkg on PATH that pretend to have the packages of unstable."""
    for name, text in (("apt-get", APT), ("dpkg-deb", DPKG)):
        script = text.format(
            folder=folder, machine=platform.machine(), update=update, loader=loader, version=version
        )
        (folder / name).write_text(script)
        (folder / name).chmod(0o755)
    (folder / "keyring").touch()
    monkeypatch.setattr(unstable, "KEYRING", folder / "keyring")
    monkeypatch.setenv("PATH", os.pathsep.join((str(folder), os.defpath)))


def _folders(cache: Path) -> set[str]:
    return {path.name for path in cache.iterdir() if path.is_dir()}


def test_packages_are_unpacked_without_drivers(
    no_tools: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _plant(no_tools, monkeypatch)
    assert install.main(["godot"]) == 0
    assert _folders(no_tools) == {"godot"}
    unpacked = [Path(line).name for line in (no_tools / "unpacked").read_text().split()]
    assert unpacked == ["godot.deb", "libc6.deb"]
    status, *_ = re.findall('Dir::State::status "(.*)";', (no_tools / "settings").read_text())
    assert status.endswith("/status") and not status.startswith("/var/")
    assert "godot: installed" in capsys.readouterr().out
    assert install.main(["godot"]) == 0
    said = capsys.readouterr().out
    assert said == f"godot: 4.6.3 at {no_tools / 'godot' / 'bin' / 'godot'}\n"


@pytest.mark.parametrize(("broken", "said"), [
    ({"update": 100}, "apt-get ended with 100"),
    ({"loader": "libc.so.6"}, "the C library of Debian unstable has no loader in usr/lib/"),
    ({"version": "3.5.2"}, "what was installed does not work: godot 3.5.2 is older than 4.4"),
])  # fmt: skip
def test_what_unstable_cannot_give_today_is_told_and_leaves_nothing(
    no_tools: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    broken: dict[str, int | str],
    said: str,
) -> None:
    _plant(no_tools, monkeypatch, **broken)  # type: ignore[arg-type]
    assert install.main(["godot"]) == 1
    assert said in capsys.readouterr().err
    assert _folders(no_tools) == set()


@pytest.mark.usefixtures("no_tools")
def test_only_who_asked_for_it_by_name_is_told_that_it_failed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(install, "TOOLS", (tool_named("godot"),))
    assert install.main([]) == 0
    assert "burnish: NOT installed: godot" in capsys.readouterr().err
    assert install.main(["godot"]) == 1
