"""What drivers have read back is kept: texels, elements and vertices alike."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.budget import BudgetError
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.drivers.frame_job import Captured, Found, FrameTexels
from burnish.targets.runner.drivers.wire import packed, split, unpacked
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain.pipe import Packet

from .frame_kit import back, job, texture

ROUTE = ROUTES["lavapipe:glsl"]
FOUND = Found(
    (FrameTexels(1, 1, 2, bytes(range(32))), FrameTexels(1, 1, 1, bytes(range(16)))),
    (b"", b"elements"),
    (Captured(0, b""), Captured(2, b"vertices")),
)


@pytest.mark.parametrize("found", [FOUND, Found()])
def test_results_are_packed_without_a_change(found: Found) -> None:
    assert unpacked(Found, packed(found)) == found


def test_the_same_job_is_done_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []

    def answer(_runner: Runner, _driver: str, request: Any) -> Any:
        asked.append(request)
        content, data = split(FOUND)
        return Packet({"found": content}, data)

    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    monkeypatch.setattr(Runner, "_ask", answer)
    monkeypatch.setattr(Runner, "device", lambda *_: Device("a device", "1", 8, 8, 8))
    first = job([texture()], [], back(0))
    other = replace(first, textures=(texture(size=8),))
    with Runner([ROUTE]) as runner, Runner([ROUTE], reuse=False) as forgetful:
        for expected, one in ((1, first), (1, first), (2, other), (2, first)):
            assert runner.draw_frame(ROUTE, one) == FOUND
            assert len(asked) == expected
        for expected in (3, 4):
            assert forgetful.draw_frame(ROUTE, first) == FOUND
            assert len(asked) == expected


def test_a_job_that_reads_back_too_much_is_not_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Runner, "_ask", lambda *_: pytest.fail("it is sent"))
    large = job([texture(size=16384)], [], back(0))
    with Runner([ROUTE], reuse=False) as runner, pytest.raises(BudgetError) as raised:
        runner.draw_frame(ROUTE, large)
    assert str(raised.value).startswith("what a driver is sent and sends back needs ")
