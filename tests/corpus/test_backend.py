"""The corpus as others use it: a backend that knows no Burnish, judged by the page's checker."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.targets.conformance.corpus.making import make
from burnish.targets.conformance.corpus.operands import OPERATIONS

from ..suite.processes import run
from . import backend
from .kit import SEED

pytestmark = pytest.mark.xdist_group("corpus backend")  # One process makes the folder.

PAGE = Path(__file__).parents[2] / "docs" / "corpus.md"
PROMISES = ("wgsl", "vulkan", "direct3d+vulkan")
SHOWN = ("mul", "mod", "round", "sqrt")
"""The operations of the backend on the page."""
HAS = backend.FLOATS | backend.INTEGERS | backend.ANY | backend.VECTORS
F = np.float32

Compute = Callable[[str, Any, Any], Any]
Outside = Callable[..., tuple[int, list[Any]]]


def block(name: str) -> str:
    """A file that the page shows."""
    found = re.search(rf"^```py file={name}\n(.*?)^```$", PAGE.read_text("utf-8"), re.M | re.S)
    assert found
    return found[1]


@pytest.fixture(scope="module")
def outside() -> Outside:
    names: dict[str, Any] = {"__name__": "checker"}
    exec(compile(block("checker.py"), "checker.py", "exec"), names)
    found: Outside = names["outside"]
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The corpus of the operations that the backend has, and that of each by itself."""
    whole = tmp_path_factory.mktemp("corpus")
    texts = make([name for name in OPERATIONS if name in HAS], SEED, "test", lambda _share: None)
    for name, text in texts.items():
        (whole / name).write_text(text, "utf-8")
    return whole


def alone(folder: Path, name: str, to: Path) -> Path:
    """A folder with the corpus of a single operation."""
    row = {"name": name, "file": f"{name}.json"}
    index = json.loads((folder / "index.json").read_text("utf-8"))
    (to / "index.json").write_text(json.dumps({**index, "operations": [row]}))
    (to / f"{name}.json").write_text((folder / f"{name}.json").read_text("utf-8"), "utf-8")
    return to


def test_the_case_of_the_page(folder: Path) -> None:
    found = re.search(r"^```text\n(.*?), …", PAGE.read_text("utf-8"), re.M | re.S)
    assert found
    assert found[1].replace("\n", "") in (folder / "sqrt.json").read_text("utf-8")


def test_the_program_of_the_page(tmp_path: Path) -> None:
    for name in ("checker.py", "backend.py"):
        (tmp_path / name).write_text(block(name), "utf-8")
    texts = make(SHOWN, SEED, "test", lambda _share: None)
    for name, text in texts.items():
        (tmp_path / name).write_text(text, "utf-8")
    for promise in ("wgsl", "nearest"):
        command = [sys.executable, "checker.py", ".", promise]
        ended = run(command, cwd=tmp_path)
        fails = promise == "nearest"  # A remainder in three steps is not rounded correctly.
        assert ended.returncode == fails, ended.stdout
        assert ("\n0 of 768 results are outside" in f"\n{ended.stdout}") == (not fails)
        assert {line.split("'")[1] for line in ended.stdout.splitlines()[:-1]} <= {"mod"}


@pytest.mark.parametrize("promise", PROMISES)
def test_a_backend_conforms(outside: Outside, folder: Path, promise: str) -> None:
    judged, wrong = outside(folder, promise, backend.compute)
    assert judged > 15_000
    assert not wrong, "\n".join(map(str, wrong[:40]))


def test_most_operations_are_judged(folder: Path) -> None:
    assert len(list(folder.iterdir())) > 60


# --- planted mistakes -----------------------------------------------------------------------------


def ulps(count: int) -> Callable[[Any], Any]:
    """A result that is so many units in the last place too large."""

    def moved(x: Any) -> Any:
        for _ in range(count):
            x = np.nextafter(F(x), F(np.inf))
        return x

    return moved


def after(name: str, change: Callable[[Any], Any]) -> tuple[str, Callable[..., Any]]:
    """A function of the backend whose result is changed."""
    function = backend.FLOATS[name]
    return name, lambda *operands: change(function(*operands))


PLANTED: dict[str, tuple[str, Callable[..., Any]]] = {
    "a sum that is two units off": after("add", ulps(2)),
    "a product that is two units off": after("mul", ulps(2)),
    "a quotient that is four units off": after("div", ulps(4)),
    "a quotient that is infinite": ("div", lambda x, y: x / y),
    "a root that is eight units off": after("sqrt", ulps(8)),
    "a root of a magnitude": ("sqrt", lambda x: np.sqrt(abs(x))),
    "an inverse root that is four units off": after("inversesqrt", ulps(4)),
    "exp of half precision": after("exp", lambda x: F(np.float16(x))),
    "a logarithm of numbers below 2^-126": ("log2", lambda x: np.log2(np.maximum(x, F(0)))),
    "a logarithm to another base": ("log10", lambda x: np.log2(np.maximum(x, backend.SMALL))),
    "a power by the magnitude of the base": ("pow", lambda x, y: F(np.power(abs(x), y))),
    "a sine with another sign": after("sin", lambda x: -x),
    "a sine of degrees": ("sin", lambda x: np.sin(np.radians(x))),
    "a sine that is 2^-10 off": after("sin", lambda x: x + F(2.0**-10)),
    "a cosine that is the sine": ("cos", np.sin),
    "an arc without its quadrant": ("atan2", lambda y, x: np.arctan(y / x) if x else F(0)),
    "halves that are rounded up": ("round", lambda x: np.floor(x + F(0.5))),
    "halves that are rounded away from zero": (
        "round", lambda x: np.copysign(np.floor(abs(x) + F(0.5)), x),
    ),
    "floor that is trunc": ("floor", np.trunc),
    "a fraction with a sign": ("fract", lambda x: x - np.trunc(x)),
    "the remainder of C": ("mod", lambda x, y: np.fmod(x, y) if y else F(0)),
    "a step that leaves out the edge": ("step", lambda edge, x: F(x > edge)),
    "a clamp in the other order": ("clamp", lambda x, a, b: np.maximum(np.minimum(x, b), a)),
    "a blend with exchanged ends": ("mix", lambda x, y, a: y * (F(1) - a) + x * a),
    "a smooth step that is linear": (
        "smoothstep", lambda a, b, x: np.clip((x - a) / (b - a), F(0), F(1)),
    ),
    "a sign of -0": ("sign", lambda x: np.copysign(F(1), x)),
    "degrees by the second-nearest constant": (
        "degrees", lambda x: x * np.nextafter(F(180 / np.pi), F(0)),
    ),
    "a number that wraps": ("to_int", lambda x: backend._wrapped(int(x), "int")),
}  # fmt: skip
PLANTED_IN_INTEGERS: dict[str, tuple[str, Callable[..., Any]]] = {
    "a quotient that is rounded down": ("div", lambda x, y: x // y if y else x),
    "a remainder with the sign of the number": ("mod", lambda x, y: int(np.fmod(x, y)) if y else 0),
    "a shift by all bits": ("shift_left", lambda x, by: x << min(max(by, 0), 64)),
    "a shift that fills with zeros": ("shift_right", lambda x, by: (x & 0xFFFFFFFF) >> (by & 31)),
    "bits of the magnitude": ("count_bits", lambda x: abs(x).bit_count()),
}


@pytest.mark.parametrize(
    ("table", "what"),
    [("FLOATS", what) for what in PLANTED] + [("INTEGERS", what) for what in PLANTED_IN_INTEGERS],
)
def test_planted_mistakes_are_found(
    outside: Outside, folder: Path, table: str, what: str, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    name, wrong = (PLANTED if table == "FLOATS" else PLANTED_IN_INTEGERS)[what]
    monkeypatch.setitem(getattr(backend, table), name, wrong)
    one = alone(folder, name, tmp_path)
    for promise in PROMISES:
        assert any(outside(one, promise, backend.compute)[1]), promise


def test_guarded_cases_can_be_left_out(outside: Outside, folder: Path, tmp_path: Path) -> None:
    """A plain root is NaN for negative numbers, of which no language says what it is."""
    one = alone(folder, "sqrt", tmp_path)

    def plain(_name: str, _types: Any, operands: Any) -> Any:
        with np.errstate(all="ignore"):
            return [float(np.sqrt(F(lane))) for lane in operands[0]]

    assert any(outside(one, "vulkan", plain)[1])
    assert not any(outside(one, "vulkan", plain, guarded=False)[1])
