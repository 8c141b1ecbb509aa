"""The time of the first compile on a fresh machine beside later ones, in CPU time.

A checkout is installed as a wheel, and once more as ``pip install --editable`` does it, each into
an environment of its own. For every round, all is put back as it was when pip had ended, and the
cache folder is empty. Later compiles find what the first one left behind, but another text.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import venv
from collections.abc import Iterator, Sequence
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

from .checkout import Checkout
from .table import Row, Section

EXAMPLE = Path(__file__).parents[2] / "examples" / "plastic.burnish"
ROUNDS = 10
LATER = 2
"""The number of later compiles in a round. Medians count, of these as of the first ones."""
AIM = 1.1
NOT_INSTALLED = shutil.ignore_patterns(
    ".*", "*.egg-info", "__pycache__", "build", "dist", "docs", "examples", "generated", "tests"
)


def measure(checkouts: Sequence[Checkout]) -> Iterator[Section]:
    """A row for each checkout and each way to install it."""
    rows = [_row(checkout, way) for checkout in checkouts for way in ("wheel", "editable")]
    yield Section("first", "Milliseconds of CPU time of the first compile, and of later ones", rows)


def _row(checkout: Checkout, way: str) -> Row:
    with tempfile.TemporaryDirectory() as name:
        here, untouched = Path(name) / "here", Path(name) / "untouched"
        python = _installed(checkout, way, here)
        shutil.copytree(here, untouched, symlinks=True)
        first, later = [], []
        for _ in range(ROUNDS):
            shutil.rmtree(here)
            shutil.copytree(untouched, here, symlinks=True)
            first.append(_compile(here, python, 0))
            later += [_compile(here, python, number) for number in range(1, 1 + LATER)]
    ratio = median(first) / median(later)
    return {
        "checkout": checkout.name, "installed as": way, "first": median(first),
        "later": median(later), "ratio": ratio, "aim": AIM, "within": ratio <= AIM,
    }  # fmt: skip


def _installed(checkout: Checkout, way: str, folder: Path) -> Path:
    """Install a checkout below a folder; returns the path of the environment's Python."""
    tree = folder / "tree"
    shutil.copytree(checkout.root, tree, ignore=NOT_INSTALLED)
    venv.create(folder / "env")
    python = folder / "env" / "bin" / "python"
    (site,) = (folder / "env").rglob("site-packages")
    (site / "others.pth").write_text(sysconfig.get_path("purelib"))
    pip = [sys.executable, "-m", "pip", "--quiet", "--python", str(python), "install"]
    alone = ["--no-deps", "--no-build-isolation", "--no-index"]
    what = ["--editable", str(tree)] if way == "editable" else [str(tree)]
    subprocess.run([*pip, *alone, *what], check=True, timeout=600, env=_environment(folder))
    return python


def _compile(folder: Path, python: Path, number: int) -> float:
    """Milliseconds of CPU time for a text that was not compiled before."""
    source = folder / "plastic.burnish"
    source.write_text(f"{EXAMPLE.read_text('utf-8')}// {number}\n", "utf-8")
    words = ["compile", str(source), "--target", "wgsl", "-o", str(folder / "out")]
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run(
        [python, "-m", "burnish", *words], check=True, stdout=subprocess.DEVNULL, timeout=600,
        cwd=folder, env=_environment(folder),
    )  # fmt: skip
    after = getrusage(RUSAGE_CHILDREN)
    return 1000 * (after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)


def _environment(folder: Path) -> dict[str, str]:
    """The environment of a user who has never run Burnish; byte code may be written."""
    dropped = ("PYTHONDONTWRITEBYTECODE", "PYTHONPATH")
    kept = {name: value for name, value in os.environ.items() if name not in dropped}
    return kept | {"BURNISH_CACHE": str(folder / "cache")}
