"""Installs the external tools: ``python -m burnish.targets.toolchain.install [NAME...]``.

``make tools`` runs it, and people do, as ``burnish doctor`` tells them. It works on Linux only.
System packages are installed with apt-get, all other tools into Burnish's cache folder. Each of
these is completed in a temporary folder and then renamed, so that a tool is never half installed.
Several runs at the same time wait for each other. Packages come from where apt, pip, cargo and npm
are configured to get them, and nothing that was downloaded is run unless it is what is known here:
apt checks signatures, and of all else this module or a lock has the digest.

Nothing waits for ever: neither for another run, nor for a network that does not answer, nor for a
program that hangs.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import sys
import tarfile
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import TextIO

from . import bevy, unstable
from .installer_commands import (
    NETWORK_SECONDS,
    PATIENCE,
    InstallError,
    minutes,
    run_command,
)
from .places import is_trusted
from .sources import Debian, Extra, OwnInstaller, Unstable
from .surroundings import which
from .tools import (
    CARGO_PACKAGES,
    DXC_LIBRARY,
    TOOLS,
    Tool,
    cache_folder,
    inspect,
    judge,
    tool_named,
)

ON_WINDOWS = os.name == "nt"
PARTIAL = ".partial-"

DXC_ARCHIVE = "compushady==0.17.5"
DXC_ARCHIVE_HASH = "sha256:5052caf9e955d8e7a48e22f536e82b44b72e83af46e824a9e99157c7809de691"
DXC_MEMBER = "compushady/backends/libdxcompiler_{machine}.so.3.7"
SETUPTOOLS = "setuptools==84.2.1"
SETUPTOOLS_HASH = "sha256:ca140b45d5325a9478f880e351484f62fef15f336462e449ca0c03c873d589c2"
"""The package by which pip asks a source archive for its name, even if it only downloads the
archive."""

NAGA_CRATE = "naga-cli"
NAGA_HASH = "45283c11b8b1da1936214eefc9caf9c1bc74ae5c090023eaea84ba317a194c8c"
"""The SHA-256 of the crate, which contains a lock with those of all crates that it needs."""
NPM_PACKAGES = {
    "tint": "webgpu",
    "typescript": "typescript",
    "pyodide": "pyodide",
    "three": "three",
    "three-types": "@types/three",
    "vite": "vite",
}
"""The packages of npm, by the tool that each of them is."""

PAUSE = 0.1
"""The seconds after which a run looks again for the end of another one."""
APT_LOCK_SECONDS = 300


def main(names: Sequence[str]) -> int:
    """Install the named tools, or all tools; returns the process's exit code."""
    if ON_WINDOWS:
        reason = "this installs tools on Linux only; `burnish doctor` says what is missing"
        print(f"burnish: {reason}", file=sys.stderr)
        return 1
    known = [tool.name for tool in TOOLS]
    if unknown := set(names) - set(known):
        print(f"burnish: no such tool: {', '.join(unknown)}; there are {', '.join(known)}")
        return 2
    tools = [tool_named(name) for name in names] or TOOLS
    failed = [tool for tool in tools if not _ensure(tool)]
    if failed:
        told = ", ".join(tool.name for tool in failed)
        print(f"burnish: NOT installed: {told}", file=sys.stderr)
    promised = [tool for tool in failed if names or not tool.may_be_missing]
    return 1 if promised else 0


def _ensure(tool: Tool) -> bool:
    """Install a tool unless it is installed: prints the progress; True if it is there now."""
    if _is_there(tool):
        return True
    started = time.monotonic()
    try:
        with _lock():
            if not _is_there(tool):
                print(f"{tool.name}: installing ...", flush=True)
                _install(tool)
                print(f"{tool.name}: installed in {time.monotonic() - started:.0f} s")
    except (InstallError, OSError) as error:
        print(f"{tool.name}: FAILED: {error}", file=sys.stderr)
        return False
    return True


def _is_there(tool: Tool) -> bool:
    """True if a tool need not be installed. A pinned version must be in the cache itself."""
    pinned = isinstance(tool.source, OwnInstaller)
    state = judge(tool, tool.find_installed() if pinned else tool.find())
    if state.problem is None:
        print(f"{tool.name}: {state.version} at {state.paths[0]}")
    return state.problem is None


@contextmanager
def _lock() -> Iterator[None]:
    """Let only one process at a time install, and remove files of interrupted processes."""
    folder = cache_folder()
    with suppress(NotADirectoryError, FileExistsError):
        folder.parent.mkdir(parents=True, exist_ok=True)
        folder.mkdir(mode=0o755)
    if not is_trusted(folder):
        raise InstallError(
            f"{folder} is not a folder into which only you can put programs: correct that, or name "
            "another one in BURNISH_TOOLS"
        )
    with (cache_folder() / ".lock").open("w") as file:
        _wait_for_others(file)
        for leftover in cache_folder().glob(f"{PARTIAL}*"):
            shutil.rmtree(leftover)
        yield


def _wait_for_others(file: TextIO) -> None:
    """Lock a file, waiting until no other run has locked it."""
    import fcntl  # which Windows lacks

    give_up = time.monotonic() + PATIENCE
    told = False
    while True:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return
        except BlockingIOError:
            if time.monotonic() > give_up:
                reason = f"another run has been installing for {minutes(PATIENCE)}"
                raise InstallError(
                    f"{reason}, and holds {file.name}: end it, then try again"
                ) from None
        if not told:
            print("waiting for another run, which is installing ...", flush=True)
            told = True
        time.sleep(PAUSE)


def _install(tool: Tool) -> None:
    match tool.source:
        case Debian(packages):
            _apt(*packages)
            if problem := inspect(tool).problem:
                raise InstallError(problem)
        case Extra():
            raise InstallError(f"it is a package for {sys.executable}: {tool.install}")
        case OwnInstaller(version):
            _install_into_cache(tool, partial(INTO_CACHE[tool.name], version))
        case Unstable(package):
            _install_into_cache(tool, partial(unstable.install, package))


def _install_into_cache(tool: Tool, installer: Callable[[Path], None]) -> None:
    unfinished = Path(tempfile.mkdtemp(prefix=PARTIAL, dir=cache_folder()))
    try:
        installer(unfinished)
        state = judge(tool, tool.find_in(unfinished))
        if state.problem:
            raise InstallError(f"what was installed does not work: {state.problem}")
        final = cache_folder() / tool.folder
        shutil.rmtree(final, ignore_errors=True)
        unfinished.chmod(0o755)
        unfinished.rename(final)
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


def _apt(*names: str) -> None:
    if os.geteuid() != 0 or not which("apt-get"):
        raise InstallError(
            f"it needs {', '.join(names)}: install what your system's package manager calls so, "
            "or run this as root where there is apt-get"
        )
    network = (f"Acquire::{kind}::Timeout={NETWORK_SECONDS}" for kind in ("http", "https"))
    options = (f"DPkg::Lock::Timeout={APT_LOCK_SECONDS}", *network)
    patience = [word for option in options for word in ("-o", option)]
    packages = ("--no-install-recommends", *names)
    try:
        run_command("apt-get", *patience, "install", "-y", *packages)
    except InstallError:
        run_command("apt-get", *patience, "update")
        run_command("apt-get", *patience, "install", "-y", *packages)


def _cargo_naga(version: str, folder: Path) -> None:
    """Build naga's command line from its crate, whose digest is checked before anything of it runs.

    A package of our own that needs the crate has cargo download it. Cargo insists on the digest
    that the registry tells, and writes it into a lock.
    """
    if not which("cargo"):
        _apt(*CARGO_PACKAGES)
    with tempfile.TemporaryDirectory(prefix=PARTIAL, dir=cache_folder()) as name:
        package = Path(name)
        (package / "Cargo.toml").write_text(
            f'[package]\nname = "tools"\nversion = "0.0.0"\nedition = "2021"\n'
            f'[dependencies]\n{NAGA_CRATE} = "={version}"\n[workspace]\nexclude = ["sources"]\n',
            "utf-8",
        )
        (package / "src").mkdir()
        (package / "src" / "lib.rs").touch()
        sources = package / "sources"
        run_command("cargo", "vendor", "--manifest-path", str(package / "Cargo.toml"), str(sources))
        _check_crate(package / "Cargo.lock", version)
        crate = str(sources / NAGA_CRATE)
        run_command("cargo", "install", "--locked", "--path", crate, "--root", str(folder))


def _check_crate(lock: Path, version: str) -> None:
    """Raise ``InstallError`` unless the crate that cargo has downloaded is the known one."""
    packages = tomllib.loads(lock.read_text("utf-8"))["package"]
    found = [each for each in packages if (each["name"], each["version"]) == (NAGA_CRATE, version)]
    digests = [each.get("checksum") for each in found]
    if digests != [NAGA_HASH]:
        raise InstallError(f"{NAGA_CRATE} {version} is not what it was: its digest is {digests}")


def npm_lock(tool: str) -> Path:
    """The packages of a tool, with their digests; ``npm ci`` insists on all of them."""
    return Path(__file__).with_name(f"{tool}-lock.json")


def _npm(tool: str, version: str, folder: Path) -> None:
    """Install the packages of a tool's lock; npm refuses packages with another digest."""
    wanted = {"dependencies": {NPM_PACKAGES[tool]: version}}
    (folder / "package.json").write_text(json.dumps(wanted), "utf-8")
    shutil.copyfile(npm_lock(tool), folder / "package-lock.json")
    quiet = ("--no-audit", "--no-fund", "--ignore-scripts")
    run_command("npm", "ci", "--prefix", str(folder), *quiet)


def _pip_dxc(_version: str, folder: Path) -> None:
    """Take DXC out of the source archive of a Python package that contains it, without a build.

    Even for a download, pip runs the part of the archive that states its name, with setuptools. So
    setuptools has a known digest, too, and nothing else is fetched for it.
    """
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input")
    with tempfile.TemporaryDirectory(prefix=PARTIAL, dir=cache_folder()) as name:
        downloads, build = Path(name), Path(name, "build")
        tool = _known(downloads / "setuptools.txt", SETUPTOOLS, SETUPTOOLS_HASH)
        run_command(*pip, "install", "--only-binary=:all:", "--target", str(build), *tool)
        archive = _known(downloads / "dxc.txt", DXC_ARCHIVE, DXC_ARCHIVE_HASH)
        source_only = ("--no-build-isolation", "--no-binary", DXC_ARCHIVE.partition("==")[0])
        run_command(
            *pip, "download", *source_only, "--dest", name, *archive,
            environment={"PYTHONPATH": str(build)},
        )  # fmt: skip
        _extract_dxc(next(downloads.glob("*.tar.gz")), folder)


def _known(file: Path, package: str, digest: str) -> tuple[str, ...]:
    """The arguments by which pip takes a package of this digest alone; written to a file."""
    file.write_text(f"{package} --hash={digest}\n", "utf-8")
    return "--no-deps", "--require-hashes", "--requirement", str(file)


def _extract_dxc(archive: Path, folder: Path) -> None:
    member = DXC_MEMBER.format(machine=platform.machine())
    top = archive.name.removesuffix(".tar.gz")
    with tarfile.open(archive) as content:
        try:
            library = content.extractfile(f"{top}/{member}")
        except KeyError:
            library = None
        if library is None:
            raise InstallError(f"there is no DXC library for {platform.machine()} machines")
        with library, (folder / DXC_LIBRARY).open("wb") as target:
            shutil.copyfileobj(library, target)


INTO_CACHE: dict[str, Callable[[str, Path], None]] = {
    "dxc": _pip_dxc,
    "naga": _cargo_naga,
    "bevy": bevy.install,
    "tint": partial(_npm, "tint"),
    "typescript": partial(_npm, "typescript"),
    "pyodide": partial(_npm, "pyodide"),
    "vite": partial(_npm, "vite"),
    "three": partial(_npm, "three"),
    "three-types": partial(_npm, "three-types"),
}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
