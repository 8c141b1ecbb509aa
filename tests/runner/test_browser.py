"""The browser's own: its processes, and devices that are lost."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator, Set
from dataclasses import replace
from pathlib import Path
from subprocess import PIPE

import pytest

from burnish.targets.runner.drivers.browser import chromium
from burnish.targets.runner.drivers.browser.driver import APIS, Browser
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.runner import frame_request

from ..suite.processes import Program, run, started, until
from . import textual_shaders as shaders
from .jobs_kit import draw_job
from .textual_kit import COMMANDS, RED, Asker, full, pipeline, shoot


def processes() -> dict[int, tuple[int, str]]:
    """The parent and the command line of every process."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            status = (folder / "stat").read_text().rpartition(")")[2].split()
            words = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
        except (FileNotFoundError, ProcessLookupError):
            continue
        if status[0] != "Z":
            found[int(folder.name)] = int(status[1]), words
    return found


def descendants(ancestor: int) -> dict[int, str]:
    """The command lines of all processes that descend from one."""
    everyone = processes()
    family = {ancestor}
    while more := {pid for pid, (parent, _) in everyone.items() if parent in family} - family:
        family |= more
    return {pid: everyone[pid][1] for pid in family - {ancestor}}


def await_end(family: Set[int], folder: Path) -> None:
    """Wait until a browser's processes have ended, and have removed their folder."""
    until(lambda: not family & processes().keys(), "the end of the browser's processes")
    until(lambda: not folder.exists(), "the end of the browser's folder")


def profile(commands: dict[int, str]) -> Path:
    """The folder that a browser was given for its data."""
    words = " ".join(commands.values()).split()
    return Path(next(w for w in words if w.startswith("--user-data-dir=")).partition("=")[2])


def browser_of(ancestor: int) -> tuple[set[int], Path]:
    """The processes of the browser that a process has started, and its folder."""
    commands = descendants(ancestor)
    assert any("--type=gpu-process" in words for words in commands.values())
    folder = profile(commands)
    assert folder.is_dir()
    return set(commands), folder


@pytest.fixture(params=list(APIS))
def worker(request: pytest.FixtureRequest) -> Iterator[Program]:
    """A worker that has answered once."""
    command = [sys.executable, "-m", *COMMANDS[request.param]]
    with started(command, stdin=PIPE, stderr=None) as program:
        program.write(b"{}\n")
        assert b"Chromium" in program.line()
        yield program


def test_ends_with_its_input(worker: Program) -> None:
    family, folder = browser_of(worker.pid)
    worker.close_input()
    assert worker.exit_code() == 0
    await_end(family, folder)


def test_ends_when_killed(worker: Program) -> None:
    family, folder = browser_of(worker.pid)
    worker.signal(signal.SIGKILL)
    await_end(family, folder)


PARENT = """
import sys, time
from burnish.targets.toolchain.limits import BROWSERS
from burnish.targets.toolchain.workers import Worker
worker = Worker(lambda: [sys.executable, "-m", *sys.argv[1:]], BROWSERS)
print(worker.ask({}, 120).reply, flush=True)
time.sleep(600)
"""


def test_ends_when_the_parent_is_killed() -> None:
    command = [sys.executable, "-c", PARENT, *COMMANDS["webgl2"]]
    with started(command, stderr=None) as parent:
        assert b"Chromium" in parent.line()
        family, folder = browser_of(parent.pid)
        parent.signal(signal.SIGKILL)
        await_end(family, folder)


HANG_WGSL = shaders.PAINT_WGSL.replace(
    "return color;", "var c = color; while (c.x < 2.0) { c.y += 1.0; } return c;"
)


def test_ends_in_the_midst_of_a_job() -> None:
    """The worker is killed when its time is up. The hanging browser then has half a minute.

    One pixel hangs: more of them would keep all processors busy meanwhile.
    """
    api = "webgpu"
    before = descendants(os.getpid()).keys()
    own = Asker(api)
    own.device()
    commands = descendants(os.getpid())
    family = commands.keys() - before
    folder = profile({pid: commands[pid] for pid in family})
    pixel = replace(full(RED), width=1, height=1)
    hanging = draw_job(pipeline(api, wgsl=HANG_WGSL), (pixel,))
    assert own.answer(frame_request(hanging), 3.0).ending == "timeout"
    await_end(family, folder)
    own.close()


@pytest.mark.parametrize("api", list(APIS))
def test_survives_the_loss_of_the_gpu_process(api: str) -> None:
    """One job may be lost, or none; those after it are drawn."""
    before = descendants(os.getpid()).keys()
    own = Asker(api)
    job = draw_job(pipeline(api), (full(RED),))
    own.draw(job)
    for pid, words in descendants(os.getpid()).items():
        if pid not in before and "--type=gpu-process" in words:
            os.kill(pid, signal.SIGKILL)
    try:
        own.draw(job)
    except DriverError as error:
        assert "lost" in str(error).lower()
    (picture,) = own.draw(job)
    assert picture
    own.close()


@pytest.mark.parametrize("api", list(APIS))
def test_missing_browser(api: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(DriverError, match="chromium is missing; to install it: apt-get"):
        Browser(api).device()


def test_a_browser_that_hangs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    fake = tmp_path / "chromium"
    fake.write_text("#!/bin/sh\nexec sleep 600\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setattr(chromium, "START_LIMIT", 1000.0)
    before = descendants(os.getpid()).keys()
    with pytest.raises(DriverError, match=r"chromium does not start: .*Timeout 1000ms exceeded"):
        Browser("webgpu").device()
    until(lambda: not descendants(os.getpid()).keys() - before, "the end of what was started")


def test_missing_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    monkeypatch.delitem(
        sys.modules, "burnish.targets.runner.drivers.browser.chromium", raising=False
    )
    with pytest.raises(DriverError, match=r"playwright.*to install it: .*pip install"):
        Browser("webgpu").device()


def test_wgsl_warnings_are_errors() -> None:
    wgsl = shaders.PAINT_WGSL.replace("return color;", "return color; _ = color.x;")
    with pytest.raises(DriverError, match="warning: code is unreachable"):
        shoot("webgpu", draw_job(pipeline("webgpu", wgsl=wgsl), (full(RED),)))


def test_texture_reads_in_varying_control_flow() -> None:
    """Chromium refuses such reads, although naga accepts them."""
    wgsl = shaders.TEXTURED_WGSL.replace(
        "return textureSample", "if (color.x > 0.5) { return color; }\n return textureSample"
    )
    with pytest.raises(DriverError, match="uniform control flow"):
        shoot("webgpu", draw_job(pipeline("webgpu", wgsl=wgsl), (full(RED),)))


def test_usage() -> None:
    command = [sys.executable, "-m", "burnish.targets.runner.drivers.browser", "webgl1"]
    told = run(command)
    assert told.returncode == 1
    assert told.stderr == "usage: python -m burnish.targets.runner.drivers.browser webgpu|webgl2\n"
