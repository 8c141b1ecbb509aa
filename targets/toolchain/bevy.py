"""Builds the program that composes shaders as Bevy does, with Bevy's own modules beside it.

``install.py`` calls it. The modules are in crates of Bevy, which are downloaded and unpacked, but
not built: nothing of Bevy is run. The program is our own, and has the composer of shaders that
Bevy has, ``naga_oil``.
"""

from __future__ import annotations

import os
import shutil
import tarfile
import tempfile
from hashlib import sha256
from pathlib import Path

from .installer_commands import InstallError, run_command

HERE = Path(__file__).parent
PROGRAM = "bevy-composer"
MODULES = "modules"
"""The folder with Bevy's modules, beside the program."""

CRATES = {
    "bevy_pbr": "244ae7d618b51a59c913c36b0564a295cd85ea91a5e777b542bb7bdb846a23d6",
    "bevy_render": "fc86a32b2eef9859e1e7d323c6d1a9150fe77aa17c30fd05abebc12f645929dc",
    "bevy_core_pipeline": "2564f1ba766532e8eeb20059133ff6703e8dd5c3864b92378d0d1c541096ef12",
}
"""The crates with modules of shaders, and their SHA-256."""


def install(version: str, folder: Path) -> None:
    """Put the program and the modules of a version of Bevy into a folder."""
    with tempfile.TemporaryDirectory(dir=folder) as name:
        package = Path(name)
        shutil.copyfile(HERE / f"{PROGRAM}.toml", package / "Cargo.toml")
        shutil.copyfile(HERE / f"{PROGRAM}-lock.toml", package / "Cargo.lock")
        shutil.copyfile(HERE / "bevy_composer.rs", package / "bevy_composer.rs")
        manifest, target = str(package / "Cargo.toml"), str(package / "target")
        options = ("--release", "--locked", "--manifest-path", manifest, "--target-dir", target)
        run_command("cargo", "build", *options)
        shutil.copy(package / "target" / "release" / PROGRAM, folder / PROGRAM)
    for crate, digest in CRATES.items():
        run_command("cargo", "info", f"{crate}@{version}")
        _unpack(_archive(f"{crate}-{version}", digest), folder / MODULES / crate)


def _archive(name: str, digest: str) -> Path:
    """The crate that cargo has downloaded. Raises ``InstallError`` unless it is the known one."""
    home = Path(os.environ.get("CARGO_HOME") or Path.home() / ".cargo")
    for path in home.glob(f"registry/cache/*/{name}.crate"):
        if sha256(path.read_bytes()).hexdigest() == digest:
            return path
    raise InstallError(f"cargo has downloaded no {name} with the digest {digest}")


def _unpack(archive: Path, folder: Path) -> None:
    """Write the shaders of a crate."""
    with tarfile.open(archive) as content:
        for member in content.getmembers():
            file = content.extractfile(member) if member.name.endswith(".wgsl") else None
            if file is not None:
                path = folder.joinpath(*Path(member.name).parts[2:])
                if not path.resolve().is_relative_to(folder.resolve()):
                    raise InstallError(f"{archive.name} has a file outside of its folder")
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(file.read())
