"""Compiles one program after the other and says what each phase of the compile took.

Run as a process of its own, by ``checkout``, with the folder that holds the package ``burnish`` in
front of everything on ``PYTHONPATH``. So it may be another checkout's compiler that is measured,
and a program that takes too long or too much memory ends this process alone. Requests come as
lines of JSON, and so do the answers.
"""

from __future__ import annotations

import gc
import importlib.util
import json
import resource
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import burnish
from burnish.compiler.diagnostics.render import render_all

HOOKS = (
    ("parse", "burnish.compiler.frontend", "Frontend.open_file"),
    ("semantics", "burnish.compiler.frontend", "Frontend.shaders"),
    ("passes", "burnish.api.compiling", "stage"),
    ("emission", "burnish.api.compiling", "emit"),
)
"""The work of each phase: the function or method, at the place where its caller looks it up."""
BEFORE = {"burnish.api.compiling": "burnish.api.entry_points"}
"""The names of modules in older checkouts."""

MEMORY_LIMIT = 6 << 30
DOCUMENT = ".mtlx"


class Phases:
    """CPU seconds of one compile, by phase."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    def timed(self, phase: str, work: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        """The result of ``work``, whose time counts for ``phase``."""
        start = process_time()
        try:
            return work(*arguments, **named)
        finally:
            self.seconds[phase] = self.seconds.get(phase, 0.0) + process_time() - start

    def hook(self, phase: str, module: str, path: str) -> None:
        """Time every call of what is found at ``path`` in ``module``."""
        *owners, name = path.split(".")
        there = importlib.util.find_spec(module) is not None
        owner: Any = importlib.import_module(module if there else BEFORE[module])
        for part in owners:
            owner = getattr(owner, part)
        work = getattr(owner, name)

        def hooked(*arguments: Any, **named: Any) -> Any:
            return self.timed(phase, work, *arguments, **named)

        setattr(owner, name, hooked)


def compiled(path: str, targets: list[str], reflect: bool, phases: Phases) -> list[str]:
    """Compile a file; the codes of what is wrong with it. A document of MaterialX is imported."""
    if path.endswith(DOCUMENT):
        with TemporaryDirectory() as folder:
            return compiled(imported(path, Path(folder)), targets, reflect, phases)
    try:
        result = burnish.compile(path, targets)
    except burnish.CompileError as error:
        phases.timed("messages", render_all, error.diagnostics)
        return errors_in(error.diagnostics)
    for material in result.materials:
        if reflect:
            phases.timed("reflection", getattr, material, "reflection")
    return []


def imported(path: str, folder: Path) -> str:
    """Write the files that a document of MaterialX becomes; the path of the main one."""
    from burnish.materialx import importing

    found = importing.imported(Path(path))
    for name, content in found.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return str(folder / found.main)


def worked(request: dict[str, Any], phases: Phases) -> list[str]:
    """Compile or check a file; the codes of what is wrong with it."""
    if request["check"]:
        return errors_in(burnish.check(Path(request["path"])))
    return compiled(request["path"], request["targets"], request["reflect"], phases)


def errors_in(diagnostics: Iterable[Any]) -> list[str]:
    """The codes of the errors among some diagnostics."""
    return sorted({found.rule.code for found in diagnostics if found.severity == "error"})


def measured(request: dict[str, Any], phases: Phases) -> dict[str, Any]:
    """The best time of each phase over several compiles, and what came of them."""
    best: dict[str, float] = {}
    codes: list[str] = []
    spent, runs = 0.0, 0
    while runs == 0 or (spent < request["enough"] and runs < request["runs"]):
        gc.collect()
        phases.seconds.clear()
        start = process_time()
        for _ in range(request["times"]):
            codes = worked(request, phases)
        phases.seconds["all"] = process_time() - start
        for phase, seconds in phases.seconds.items():
            each = seconds / request["times"]
            best[phase] = min(each, best.get(phase, each))
        spent, runs = spent + phases.seconds["all"], runs + 1
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return {"seconds": best, "codes": codes, "megabytes": peak}


class Memory:
    """What the compiler keeps in a process, as far as this checkout's compiler keeps something."""

    def __init__(self) -> None:
        self._places: list[tuple[Any, str, Any, Any]] = []
        entry_points = importlib.import_module("burnish.api.entry_points")
        if (usual := getattr(entry_points, "_REMEMBERED", None)) is not None:
            self._places.append((entry_points, "_REMEMBERED", usual, type(usual)(results=0)))
        frontend = importlib.import_module("burnish.compiler.frontend")
        if (nothing := getattr(frontend, "NOTHING_KNOWN", None)) is not None:
            self._places.append((frontend, "KNOWN_RIGHT", frontend.KNOWN_RIGHT, nothing))
        parser = importlib.import_module("burnish.compiler.syntax.parser")
        # Checkouts before `opening` was a module of its own parse in the frontend.
        is_old = hasattr(frontend, "parse")
        opening = frontend if is_old else importlib.import_module("burnish.compiler.opening")
        self._places.append((opening, "parse", opening.parse, parser.parse))

    def use(self, remember: bool) -> None:
        """Have compiles remember; or have each of them do its work, also if it is the same."""
        for owner, name, usual, nothing in self._places:
            setattr(owner, name, usual if remember else nothing)


def main() -> None:
    """Answer requests until there are no more."""
    memory = Memory()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
    phases = Phases()
    for hook in HOOKS:
        phases.hook(*hook)
    for line in sys.stdin:
        request = json.loads(line)
        limit = int(process_time() + request["limit"]) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.RLIM_INFINITY))
        memory.use(request["remember"])
        try:
            answer = measured(request, phases)
        except Exception as error:  # Whatever it is, the size is one that cannot be compiled.
            answer = {"failed": type(error).__name__}
        print(json.dumps(answer), flush=True)


main()
