"""Tools that crash, hang, are missing or too old say nothing of the shader, and stop nobody."""

from __future__ import annotations

import sys
from pathlib import Path
from threading import Timer
from threading import enumerate as enumerate_threads

import pytest

from burnish.targets.toolchain import CHECKERS, TOOLS, Job, Toolchain, inspect, workers
from burnish.targets.toolchain.tools import tool_named
from burnish.targets.toolchain.workers import Worker

from ..suite.processes import until
from .conftest import PlantTool

GLSLANG = "glslang/bin/glslangValidator"
GLSLANG_SAYS = "Glslang Version: 11:12.0.0"
GOOD_GL = "#version 330 core\nout vec4 o;\nvoid main() { o = vec4(1.0); }\n"
BAD_GL = "#version 330 core\nout vec4 o;\nvoid main() { o = vec4(x); }\n"
TOO_LONG = " + ".join(["x"] * 50_000)
"""A flat sum of so many terms overflows the stack of glslang and of DXC."""


@pytest.mark.parametrize("signal", ["SEGV", "ABRT", "KILL"])
def test_a_tool_that_is_killed_has_crashed(plant_tool: PlantTool, signal: str) -> None:
    plant_tool(GLSLANG, GLSLANG_SAYS, f"kill -{signal} $$")
    with Toolchain() as toolchain:
        [verdict] = toolchain.check([Job("glslang-gl330", "frag", GOOD_GL)])
    assert verdict.status == "crashed"
    assert "killed by signal" in verdict.log


def test_a_rust_panic_is_a_crash(plant_tool: PlantTool) -> None:
    plant_tool("spirv-tools/bin/spirv-val", "SPIRV-Tools v2023.1", "exit 0")
    plant_tool("spirv-tools/bin/spirv-opt", "", "exit 0")
    plant_tool("spirv-tools/bin/spirv-dis", "", "exit 0")
    plant_tool("naga-30.0.1/bin/naga", "30.0.1", "echo 'thread main panicked' >&2; exit 101")
    with Toolchain() as toolchain:
        [verdict] = toolchain.check([Job("naga", "frag", "")])
    assert verdict.status == "crashed"
    assert "panicked" in verdict.log


def test_a_tool_that_hangs_is_stopped(plant_tool: PlantTool) -> None:
    plant_tool(GLSLANG, GLSLANG_SAYS, "exec /bin/sleep 60")
    with Toolchain(time_limit=0.2) as toolchain:
        [verdict] = toolchain.check([Job("glslang-gl330", "frag", GOOD_GL)])
    assert verdict.status == "timeout"
    assert "0.2 s" in verdict.log


@pytest.mark.usefixtures("no_tools")
def test_a_missing_tool_is_never_taken_for_consent() -> None:
    with Toolchain() as toolchain:
        verdicts = toolchain.check([Job(name, "frag", GOOD_GL) for name in CHECKERS])
    assert {verdict.status for verdict in verdicts} == {"missing"}
    for verdict in verdicts:
        needed = tool_named(CHECKERS[verdict.job.checker].needs[0])
        assert needed.install in verdict.messages[0].text


@pytest.mark.usefixtures("no_tools")
def test_every_missing_tool_says_how_to_install_it() -> None:
    for tool in TOOLS:
        state = inspect(tool)
        assert state.paths == ()
        assert state.problem is not None
        assert tool.install in state.problem


def test_a_tool_that_is_too_old_is_not_used(plant_tool: PlantTool) -> None:
    plant_tool("naga-30.0.1/bin/naga", "0.19.0", "exit 0")
    state = inspect(tool_named("naga"))
    assert state.version == "0.19.0"
    assert state.problem is not None
    assert "older than 30" in state.problem


def test_the_cache_comes_before_the_path(
    plant_tool: PlantTool, no_tools: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plant_tool("elsewhere/glslangValidator", "Glslang Version: 11:1.0.0", "exit 0")
    monkeypatch.setenv("PATH", str(no_tools / "elsewhere"))
    assert inspect(tool_named("glslang")).version == "1.0.0"
    plant_tool(GLSLANG, GLSLANG_SAYS, "exit 0")
    assert inspect(tool_named("glslang")).version == "12.0.0"


def test_a_crash_in_a_batch_is_laid_to_the_text_that_caused_it(toolchain: Toolchain) -> None:
    monster = f"#version 330 core\nin float x; out vec4 o;\nvoid main() {{ o = vec4({TOO_LONG}); }}"
    texts = [GOOD_GL, BAD_GL, monster, GOOD_GL, GOOD_GL, BAD_GL]
    verdicts = toolchain.check([Job("glslang-gl330", "frag", text) for text in texts])
    assert [verdict.status for verdict in verdicts] == [
        "accepted",
        "rejected",
        "crashed",
        "accepted",
        "accepted",
        "rejected",
    ]


def test_dxc_is_started_anew_after_a_crash(toolchain: Toolchain) -> None:
    good = "float4 main(float x : A) : SV_Target0 { return x; }"
    texts = [good, good.replace("return x", f"return {TOO_LONG}"), good]
    verdicts = toolchain.check([Job("dxc-dxil", "frag", text) for text in texts])
    assert [verdict.status for verdict in verdicts] == ["accepted", "crashed", "accepted"]
    assert "killed by signal" in verdicts[1].log


def _python(code: str) -> Worker:
    return Worker(lambda: [sys.executable, "-c", code])


def test_a_worker_that_hangs_is_stopped() -> None:
    worker = _python("import time; time.sleep(60)")
    answer = worker.ask({}, 0.2)
    assert answer.ending == "timeout"
    assert "0.2 s" in answer.log


def test_a_dead_workers_last_words_are_kept() -> None:
    worker = _python(
        "import os, sys; input(); print('no!', file=sys.stderr, flush=True); os.abort()"
    )
    for _ in range(2):
        answer = worker.ask({}, 20)
        assert answer.ending == "crashed"
        assert "no!" in answer.log
        assert "killed by signal 6" in answer.log


def test_a_worker_that_closes_its_output_and_does_not_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workers, "END_LIMIT", 0.2)
    answer = _python("import os, time; os.close(1); time.sleep(600)").ask({}, 20)
    assert answer.ending == "crashed"
    assert "killed by signal 9" in answer.log


def test_no_timer_outlives_an_interrupt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C may come while the timer starts. If it went on, it would keep the process waiting."""
    start = Timer.start

    def interrupted(timer: Timer) -> None:
        start(timer)
        raise KeyboardInterrupt

    worker = _python("import time; time.sleep(600)")
    monkeypatch.setattr(Timer, "start", interrupted)
    with pytest.raises(KeyboardInterrupt):
        worker.ask({}, 600)
    worker.close()
    until(lambda: not any(isinstance(thread, Timer) for thread in enumerate_threads()), "its end")


def test_half_an_answer_is_none() -> None:
    answer = _python("input(); print('{\"ok\":', end='')").ask({}, 20)
    assert answer.ending == "crashed"


def test_a_worker_that_cannot_be_started_has_crashed() -> None:
    assert Worker(lambda: ["/nowhere/at/all"]).ask({}, 20).ending == "crashed"
