"""The lines of the package that each material runs."""

from __future__ import annotations

import sys
import threading
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from .behaviour import DRAWN, Name, behaviour, compiled, names
from .children import Answer, in_child
from .studio import Studio


def import_drawing() -> None:
    """Import what compiles, draws and compares."""
    import_module("burnish.targets.conformance.conform")
    import_module("burnish.api.entry_points")


def reached(folders: Sequence[str], limit: float, *, drawn: bool) -> dict[str, list[str]]:
    """For each line of the package, as ``path:line``, the materials that run it. A line that runs
    when the package is imported has the material ``""``. Each may take ``limit`` seconds."""
    trace = _Trace()
    sys.settrace(trace.entered)
    import_drawing()
    sys.settrace(None)
    found = {line: [""] for line in trace.lines}
    for name in names(folders):
        for line in in_child(partial(_lines_of, name, drawn=drawn), limit)["lines"]:
            found.setdefault(line, []).append(": ".join(name))
    return found


def _lines_of(name: Name, *, drawn: bool) -> Answer:
    """The lines that are run to compile a material, and if it is ``drawn`` also all lines of the
    functions that are called for a picture of it: to look at every line would take too long."""
    trace = _Trace()
    sys.settrace(trace.entered)
    list(behaviour(name, told=True))
    sys.settrace(None)
    if drawn:
        threading.setprofile(trace.called)
        with Studio() as studio:
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
