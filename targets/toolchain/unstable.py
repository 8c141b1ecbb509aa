"""Unpacks packages of Debian unstable into a folder of their own; ``install.py`` calls it.

Some programs are in no stable Debian, and are too large to build. Their packages want a newer C
library than the system has, and must not be installed there. So they are downloaded by an apt with
lists of its own, unpacked, and run by the C library that came with them. Drivers are not
downloaded: such a program uses those of the system, since a newer C library also runs what was
built for an older one.

The packages come from the mirror from which the system gets its own. Apt checks that Debian has
signed the lists, and that each package has the digest that they tell. Nothing of the packages is
executed: dpkg unpacks their files, and no scripts. This needs no rights.
"""

from __future__ import annotations

import platform
import shlex
import tempfile
from pathlib import Path

from .installer_commands import NETWORK_SECONDS, InstallError, run_command
from .surroundings import which

KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")
SUITE = "unstable"

OF_THE_SYSTEM = (
    "libegl", "libgbm", "libgl1", "libglvnd", "libglx", "libllvm", "libxml2", "libz3", "mesa-",
)  # fmt: skip
"""The beginnings of the names of packages with graphics drivers, and of what only these need."""
NOT_NEEDED = ("fonts-", "perl")
"""The beginnings of the names of packages with what no program needs that draws shaders."""

APT_SETTINGS = """\
Dir "{folder}";
Dir::State::status "{folder}/status";
Dir::Etc::main "{folder}/main";
APT::Install-Recommends "false";
APT::Sandbox::User "";
Acquire::Languages "none";
Acquire::http::Timeout "{seconds}";
"""
MIRRORS = ("apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages")
OF_DEBIAN = ("Origin: Debian", "Label: Debian")
"""What apt has to list to name the mirrors of Debian that the system uses."""
SOURCES = "deb [check-valid-until=no signed-by={keyring}] {mirror} {suite} main\n"
"""The list of sources. A mirror that is some days behind is as good: what it has is signed, too."""

APT_FOLDERS = ("etc/apt/apt.conf.d", "etc/apt/preferences.d", "etc/apt/trusted.gpg.d",
               "var/lib/apt/lists/partial", "var/cache/apt/archives/partial")  # fmt: skip

DOWNLOAD_AND_UNPACK = """\
cd {archives} && apt-get download -qq "$@" || exit 1
for archive in *.deb; do dpkg-deb --extract "$archive" {folder} || exit 1; done"""
"""What the shell does with the names of packages. Apt downloads into the current folder."""

LAUNCHER = """\
#!/bin/sh
# Runs {program} of Debian {suite} by the C library of its own, with the drivers of the system.
root=$(dirname "$(dirname "$(readlink -f "$0")")")
libraries=$root/usr/lib/{triplet}
exec "$libraries/{loader}" \\
    --library-path "$libraries:$libraries/pulseaudio:/usr/lib/{triplet}:/lib/{triplet}" \\
    "$root/usr/bin/{program}" "$@"
"""


def install(package: str, folder: Path) -> None:
    """Unpack a package of unstable and all that it needs; ``bin`` gets a program that starts it."""
    if not KEYRING.is_file() or not which("apt-get") or not which("dpkg-deb"):
        raise InstallError(f"it is unpacked from packages of Debian {SUITE}, which needs Debian")
    with tempfile.TemporaryDirectory() as name:
        apt = Path(name)
        settings = _private_apt(apt)
        run_command("apt-get", "update", "-qq", environment=settings)
        wanted = _packages(package, settings)
        archives = apt / "var/cache/apt/archives"
        step = DOWNLOAD_AND_UNPACK.format(
            archives=shlex.quote(str(archives)), folder=shlex.quote(str(folder))
        )
        run_command("sh", "-c", step, "sh", *wanted, environment=settings)
    _write_launcher(package, folder)


def _private_apt(folder: Path) -> dict[str, str]:
    """Lists and settings of an apt of its own; returns the variables that make apt use them."""
    for name in APT_FOLDERS:
        (folder / name).mkdir(parents=True)
    sources = SOURCES.format(keyring=KEYRING, mirror=_mirror(), suite=SUITE)
    (folder / "etc/apt/sources.list").write_text(sources, "utf-8")
    # Not a device: apt may put another file in the place of these, also as root.
    for name in ("status", "main"):
        (folder / name).touch()
    settings = folder / "apt.conf"
    settings.write_text(APT_SETTINGS.format(folder=folder, seconds=NETWORK_SECONDS), "utf-8")
    return {"APT_CONFIG": str(settings)}


def _mirror() -> str:
    """The mirror of Debian from which the system gets its packages."""
    mirrors = run_command(*MIRRORS, *OF_DEBIAN).split()
    if not mirrors:
        raise InstallError("apt has no lists of a mirror of Debian: run `apt-get update` as root")
    return mirrors[0]


def _packages(package: str, settings: dict[str, str]) -> list[str]:
    """The package and all that it needs, without drivers; apt knows nothing as installed."""
    said = run_command("apt-get", "install", "--simulate", "-qq", package, environment=settings)
    names = [line.split()[1] for line in said.splitlines() if line.startswith("Inst ")]
    if not names:
        raise InstallError(f"Debian {SUITE} says nothing of {package}:\n{said}")
    return [name for name in names if not name.startswith(OF_THE_SYSTEM + NOT_NEEDED)]


def _write_launcher(program: str, folder: Path) -> None:
    triplet = f"{platform.machine()}-linux-gnu"
    libraries = folder / "usr" / "lib" / triplet
    loader = next((path.name for path in libraries.glob("ld-linux*.so.*")), None)
    if loader is None:
        raise InstallError(f"the C library of Debian {SUITE} has no loader in usr/lib/{triplet}")
    launcher = folder / "bin" / program
    launcher.parent.mkdir(exist_ok=True)
    text = LAUNCHER.format(program=program, suite=SUITE, triplet=triplet, loader=loader)
    launcher.write_text(text, "utf-8")
    launcher.chmod(0o755)
