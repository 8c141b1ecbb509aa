"""What is built from this tree works away from it."""

from __future__ import annotations

import os
import shutil
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

from ..suite.processes import run
from .kit import ROOT, files

DATA = {".h", ".lark", ".j2", ".txt", ".json", ".toml", ".mjs", ".burnish", ".typed"}
GENERATED = ("__init__", "grammar", "library", "skeletons")
PACKAGE = ("commands", "compiler", "stdlib", "targets")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built from a copy, so that nothing is left in the tree and nothing old gets in."""
    folder = tmp_path_factory.mktemp("wheel")
    for path in files(ROOT):
        copy = folder / "tree" / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, copy)
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder)]
    run([*build, str(folder / "tree")], check=True)
    (wheel,) = folder.glob("*.whl")
    return wheel


def test_content(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if ".dist-info/" not in name}
    wanted = {
        f"burnish/{path.relative_to(ROOT).as_posix()}"
        for folder in PACKAGE
        for path in files(ROOT / folder)
        if path.suffix == ".py" or path.suffix in DATA
    }
    top = {f"burnish/{path.name}" for path in ROOT.glob("*.py")}
    top -= {"burnish/setup.py", "burnish/generate.py"}
    assert {"burnish/__init__.py", "burnish/api.py", "burnish/cli.py"} <= top
    generated = {f"burnish/generated/{name}.py" for name in GENERATED}
    assert packed == wanted | top | generated | {"burnish/py.typed"}


COMPILE = """
import sys
import burnish
assert burnish.__file__.startswith(sys.prefix), burnish.__file__
result = burnish.compile(sys.argv[1])
print(len(result["Plastic"].files), result["Plastic"].reflection["material"])
"""


def test_installed_elsewhere(wheel: Path, tmp_path: Path) -> None:
    """In an environment that has this one's other packages, but not this checkout."""
    example = str(tmp_path / "plastic.burnish")
    shutil.copyfile(ROOT / "examples" / "plastic.burnish", example)
    venv.create(tmp_path / "env", with_pip=False)
    python = str(tmp_path / "env" / ("Scripts" if os.name == "nt" else "bin") / "python")
    (site,) = (tmp_path / "env").rglob("site-packages")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    (site / "others.pth").write_text(sysconfig.get_path("purelib"))
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    environment["BURNISH_CACHE"] = str(tmp_path / "cache")
    told = run([python, "-c", COMPILE, example], cwd=tmp_path, env=environment)
    assert told.stderr == ""
    assert told.stdout.startswith("6 ")
    command = [python, "-m", "burnish", "compile", example, "--target", "wgsl", "-o", "out"]
    run(command, check=True, cwd=tmp_path, env=environment)
    assert (tmp_path / "out" / "Plastic.frag.wgsl").is_file()
