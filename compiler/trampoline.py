"""Recursion without the call stack, for what follows the structure of a graph or a program.

Programs nest as deep as their authors like: branches within branches (``passes/schedule.py``),
arrays of structures of arrays (``passes/replace_aggregates.py``). There ``yield sub()`` stands for
a recursive call, and ``run`` keeps the pending ones on a list, whose length nothing limits. What
can be answered without a further call need not be a generator: ``yield answer`` is as good, and
cheaper.
"""

from __future__ import annotations

from collections.abc import Generator
from types import GeneratorType
from typing import Any, TypeAlias, TypeVar, overload

Result = TypeVar("Result")
Step = Generator[Any, Any, Result]
"""A suspended call that yields further calls and returns ``Result``."""
Reply: TypeAlias = Step[Result] | Result
"""A call, or what it returns where that is known at once."""


@overload
def run(call: Step[Result]) -> Result: ...
@overload
def run(call: Result) -> Result: ...
def run(call: Any) -> Any:
    """The result of ``call`` and of all the calls that it makes."""
    value: Any = call
    current: Any = None
    waiting: list[Any] = []
    while True:
        if isinstance(value, GeneratorType):
            waiting.append(current)
            current, value = value, None
        elif current is None:
            break
        try:
            value = current.send(value)
        except StopIteration as finished:
            value = finished.value
            current = waiting.pop()
    return value
