"""Checks all examples for Bevy: ``python -m burnish.tests.engines.bevy_suite [NAME...]``.

Bevy's composer takes the shaders in all passes, and cargo checks the modules in Rust against the
real Bevy, which takes some minutes the first time. No test does that.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.targets.toolchain.installer_commands import InstallError, run_command
from burnish.targets.toolchain.tools import cache_folder, tool_named

from .bevy import OWN, SWOLLEN, composed
from .files import files_of, materials

MANIFEST = """\
[package]
name = "all-examples"
version = "0.0.0"
edition = "2024"

[dependencies]
bevy = {{ version = "={version}", default-features = false, features = ["bevy_pbr"] }}

[workspace]
"""
MODULE = '#[path = "{label}/{file}"]\npub mod {label};\n'

Files = Mapping[str, Mapping[str, str]]


def main(names: Sequence[str]) -> int:
    """Print what is wrong, and a sum; returns the process's exit code."""
    found: dict[str, Mapping[str, str]] = {}
    for file, name in materials(names):
        label = f"{file.stem}_{name}".lower()
        try:
            found[label] = files_of("bevy", file, name)
        except CompileError as error:
            print(f"{label}: not written: {error}".splitlines()[0])
    found["own"] = files_of("bevy", OWN, "Own")
    found["swollen"] = files_of("bevy", SWOLLEN, "Swollen")
    folder = cache_folder() / "bevy-suite"
    folder.mkdir(exist_ok=True)
    said = composed(found, folder)
    refused = {label: text for label, text in said.items() if text}
    for label, text in refused.items():
        print(f"{label}: {text}")
    print(f"{len(found)} materials, {len(said)} shaders of passes: {len(refused)} refused")
    complaint = checked(found, folder)
    print(complaint or "cargo takes all modules")
    return 1 if refused or complaint else 0


def checked(found: Files, folder: Path) -> str:
    """What cargo says of the modules; nothing if it takes them without a warning."""
    version = tool_named("bevy").folder.partition("-")[2]
    lines = [_written(label, files, folder / "src") for label, files in found.items()]
    text = "#![deny(warnings)]\n" + "".join(lines)
    (folder / "src" / "lib.rs").write_text(text, "utf-8")
    (folder / "Cargo.toml").write_text(MANIFEST.format(version=version), "utf-8")
    manifest = str(folder / "Cargo.toml")
    try:
        run_command("cargo", "check", "--manifest-path", manifest)
    except InstallError as error:
        return str(error)
    return ""


def _written(label: str, files: Mapping[str, str], folder: Path) -> str:
    """Write the files of a material; returns the lines that make them a module."""
    (folder / label).mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / label / name).write_text(text, "utf-8")
    (file,) = (name for name in files if name.endswith(".rs"))
    return MODULE.format(label=label, file=file)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
