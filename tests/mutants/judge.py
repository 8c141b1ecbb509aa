"""Runs in a process of its own, and imports a copy of the package: is its mutant noticed?

``python judge.py FOLDER …`` answers one line of JSON on its standard input with one on its output.
It compiles the materials of the folders, and compares their texts and what drivers are told with
what the unchanged package came to, which it was asked for first. Of what is different, it draws
pictures until one is wrong. Each question is answered by a process of its own, which has loaded
everything but the package already. It imports nothing of the tests, as the copy does not contain
them.
"""

from __future__ import annotations

import json
import os
import re
import select
import signal
import struct
import sys
import threading
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from functools import cached_property, partial
from hashlib import blake2b
from importlib import import_module
from pathlib import Path
from types import CodeType, FrameType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burnish.api import CompiledMaterial
    from burnish.targets.runner.runner import Runner
    from burnish.targets.toolchain import Toolchain

DRAWN = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga", "llvmpipe:gl330")
"""The fastest route of each language, in the order in which they draw."""
NOTICED = ("differs", "failed")
SMALL = (36, 28)
"""The size of the pictures that are drawn first, as most errors show in a small one."""
PICTURES = 16
"""So many materials and routes are drawn at most: first each material once, on its first route."""
LARGE_PICTURES = 2
"""Of so many of them, large pictures are drawn if small ones are right."""
PATIENCE = 150.0
"""How many seconds a mutant has; one that takes longer hangs, or is as good as that."""
LONG = 3600.0
"""The same for a question about all materials."""

IN_RUNTIME = "targets/runner/"
"""Where the files are that compute what drivers are told; the others determine what texts say."""
DEFECTIVE = {"gathered: Varying"}
"""Materials that show a driver's bug."""

Name = tuple[str, str]
"""A file, and one of its passes."""
Answer = dict[str, Any]
"""What is printed as JSON."""


@dataclass(frozen=True, slots=True)
class Question:
    """What a process is asked."""

    kind: str
    """``known``: what do all materials come to without a mutant, and which of them run which lines?
    ``mutant``: is the mutant noticed?"""
    into: str = ""
    """The file into which a long answer is written."""
    path: str = ""
    """The file of the mutant, relative to the package."""
    materials: tuple[str, ...] = ()
    """The materials that can show it, as ``label`` has them."""
    known: Mapping[str, str] | None = None
    """What these came to without the mutant."""
    everything: bool = False
    """Whether to draw also what does not differ, because the code that draws is different. When
    asked what is known: whether to look also what code compilers make of it, and who draws it."""


def main(folders: Sequence[str]) -> None:
    """Answer questions until there are none."""
    for name in _in_child(_loaded, PATIENCE)["loaded"]:
        import_module(name)
    for line in sys.stdin:
        asked = Question(**json.loads(line))
        limit = PATIENCE if asked.kind == "mutant" else LONG
        answer = _in_child(partial(_answered, asked, folders), limit)
        print(json.dumps(answer), flush=True)


def _in_child(work: Callable[[], Answer], limit: float) -> Answer:
    """What a function returns in a process of its own, which may take so many seconds."""
    source, sink = os.pipe()
    child = os.fork()
    if not child:
        os.setsid()
        os.close(source)
        os.dup2(2, 1)  # the answer is all that this program may print
        try:
            answer = work()
        except Exception as error:
            where = traceback.extract_tb(error.__traceback__)[-1]
            place = f"{Path(where.filename).name}:{where.lineno}"
            answer = {"verdict": "caught", "by": f"{type(error).__name__} at {place}"}
        with os.fdopen(sink, "w") as stream:
            json.dump(answer, stream)
        os._exit(0)
    os.close(sink)
    data = b""
    with os.fdopen(source, "rb", buffering=0) as stream:
        while select.select([stream], [], [], limit)[0] and (part := stream.read(1 << 20)):
            data += part
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return json.loads(data) if data else {"verdict": "caught", "by": "it takes too long, or ends"}


def _loaded() -> Answer:
    """The names of all modules that the package needs and that are no part of it."""
    _drawing_modules()
    names = [name for name in sys.modules if not name.startswith(("burnish", "__"))]
    return {"loaded": [name for name in names if not name.startswith("_")]}


def _drawing_modules() -> None:
    import_module("burnish.targets.conformance.conform")
    import_module("burnish.api")


def _answered(asked: Question, folders: Sequence[str]) -> Answer:
    if asked.kind == "known":
        # Before anything is imported.
        reached = _in_child(partial(_reached, folders, drawn=asked.everything), LONG)
        behaviour = dict(row for name in names(folders) for row in _behaviour(name, told=True))
        if asked.everything:
            with _Studio() as studio:
                behaviour |= dict(row for name in names(folders) for row in _codes(name, studio))
        known = {"behaviour": behaviour, "reached": reached}
        Path(asked.into).write_text(json.dumps(known), encoding="utf-8")
        return {}
    return _judged(asked)


# --- what a material comes to ---------------------------------------------------------------------


def label(name: Name) -> str:
    """``operations: Limits`` for a file and one of its passes."""
    path, pass_ = name
    return f"{Path(path).stem}: {pass_}"


def names(folders: Iterable[str]) -> Iterator[Name]:
    """All materials of some folders."""
    from burnish import api

    for folder in folders:
        for path in sorted(Path(folder).glob("*.burnish")):
            for _rig, pass_ in api.variants(path):
                if pass_ is not None and f"{path.stem}: {pass_}" not in DEFECTIVE:
                    yield str(path), pass_


def compiled(name: Name) -> CompiledMaterial:
    """A material, compiled for the profiles of all routes that draw."""
    import burnish
    from burnish.targets.runner.routes import ROUTES

    path, pass_ = name
    profiles = [ROUTES[route].profile for route in DRAWN]
    (material,) = burnish.compile(path, profiles, pass_=pass_, partial=True).materials
    return material


def _behaviour(name: Name, *, told: bool) -> Iterator[tuple[str, str]]:
    """Digests of a material's texts on each route and, if ``told``, of what its driver is told."""
    material = compiled(name)
    for route, text in _texts(material):
        yield f"{label(name)}, {route}: text", _digest(text)
    if told:
        for route, data in _told(material):
            yield f"{label(name)}, {route}: told", _digest(data)


def _codes(name: Name, studio: _Studio) -> Iterator[tuple[str, str]]:
    """Digests of a material's code and reflection on each route."""
    material = compiled(name)
    for route, _ in _texts(material):
        code = studio.code(material, route)
        yield f"{label(name)}, {route}: code", _digest((code, material.reflection))


def _texts(material: CompiledMaterial) -> Iterator[tuple[str, object]]:
    from burnish.targets.runner.routes import ROUTES

    for name in DRAWN:
        profile = ROUTES[name].profile
        if profile not in material.lacking:
            files = [file for file in material.files if f"{file.target}:{file.profile}" == profile]
            texts = [(file.text, sorted(file.entry_points.items())) for file in files]
            yield name, (texts, material.reflection)


def _told(material: CompiledMaterial) -> Iterator[tuple[str, object]]:
    """For each route what its driver is told, without the code."""
    from burnish.targets.conformance.cases import series_of
    from burnish.targets.runner.binding import pipeline
    from burnish.targets.runner.codes import Codes
    from burnish.targets.runner.drivers.draw import Code, Job
    from burnish.targets.runner.drivers.wire import to_json
    from burnish.targets.runner.routes import ROUTES

    work = [
        (series.exact, [to_json(case.state.draw()) for case in series.cases])
        for series in series_of(material.reflection)
    ]
    for name in DRAWN:
        route = ROUTES[name]
        if route.profile not in material.lacking:
            entries = {
                stage: Code(entry, "")
                for file in material.files
                if f"{file.target}:{file.profile}" == route.profile
                for stage, entry in file.entry_points.items()
            }
            jobs = [
                to_json(Job(pipeline(material.reflection, route, Codes(entries), exact=exact), ()))
                for exact, _ in work
            ]
            yield name, (jobs, work)


def _digest(data: object) -> str:
    text = json.dumps(data, sort_keys=True, default=str)
    return blake2b(text.encode(), digest_size=8).hexdigest()


# --- a mutant -------------------------------------------------------------------------------------


def _judged(asked: Question) -> Answer:
    """Compile one material after the other, and draw what differs, until a picture is wrong."""
    in_runtime = asked.path.startswith(IN_RUNTIME)
    same_code = {} if in_runtime or asked.everything else asked.known or {}
    different: list[str] = []
    waiting: list[tuple[Name, CompiledMaterial, str]] = []
    with _Studio() as studio:
        for name in map(_named, asked.materials):
            routes = list(_different(name, asked))
            different += [f"{label(name)}, {route}" for route in routes]
            if routes:
                first, *others = [(name, compiled(name), route) for route in routes]
                waiting += others
                if wrong := studio.wrong(*first, same_code):
                    return {"verdict": "caught", "by": wrong}
        for each in waiting:
            if wrong := studio.wrong(*each, same_code):
                return {"verdict": "caught", "by": wrong}
        if not different:
            return {"verdict": "same"}
        return {"verdict": "survived" if studio.drawn else "same code", "different": different}


def _named(text: str) -> Name:
    path, pass_ = text.rsplit(": ", 1)
    return path, pass_


def _different(name: Name, asked: Question) -> Iterator[str]:
    """The routes on which a material comes to something else than without the mutant."""
    assert asked.known is not None
    told = asked.path.startswith(IN_RUNTIME)
    found = dict(_behaviour(name, told=told))
    for route in DRAWN:
        keys = [f"{label(name)}, {route}: {what}" for what in ("text", "told")[: 1 + told]]
        differs = any(found.get(key) != asked.known.get(key) for key in keys)
        if differs or (asked.everything and keys[0] in found):
            yield route


class _Studio(ExitStack):
    """Compilers and drivers, which are started when something is to be drawn."""

    drawn = 0
    """How many pictures were drawn."""

    @cached_property
    def _toolchain(self) -> Toolchain:
        from burnish.targets.toolchain import Toolchain

        return self.enter_context(Toolchain())

    @cached_property
    def _runner(self) -> Runner:
        from burnish.targets.runner.routes import ROUTES
        from burnish.targets.runner.runner import Runner

        return self.enter_context(Runner([ROUTES[name] for name in DRAWN]))

    def code(self, material: CompiledMaterial, route: str) -> object:
        """What compilers make of a material's texts, without the names in it."""
        from burnish.targets.runner.codes import compile_one
        from burnish.targets.runner.routes import ROUTES

        codes = compile_one(ROUTES[route], material.files, self._toolchain)
        stages = codes.stages.values()
        return [(code.entry, _plain(code.text), _nameless(code.spirv)) for code in stages]

    def wrong(
        self, name: Name, material: CompiledMaterial, route: str, known: Mapping[str, str]
    ) -> str:
        """How a picture of a material is wrong; empty if it is right, or not drawn because its code
        is known, or because there are enough pictures already."""
        from burnish.targets.conformance import cases
        from burnish.targets.conformance.conform import conform
        from burnish.targets.runner.codes import CodeError
        from burnish.targets.runner.routes import ROUTES

        if self.drawn >= PICTURES:
            return ""
        place, row = f"{label(name)}, {route}", ROUTES[route]
        if row.profile in material.lacking:
            return f"{place}: {material.lacking[row.profile]}"
        try:
            code = self.code(material, route)
        except CodeError:
            return f"{place}: failed"
        if known.get(f"{place}: code") == _digest((code, material.reflection)):
            return ""
        self.drawn += 1
        whole = cases.SIZE
        for size in (SMALL, whole)[: 1 + (self.drawn <= LARGE_PICTURES)]:
            cases.SIZE = size
            subjects = [(place, material)]
            (found,) = conform(subjects, [row], self._runner, self._toolchain)
            cases.SIZE = whole
            if found.status in NOTICED:
                return f"{place}: {found.status}"
        return ""


def _plain(text: str) -> str:
    """A text without comments, and without the white space that only arranges it."""
    text = re.sub(r"//[^\n]*", "", text)
    return re.sub(r"\s*([^\w\s])\s*", r"\1", text)


NAMES = {3, 4, 5, 6, 7, 8, 317, 330}
"""The instructions of SPIR-V that only name things: sources, names, lines, and modules."""


def _nameless(module: bytes) -> str:
    """A module of SPIR-V without the instructions that only name things."""
    words = [word for (word,) in struct.iter_unpack("<I", module)]
    kept, at = words[:5], 5
    while at < len(words):
        length = max(1, words[at] >> 16)
        if words[at] & 0xFFFF not in NAMES:
            kept += words[at : at + length]
        at += length
    return repr(kept)


# --- which lines are reached ----------------------------------------------------------------------


def _reached(folders: Sequence[str], *, drawn: bool) -> dict[str, list[str]]:
    """For each line of the package, as ``path:line``, the materials that run it. A line that runs
    when the package is imported has the material ``""``."""
    trace = _Trace()
    sys.settrace(trace.entered)
    _drawing_modules()
    sys.settrace(None)
    found = {line: [""] for line in trace.lines}
    for name in names(folders):
        for line in _in_child(partial(_lines_of, name, drawn=drawn), PATIENCE)["lines"]:
            found.setdefault(line, []).append(": ".join(name))
    return found


def _lines_of(name: Name, *, drawn: bool) -> Answer:
    """The lines that are run to compile a material, and if it is ``drawn`` also all lines of the
    functions that are called for a picture of it: to look at every line would take too long."""
    trace = _Trace()
    sys.settrace(trace.entered)
    list(_behaviour(name, told=True))
    sys.settrace(None)
    if drawn:
        threading.setprofile(trace.called)
        with _Studio() as studio:
            studio.wrong(name, compiled(name), DRAWN[0], {})
        threading.setprofile(None)
    return {"lines": sorted(trace.lines)}


class _Trace:
    """Collects the lines of the package that run."""

    def __init__(self) -> None:
        import burnish

        self._root = str(Path(burnish.__file__).parent) + "/"
        self._codes: set[CodeType] = set()
        self.lines: set[str] = set()

    def entered(self, frame: FrameType, _event: str, _argument: object) -> Any:
        path = frame.f_code.co_filename
        if not path.startswith(self._root):
            return None
        name = path.removeprefix(self._root)
        self.lines.add(f"{name}:{frame.f_lineno}")

        def ran(frame: FrameType, _event: str, _argument: object) -> Any:
            self.lines.add(f"{name}:{frame.f_lineno}")
            return ran

        return ran

    def called(self, frame: FrameType, event: str, _argument: object) -> None:
        """Collect all lines of a function."""
        path = frame.f_code.co_filename
        if event == "call" and frame.f_code not in self._codes and path.startswith(self._root):
            self._codes.add(frame.f_code)
            name = path.removeprefix(self._root)
            lines = {line for _start, _end, line in frame.f_code.co_lines()}
            self.lines |= {f"{name}:{line}" for line in lines}


if __name__ == "__main__":
    main(sys.argv[1:])
