"""No test waits without a limit: what hangs has to fail, and must not stop all that come after it.

Tests wait through ``suite/processes.py``, whose functions have limits. Whatever else could wait for
ever is looked for here, in the text of all tests.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

import pytest

from .kit import ROOT, files

TESTS = ROOT / "tests"

OUTSIDE = {
    "suite/processes.py": "starts and awaits programs and threads for all others, with limits",
    "bench/checkout.py": "no test; its worker ends itself by a limit on its CPU time",
    "engines/godot.py": "ends its display by itself, and looks for its number for a limited time",
    "library/mutants.py": "its threads wait for processes with a limit each",
    "mutants/judge/children.py": "a process with a limit for each mutant, which is then killed",
}
"""The modules that may wait in their own way, and why."""

LIMITED = {
    "acquire", "call", "check_call", "check_output", "communicate", "exception", "get", "join",
    "recv", "result", "run", "shutdown", "wait",
}  # fmt: skip
"""Functions that wait, unless they are told for how long."""
OF_SUBPROCESS = {"call", "check_call", "check_output", "communicate", "run"}
"""The functions of ``LIMITED`` that also take other arguments."""
ENDLESS = {
    "Pool", "Popen", "ProcessPoolExecutor", "ThreadPoolExecutor", "getoutput", "getstatusoutput",
    "pause", "popen", "sigwait", "system", "urlopen", "waitpid",
}  # fmt: skip
"""Functions that have no limit, or are easily called without one, or what they make has none."""
LOCKING = {"flock", "lockf"}
"""Functions that wait, unless they are told ``LOCK_NB``."""
STARTING = {"Thread", "Timer", "Process"}
"""Classes whose threads or processes keep the tests' process alive, unless they are daemons."""
READING = {"read", "readline", "readlines"}
PIPES = {"stdout", "stderr"}


def unlimited(text: str) -> Iterator[str]:
    """The calls and loops in a module that may wait for ever, each with its line."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and _may_hang(node):
            yield f"{node.lineno}: {ast.unparse(node.func)}(...)"
        if isinstance(node, ast.While) and any(map(_is_sleep, ast.walk(node))):
            yield f"{node.lineno}: while {ast.unparse(node.test)}"


def _may_hang(call: ast.Call) -> bool:
    name = _name(call.func)
    options = {keyword.arg for keyword in call.keywords}
    if name in STARTING:
        return "daemon" not in options and not _is_own(call.func)
    if name in OF_SUBPROCESS:
        of_subprocess = name == "communicate" or _owner(call.func) == "subprocess"
        return of_subprocess and "timeout" not in options
    if name in LIMITED and isinstance(call.func, ast.Attribute):
        return not call.args and "timeout" not in options
    if name in LOCKING:
        return "LOCK_NB" not in ast.unparse(call)
    if name in READING:
        return _owner(call.func) in PIPES
    return name in ENDLESS and not _is_own(call.func)


def _is_own(function: ast.expr) -> bool:
    """True if the function is a method of a test's own object, such as ``self.system()``."""
    return isinstance(function, ast.Attribute) and _owner(function) in {"self", "cls"}


def _is_sleep(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and _name(node.func) == "sleep"


def _name(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _owner(function: ast.expr) -> str:
    return _name(function.value) if isinstance(function, ast.Attribute) else ""


MODULES = {
    path.relative_to(TESTS).as_posix(): path for path in files(TESTS) if path.suffix == ".py"
}


@pytest.mark.parametrize("name", sorted(MODULES.keys() - OUTSIDE.keys()))
def test_nothing_waits_without_a_limit(name: str) -> None:
    assert not list(unlimited(MODULES[name].read_text("utf-8")))


@pytest.mark.parametrize("name", OUTSIDE)
def test_the_modules_outside_are_outside_for_a_reason(name: str) -> None:
    assert list(unlimited(MODULES[name].read_text("utf-8")))


@pytest.mark.parametrize(
    "line",
    [
        "subprocess.run(command, check=True)",
        "process.communicate(b'')",
        "process.wait()",
        "thread.join()",
        "queue.get()",
        "future.result()",
        "barrier.wait()",
        "lock.acquire()",
        "child.stdout.readline()",
        "os.system('make')",
        "fcntl.flock(file, fcntl.LOCK_EX)",
        "with ThreadPoolExecutor(2) as threads: threads.map(f, x)",
        "Thread(target=work).start()",
        "urllib.request.urlopen(address)",
        "while not path.exists(): time.sleep(1)",
    ],
)
def test_what_waits_is_found(line: str) -> None:
    assert len(list(unlimited(line))) == 1


@pytest.mark.parametrize(
    "line",
    [
        "subprocess.run(command, timeout=60)",
        "process.wait(60)",
        "', '.join(words)",
        "table.get(name)",
        "run(command)",
        "path.open().readline()",
        "fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)",
        "time.sleep(1)",
    ],
)
def test_what_has_a_limit_is_not_found(line: str) -> None:
    assert not list(unlimited(line))
