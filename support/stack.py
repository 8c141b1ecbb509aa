"""Makes room on the stack for the frames of Python's functions.

CPython keeps these frames in chunks of 16 kB. If a function that is called very often is just the
one that needs another chunk, each call asks the operating system for memory, and each return gives
it back: that takes several times as long as a short function does. Whether it happens depends on
how deep calls nest, so one program could take twice as long as another that hardly differs.
"""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any, ParamSpec, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

_WORDS = 70_000
"""The number of values that the large frame could hold. CPython makes a chunk of 1 MB for it; the
other half of the chunk is left for calls, some thousands deep. The system only provides memory that
is written to."""


def with_room(
    work: Callable[Arguments, Result], *arguments: Arguments.args, **named: Arguments.kwargs
) -> Result:
    """Call ``work`` with so much room that its own calls need no other chunk."""
    found: Result = _in_large_frame(work, arguments, named)
    return found


def _called(work: Callable[..., Any], arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    return work(*arguments, **named)


_in_large_frame = FunctionType(_called.__code__.replace(co_stacksize=_WORDS), {}, "called")
