"""Recursion without the call stack.

Expressions nest as deeply as a text is long and equations chain without limit, so what follows
their structure is written as generators: ``yield sub()`` stands for a recursive call. ``run`` keeps
the pending ones on a list, whose length nothing limits.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Any, TypeVar

Result = TypeVar("Result")
Step = Generator[Any, Any, Result]
"""A suspended call that yields further calls and returns ``Result``."""


def run(call: Step[Result]) -> Result:
    """The result of ``call`` and of all the calls that it makes."""
    stack: list[Step[Any]] = [call]
    value: Any = None
    while stack:
        try:
            inner = stack[-1].send(value)
        except StopIteration as finished:
            stack.pop()
            value = finished.value
        else:
            stack.append(inner)
            value = None
    result: Result = value
    return result
