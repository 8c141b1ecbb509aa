"""Packages that are built from this tree work without it."""

from __future__ import annotations

import json
import os
import shutil
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.commands.integration import WHAT
from burnish.targets.toolchain.tools import program
from burnish.targets.web_host.serving.modules import host_modules

from ..suite.package import FOLDERS
from ..suite.processes import run
from .kit import ROOT, files

DATA = {
    ".h", ".hpp", ".rs", ".ts", ".lark", ".j2", ".txt", ".json", ".toml", ".mjs", ".js", ".css",
    ".html", ".svg", ".burnish", ".typed",
}  # fmt: skip
GENERATED = (
    "__init__", "builtin_table", "grammar", "initialisers", "library", "scene", "skeletons",
)  # fmt: skip
LINKED = (
    "README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md", "LICENSE", "LICENSE-OUTPUT.md",
)  # fmt: skip
"""The files of the root to which pages link."""


pytestmark = pytest.mark.xdist_group("wheel")  # One process builds the wheels, for all tests.


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Built from a copy, so that nothing is left in the tree and nothing old gets in: one from the
    tree, and one from its source archive."""
    folder = tmp_path_factory.mktemp("wheel")
    for path in files(ROOT):
        copy = folder / "tree" / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
    built: list[Path] = []
    for name, options in (("direct", ["--wheel"]), ("archive", [])):
        to = ["--no-isolation", "--outdir", str(folder / name), str(folder / "tree")]
        run([sys.executable, "-m", "build", *options, *to], check=True)
        built += (folder / name).glob("*.whl")
    return built


@pytest.fixture(scope="module")
def wheel(wheels: list[Path]) -> Path:
    return wheels[0]


def test_the_source_archive_makes_the_same(wheels: list[Path]) -> None:
    contents = []
    for wheel in wheels:
        with zipfile.ZipFile(wheel) as archive:
            contents.append({name: archive.read(name) for name in archive.namelist()})
    direct, archived = contents
    assert direct.keys() == archived.keys()
    assert [name for name in direct if direct[name] != archived[name]] == []


def test_content(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if ".dist-info/" not in name}
    wanted = {
        f"burnish/{path.relative_to(ROOT).as_posix()}"
        for folder in FOLDERS
        for path in files(ROOT / folder)
        if path.suffix == ".py" or path.suffix in DATA
    }
    top = {f"burnish/{path.name}" for path in ROOT.glob("*.py")}
    top -= {"burnish/setup.py", "burnish/generate.py"}
    assert {"burnish/__init__.py", "burnish/__main__.py"} <= top
    wanted |= {
        f"burnish/{path.relative_to(ROOT).as_posix()}"
        for folder in ("docs", "examples", *(f"integrations/{name}" for name in WHAT))
        for path in files(ROOT / folder)
    }
    wanted |= {f"burnish/{name}" for name in LINKED}
    generated = {f"burnish/generated/{name}.py" for name in GENERATED}
    assert packed == wanted | top | generated | {"burnish/py.typed"}


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """An environment with the wheel and the other packages of this one, but not this checkout; a
    material lies beside it. Nothing in it can be written to."""
    folder = tmp_path_factory.mktemp("installed")
    shutil.copyfile(ROOT / "examples" / "plastic.burnish", folder / "plastic.burnish")
    venv.create(folder / "env", with_pip=False)
    (site,) = (folder / "env").rglob("site-packages")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    (site / "others.pth").write_text(sysconfig.get_path("purelib"))
    _set_writable(folder, False)
    yield folder
    _set_writable(folder, True)


def _set_writable(folder: Path, writable: bool) -> None:
    for path in (folder, *folder.rglob("*")):
        if not path.is_symlink():
            mode = path.stat().st_mode
            path.chmod(mode | 0o200 if writable else mode & ~0o222)


MORTAL = """
import ctypes, os, sys
PR_CAPBSET_DROP, CAP_DAC_OVERRIDE = 24, 1
ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE, 0, 0, 0)
os.execv(sys.argv[1], sys.argv[1:])
"""
"""Runs a program for which permissions count, although it may be root who runs the tests."""

STRANGER = """
import pwd, sys

def unknown(_):
    raise KeyError

pwd.getpwuid = unknown
import burnish
assert burnish.__file__.startswith(sys.prefix), burnish.__file__
from burnish.commands.cli import main
try:
    main()
finally:
    assert {"lark", "jinja2"}.isdisjoint(sys.modules)
"""
"""A command of a user who has no entry in the password file."""


def command(installed: Path, *arguments: str) -> tuple[int, str]:
    """The exit status and output of a command.

    Its user has no home and may write nowhere.
    """
    python = str(installed / "env" / "bin" / "python")
    line = [sys.executable, "-c", MORTAL, python, "-c", STRANGER, *arguments]
    ended = run(line, cwd=installed, env={"PATH": os.environ["PATH"]})
    return ended.returncode, ended.stdout + ended.stderr


def test_compiling_where_it_is_installed(installed: Path, tmp_path: Path) -> None:
    out = str(tmp_path / "out")
    assert command(installed, "compile", "plastic.burnish", "-o", out) == (
        0, f"Plastic: 6 shaders and Plastic.json in {out}\n"
    )  # fmt: skip
    assert len(list((tmp_path / "out").iterdir())) == 7
    code, said = command(installed, "compile", "plastic.burnish", "-o", "out")
    assert code == 1
    assert "cannot write to `out`: Permission denied" in said


def test_drawing_where_it_is_installed(installed: Path, tmp_path: Path) -> None:
    picture = str(tmp_path / "plastic.png")
    drawn = command(installed, "render", "plastic.burnish", "-o", picture, "--size", "8")
    assert drawn == (0, f"Plastic: {picture}\n")
    code, said = command(installed, "conform", "plastic.burnish", "--routes", "lavapipe:glsl")
    assert (code, said.splitlines()[-1]) == (0, "1 agrees"), said


def test_pages_and_examples_where_it_is_installed(installed: Path, tmp_path: Path) -> None:
    """An example is drawn from what was written, in a folder where nothing else lies."""
    assert command(installed, "docs", "tutorial")[1].startswith("# Tutorial")
    assert command(installed, "example", "glass", "-o", str(tmp_path))[0] == 0
    there = {
        path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()
    }
    assert there == {"glass.burnish", "pictures/garden.hdr"}
    drawn = ("-o", str(tmp_path / "glass.png"), "--size", "8")
    code, said = command(installed, "render", str(tmp_path / "glass.burnish"), *drawn)
    assert code == 0, said


HOST = """
import json
from burnish.compiler.precomputed import precomputed
from burnish.targets.web_host.serving.builtin_table import module_to_generate
import burnish
from burnish.targets.toolchain.tools import program
from burnish.targets.web_host.serving.modules import host_modules
(key,) = module_to_generate()
print(json.dumps([host_modules(), precomputed("builtin_table", key) is not None]))
"""


def test_the_host_for_web_pages_is_given_out_where_it_is_installed(installed: Path) -> None:
    python = str(installed / "env" / "bin" / "python")
    given, is_precomputed = json.loads(run([python, "-c", HOST], cwd=installed, check=True).stdout)
    assert given == host_modules()
    assert is_precomputed


@pytest.mark.parametrize("what", ["targets", "check plastic.burnish", "explain B0201", "--help"])
def test_other_commands_where_it_is_installed(installed: Path, what: str) -> None:
    assert command(installed, *what.split())[0] == 0


LATER = """
import json, sys
sys.path.insert(0, "/wheel")
sys.dont_write_bytecode = True
import burnish
texts = [
    [{file.name: file.text for file in made.files}, burnish.to_json(made.reflection)]
    for example in ("plastic", "frames/deferred")
    for made in burnish.compile(f"/examples/{example}.burnish")
]
needed = sorted({"lark", "jinja2", "tomllib"} & sys.modules.keys())
json.dumps([list(sys.version_info[:2]), texts, needed])
"""
"""A compile by a Python that has the wheel alone, without the packages that it depends on."""


def test_another_version_of_python_computes_nothing_again(wheel: Path, tmp_path: Path) -> None:
    """Where a wheel was built by one version, another finds all that is in it."""
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    node, pyodide = program("node", "node"), program("pyodide", "pyodide.mjs")
    script = [node, Path(__file__).with_name("later_python.mjs"), pyodide]
    folders = ["/wheel", tmp_path, "/examples", ROOT / "examples"]
    said = run([*map(str, script), LATER, *map(str, folders)], check=True).stdout
    version, texts, needed = json.loads(said)
    assert tuple(version) > sys.version_info[:2]
    assert texts == [
        [{file.name: file.text for file in made.files}, burnish.to_json(made.reflection)]
        for example in ("plastic", "frames/deferred")
        for made in burnish.compile(ROOT / "examples" / f"{example}.burnish")
    ]
    assert needed == []
