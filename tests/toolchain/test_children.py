"""Child programs: their environment, their limits, and that they end with Burnish."""

from __future__ import annotations

import os
import signal
import sys
from functools import partial
from pathlib import Path

import pytest

from burnish.compiler.budget import raised
from burnish.targets.toolchain import Job, Toolchain, process, toolbox
from burnish.targets.toolchain.children import Child
from burnish.targets.toolchain.limits import COMPILERS, MB, WORKERS, Limits
from burnish.targets.toolchain.surroundings import python_worker, which
from burnish.targets.toolchain.workers import Worker

from ..suite.processes import Background, started, until
from .conftest import PlantTool

SMALL = Limits(memory=200 * MB, file=MB, output=MB)
ECHO = """
import sys, json
for line in sys.stdin:
    print(json.dumps(eval(json.loads(line)["code"])), flush=True)
"""
"""A worker that answers with the value of what it is sent."""


def program(folder: Path, name: str, deed: str) -> Path:
    """A shell script."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{deed}\n")
    path.chmod(0o755)
    return path


def python(code: str, row: Limits = SMALL, seconds: float = 60) -> process.Outcome:
    return process.run([sys.executable, "-I", "-c", code], time_limit=seconds, limits=row)


# --- where programs are looked for, and what they see --------------------------------------------


@pytest.mark.parametrize("entry", [".", "", "bin", "./bin", "{here}"])
def test_no_program_of_the_current_folder_is_found(
    entry: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for folder in (tmp_path, tmp_path / "bin"):
        program(folder, "naga", "exit 0")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", os.pathsep.join([entry.format(here=tmp_path), "/nowhere"]))
    assert which("naga") is None
    monkeypatch.chdir("/")
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    assert which("naga") == tmp_path / "bin" / "naga"


def test_a_program_sees_no_path_into_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f".::{tmp_path}:/usr/bin:bin")
    monkeypatch.setenv("PYTHONPATH", ".")
    monkeypatch.setenv("PYTHONSTARTUP", "x.py")
    said = python("import os; print(os.getcwd(), dict(os.environ))").log
    assert said.startswith("/ ")
    assert "'PATH': '/usr/bin'" in said
    assert "PYTHON" not in said
    assert str(tmp_path) not in said.replace(os.environ.get("PYTEST_CURRENT_TEST", ""), "")


def test_a_program_is_started_by_its_absolute_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program(tmp_path, "naga", "exit 0")
    monkeypatch.chdir(tmp_path)
    for command in ("naga", "./naga"):
        outcome = process.run([command], time_limit=20)
        assert outcome.ending == "crashed"
        assert "is no absolute path" in outcome.log


WORKER = "burnish.commands.judging_process"
TRAP = "import os\nos._exit(77)\n"


@pytest.mark.parametrize("path", ["", ".", "{here}", "{here}/.:{here}/more"])
def test_a_python_worker_imports_nothing_of_the_current_folder(
    path: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("json", "random", "numpy", "pickle", "sitecustomize", "usercustomize", "runpy"):
        (tmp_path / f"{name}.py").write_text(TRAP)
    (tmp_path / "burnish").mkdir()
    (tmp_path / "burnish" / "__init__.py").write_text(TRAP)
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "json.py").write_text(TRAP)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", path.format(here=tmp_path))
    answer = Worker(lambda: python_worker(WORKER), WORKERS).ask({"question": ""}, 60)
    assert "EOFError: Ran out of input" in answer.log
    assert "exit code 77" not in answer.log


def test_a_python_worker_finds_what_the_user_names_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A module from there is found if no other folder has it; no other module is replaced."""
    (tmp_path / "json.py").write_text(TRAP)
    (tmp_path / "further.py").write_text("print('{\"found\": true}', flush=True)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    command = python_worker(WORKER)
    assert Worker(lambda: [*command[:4], "further"]).ask({}, 60).ending == "crashed"  # no package
    code = "import sys; sys.path += sys.argv[1:]; import further, json"
    answer = Worker(lambda: [sys.executable, "-I", "-c", code, command[3]]).ask({}, 60)
    assert answer.reply == {"found": True}


@pytest.mark.parametrize("variable", ["BURNISH_TOOLS", "BURNISH_CACHE"])
def test_relative_caches_do_not_count(
    variable: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from burnish.compiler import cache
    from burnish.targets.toolchain.tools import cache_folder

    monkeypatch.chdir(tmp_path)
    for name in ("BURNISH_TOOLS", "BURNISH_CACHE"):
        monkeypatch.delenv(name, raising=False)
    usual = cache.private_folder(), cache_folder()
    monkeypatch.setenv(variable, "tools")
    assert (cache.private_folder(), cache_folder()) == usual


# --- limits --------------------------------------------------------------------------------------


def test_too_much_memory_is_told() -> None:
    outcome = python("x = bytearray(300_000_000)")
    assert outcome.ending == "ended"  # Python itself says what it lacks.
    assert "MemoryError" in outcome.log
    outcome = python(
        "import os, sys\ntry: bytearray(10**9)\n"
        "except MemoryError: sys.stderr.write('std::bad_alloc'); sys.stderr.flush(); os.abort()"
    )
    assert outcome.ending == "crashed"
    assert outcome.log == "it needs more than 200 MB of memory, which is all that it may take\n"


def test_a_worker_that_needs_too_much_memory() -> None:
    worker = Worker(lambda: [sys.executable, "-I", "-c", ECHO], SMALL)
    assert worker.ask({"code": "{1: 1 + 1}"}, 60).reply == {"1": 2}
    answer = worker.ask({"code": "len(bytearray(10**9))"}, 60)
    assert answer.ending == "crashed"
    assert answer.log == "it needs more than 200 MB of memory, which is all that it may take\n"
    worker.close()


INLINED = "\n".join(
    [
        "float f0(float x) { return sin(x) * x; }",
        *(f"float f{n + 1}(float x) {{ return f{n}(x) + f{n}(x * 1.5); }}" for n in range(17)),
        "float4 main(float x : A) : SV_Target0 { return f17(x); }",
    ]
)
"""DXC inlines every call, which are more than a hundred thousand."""


def test_a_compiler_that_needs_too_much_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(toolbox, "COMPILERS", Limits(memory=150 * MB, file=MB, output=MB))
    with Toolchain() as toolchain:
        [verdict] = toolchain.check([Job("dxc-dxil", "frag", INLINED)])
    assert verdict.status == "crashed"
    assert verdict.log == "it needs more than 150 MB of memory, which is all that it may take\n"


def test_what_may_be_drawn_at_once_raises_the_limit_of_drivers() -> None:
    with raised({"memory": 3 * 10**9}):
        assert WORKERS.scaled().memory == 3 * WORKERS.memory
        assert COMPILERS.scaled() == COMPILERS
    with raised({"memory": 10**6}):
        assert WORKERS.scaled() == WORKERS


@pytest.mark.parametrize("stream", [1, 2])
def test_output_without_end_is_stopped(stream: int) -> None:
    outcome = python(f"import os\nwhile True: os.write({stream}, b'x' * 10_000)")
    assert outcome.ending == "crashed"
    assert outcome.log.endswith("stopped, after it had written more than 1 MB\n")
    assert len(outcome.log) < 1000


@pytest.mark.parametrize("stream", [1, 2])
def test_a_worker_that_writes_without_end_is_stopped(stream: int) -> None:
    code = f"import os\nwhile True: os.write({stream}, b'x' * 10_000)"
    answer = Worker(lambda: [sys.executable, "-I", "-c", code], SMALL).ask({}, 60)
    assert answer.ending == "crashed"
    assert len(answer.log) < 50_000
    what = "an answer" if stream == 1 else "messages"
    assert answer.log.endswith(f": stopped, after {what} of more than 1 MB\n")


def test_an_answer_that_is_no_json() -> None:
    code = "print('yes', flush=True); input()"
    answer = Worker(lambda: [sys.executable, "-I", "-c", code]).ask({}, 60)
    assert answer.ending == "crashed"
    assert "an answer that is no JSON" in answer.log


def test_files_and_core_dumps_are_limited(tmp_path: Path) -> None:
    file = tmp_path / "large"
    outcome = python(f"open({str(file)!r}, 'wb').write(bytes(10_000_000))")
    assert "File too large" in outcome.log
    assert file.stat().st_size == MB
    code = "import resource as r; print(r.getrlimit(r.RLIMIT_CORE), r.getrlimit(r.RLIMIT_CPU))"
    assert python(f"import time; time.sleep(0.3); {code}").log == "(0, 0) (65, 65)\n"


def test_a_program_that_leaves_another_one_behind(tmp_path: Path) -> None:
    """The program left behind holds the answer's pipe open, and is ended as well."""
    script = program(tmp_path, "leaving", "sleep 600 & echo $!")
    outcome = process.run([str(script)], time_limit=1)
    assert outcome.ending == "ended"
    left = Path("/proc") / outcome.output.decode().strip() / "cmdline"
    until(lambda: not left.exists() or not left.read_bytes(), "the end of what was left behind")


# --- the end -------------------------------------------------------------------------------------

PARENT = """
import sys, time
from threading import Thread
from burnish.targets.toolchain import children, lifeline, process
if sys.argv[1] == "worker":
    from burnish.targets.toolchain.limits import WORKERS
    from burnish.targets.toolchain.surroundings import python_worker
    if "bare" in sys.argv:
        class Loose(lifeline.Lifeline):
            def __init__(self):
                self.passed, self._held = (), None
            def tie(self, process, *, group):
                pass
        children.Lifeline = Loose
    child = children.Child(python_worker("burnish.tests.toolchain.sleeping"), WORKERS)
    print(child.process.stdout.readline().decode(), flush=True)
    time.sleep(600)
else:
    call = lambda: process.run(["/bin/sh", "-c", "sleep 600 & sleep 601"], time_limit=600)
    Thread(target=call).start()
    time.sleep(0.5)
    print("started", flush=True)
"""


@pytest.mark.parametrize("kind", [("tool",), ("worker",), ("worker", "bare")], ids=" ".join)
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_programs_end_with_whoever_has_started_them(
    kind: tuple[str, ...], number: signal.Signals
) -> None:
    """Workers do so even where the kernel does not help, as on other systems than Linux."""
    with started([sys.executable, "-c", PARENT, *kind], stderr=None) as parent:
        assert parent.line().strip()
        assert len(parent.family()) == (4 if kind == ("tool",) else 2)
        parent.signal(number)
        until(lambda: not parent.family(), "the end of all programs", limit=10)


def test_closing_ends_what_others_wait_for(plant_tool: PlantTool) -> None:
    """This is what Ctrl-C leads to: nobody waits for a compiler until its time is up."""
    plant_tool("glslang/bin/glslangValidator", "Glslang Version: 11:12.0.0", "exec /bin/sleep 600")
    toolchain = Toolchain(time_limit=600)
    jobs = [Job("glslang-gl330", "frag", f"#version 330 // {number}") for number in range(40)]
    running = Background(partial(toolchain.check, jobs))
    until(lambda: toolchain._toolbox._running._living, "the first of the compilers")
    Background(toolchain.close).returned(20)
    assert {verdict.status for verdict in running.returned(20)} == {"crashed"}


def test_closing_ends_a_worker_that_is_asked() -> None:
    worker = Worker(lambda: [sys.executable, "-I", "-c", ECHO])
    asked = Background(partial(worker.ask, {"code": "__import__('time').sleep(600)"}, 600))
    until(lambda: worker._child, "the worker's process")
    Background(worker.close).returned(20)
    assert asked.returned(20).ending == "crashed"
    assert worker.ask({"code": "1"}, 20).ending == "crashed"


def test_a_child_that_cannot_be_started_leaves_nothing_open() -> None:
    before = len(os.listdir("/proc/self/fd"))  # noqa: PTH208
    for _ in range(20):
        with pytest.raises(OSError, match="nowhere"):
            Child(["/nowhere/at/all"], SMALL)
    assert len(os.listdir("/proc/self/fd")) <= before + 1  # noqa: PTH208
