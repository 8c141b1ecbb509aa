"""The crate for build scripts, in the project of the page."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import burnish

from ..suite.processes import run
from .kit import (
    BROKEN,
    INTEGRATIONS,
    PLACE,
    PROGRAMS,
    WARNED,
    WARNED_PLACE,
    environment,
    project,
    replaced,
    tool,
    without_burnish,
)

pytestmark = pytest.mark.xdist_group("rust")  # Its projects share what Cargo has built.

RUNNING = "Compiling viewer"
"""What Cargo prints if it runs the build script of the project, and builds it again."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = project("rust", tmp_path_factory.mktemp("rust") / "with blank $1")
    shutil.copytree(INTEGRATIONS / "rust", made / "burnish-build")
    return made


def cargo(folder: Path, *words: str, check: bool = True, **environments: object) -> tuple[str, str]:
    """What Cargo and the programs that it runs have printed, and their messages."""
    env = dict(environment())
    env.update({name: str(value) for name, value in environments.items()})
    env["CARGO_TARGET_DIR"] = str(folder.parent / "target")
    done = run([tool("cargo", "cargo"), *words, "--offline"], cwd=folder, env=env)
    assert (done.returncode == 0) == check, done
    return done.stdout, done.stderr


def texts(folder: Path) -> str:
    (material,) = burnish.compile(folder / "materials" / "plastic.burnish", ("wgsl",))
    return material.text("wgsl", "vertex") + material.text("wgsl", "fragment")


def test_the_program_has_the_shaders_and_follows_their_changes(folder: Path) -> None:
    assert cargo(folder, "run")[0] == texts(folder)
    assert RUNNING not in cargo(folder, "run")[1]
    tints = folder / "materials" / "shared" / "tints.burnish"
    replaced(tints, "color * 0.5", "color * dot(color, color)")
    printed, said = cargo(folder, "run")
    assert RUNNING in said
    assert printed == texts(folder)
    assert RUNNING not in cargo(folder, "run")[1]


def test_a_warning_is_one_of_cargo(folder: Path) -> None:
    source = folder / "materials" / "plastic.burnish"
    right = source.read_text()
    source.write_text(WARNED)
    _, said = cargo(folder, "build")
    (line,) = (line for line in said.splitlines() if "B0211" in line)
    assert line.startswith(f"warning: viewer@0.1.0: materials/plastic.burnish{WARNED_PLACE}")
    source.write_text(right)


def test_a_mistake_ends_the_build(folder: Path) -> None:
    source = folder / "materials" / "plastic.burnish"
    right = source.read_text()
    source.write_text(BROKEN)
    _, said = cargo(folder, "build", check=False)
    (line,) = (line.strip() for line in said.splitlines() if "tnt" in line)
    assert line.startswith(f"materials/plastic.burnish{PLACE}")
    assert "panicked" not in said
    source.write_text(right)
    assert cargo(folder, "run")[0] == texts(folder)


def test_burnish_is_not_there(folder: Path) -> None:
    (folder / "materials" / "plastic.burnish").touch()
    _, said = cargo(folder, "build", check=False, PATH=without_burnish()["PATH"])
    assert "burnish-build: cannot run `burnish` (No such file or directory" in said
    assert "activate the Python environment in which Burnish is installed" in said
    _, said = cargo(folder, "build", check=False, BURNISH="/nowhere/burnish")
    assert "cannot run `/nowhere/burnish`" in said
    cargo(folder, "build", BURNISH=str(PROGRAMS / "burnish"), PATH=without_burnish()["PATH"])


def test_the_program_has_the_binding(folder: Path) -> None:
    """Without the features that add to it, there is no warning of them."""
    replaced(folder / "build.rs", ".compile()", '.bindings("materials.rs").compile()')
    main = folder / "src" / "main.rs"
    main.write_text(BOUND, encoding="utf-8")
    printed, said = cargo(folder, "run")
    assert printed == texts(folder)
    assert "warning" not in said


BOUND = """\
mod materials {
    include!(concat!(env!("OUT_DIR"), "/materials.rs"));
}

fn main() {
    for each in materials::PLASTIC.profiles[0].texts {
        print!("{}", each.text);
    }
}
"""


def test_the_crate_itself(folder: Path) -> None:
    """Its own tests, of the files of dependencies that it reads, and of the example in its page."""
    printed, _ = cargo(folder / "burnish-build", "test")
    assert printed.count("test result: ok.") == 2
