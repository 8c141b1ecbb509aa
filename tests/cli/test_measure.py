"""``burnish conform --measure``: what it prints and keeps, and what devices that fail lead to."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import pytest

from burnish.targets.conformance.profiles import STORE
from burnish.targets.runner.drivers.device import Device, DriverError
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.store import Store

from .kit import invoke
from .test_conform import USAGE, without

ROUTE = "vulkan:glsl"


@pytest.fixture(autouse=True)
def _own_cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))


def kept() -> list[Path]:
    """The files of all profiles."""
    return [path for path in Store(STORE).folder.rglob("*") if path.is_file()]


def test_a_device_is_measured_and_later_runs_know_it() -> None:
    Path("m.burnish").write_text(
        "material M { map t : texture2d\n color = t(uv * vec2(3, 5)).rgb }\n"
    )
    before = invoke("conform", "m.burnish", "--routes", ROUTE)
    result = invoke("conform", "--measure", "--routes", ROUTE)
    assert (result.exit_code, result.stderr) == (0, "")
    heading, *rows, last = result.stdout.splitlines()
    assert heading.startswith(f"{ROUTE}: llvmpipe (LLVM")
    found = dict(re.split(r"  +", row.strip(), maxsplit=1) for row in rows)
    assert found["weights of texels"] == "16 binary places"
    assert found["results of texels in fixed point"] == "as precise as a float"
    assert found["levels that follow from steps"].startswith("euclidean, off by up to 0.0")
    assert found["derivatives"] == "own"
    assert last == "  kept: later runs of `conform` hold pictures of this device against it first"
    assert len(kept()) == 1
    after = invoke("conform", "m.burnish", "--routes", ROUTE)
    assert (before.exit_code, after.exit_code) == (0, 0)
    hint = f"`burnish conform --measure --routes {ROUTE.partition(':')[0]}`"
    assert (hint in before.stdout, hint in after.stdout) == (True, False)
    wide, narrow = (_steps(each.stdout) for each in (before, after))
    assert narrow < wide / 2


def _steps(table: str) -> float:
    """The median of the bounds' widths, in steps."""
    (row,) = (line for line in table.splitlines() if line.startswith(f"  {ROUTE} "))
    return float(row.split("%")[1].split()[0])


def test_what_is_known_of_software_is_not_kept() -> None:
    result = invoke("conform", "--measure", "--routes", "lavapipe:glsl")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.endswith("\n  not kept: `conform` knows this driver\n")
    assert kept() == []


def test_a_device_that_is_lost_meanwhile(monkeypatch: pytest.MonkeyPatch) -> None:
    draw, left = Runner.draw_frame, [3]

    def lost(*arguments: Any, **options: Any) -> Any:
        if not left[0]:
            raise DriverError("the device was lost")
        left[0] -= 1
        return draw(*arguments, **options)

    monkeypatch.setattr(Runner, "draw_frame", lost)
    result = invoke("conform", "--measure", "--routes", ROUTE)
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr == (
        f"error: {ROUTE}: its device was not measured, and nothing is kept: the device was lost\n"
    )
    assert kept() == []


def test_a_device_that_reports_0_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    device = Device("Some GPU", "1", subpixel_bits=0, subtexel_bits=0, mip_bits=0)
    monkeypatch.setattr(Runner, "device", lambda *_: device)
    result = invoke("conform", "--measure", "--routes", ROUTE)
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr == (
        f"error: {ROUTE}: its device was not measured, and nothing is kept: it reports 0 bits for "
        "the places of vertices, so no picture of it can be compared\n"
    )
    assert kept() == []


def test_a_route_without_its_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "moderngl")
    result = invoke("conform", "--measure", "--routes", "opengl")
    assert (result.exit_code, result.stdout) == (1, "")
    command = f"{sys.executable} -m pip install 'burnish[run]'"
    assert result.stderr == (
        "warning: opengl:gl330: not measured: moderngl is missing; to install it: " + command + "\n"
    )
    assert kept() == []


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("m.burnish", "a FILE"), ("--report out", "--report"), ("--strict", "--strict"),
        ("--explain 1,2", "--explain"), ("--case behind", "--case"), ("--pass P", "--pass"),
    ],
)  # fmt: skip
def test_options_without_effect(line: str, what: str) -> None:
    result = invoke("conform", "--measure", *line.split())
    said = f"--measure compares nothing, so {what} has no effect: leave out one of them\n"
    assert (result.exit_code, result.stdout, result.stderr) == (2, "", USAGE + said)


def test_a_device_that_there_is_not() -> None:
    result = invoke("conform", "--measure", "--routes", ROUTE, "--device", "nobody's")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "nobody's" in result.stderr
    assert kept() == []
