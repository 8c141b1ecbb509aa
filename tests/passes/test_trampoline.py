"""Recursion without the call stack: calls that are suspended, and answers that need none."""

from __future__ import annotations

from collections.abc import Callable

from burnish.compiler.trampoline import Reply, Step, run


def _depth(left: int) -> Reply[int]:
    """How many calls were made; the last one is answered at once."""
    return _deeper(left) if left else 0


def _deeper(left: int) -> Step[int]:
    inner: int = yield _depth(left - 1)
    return 1 + inner


def test_depth_has_no_limit() -> None:
    assert run(_depth(100_000)) == 100_000


def test_an_answer_is_as_good_as_a_call() -> None:
    assert run(_depth(0)) == 0


def test_answers_come_back_to_who_asked() -> None:
    def called(asked: Callable[[int], Reply[int]]) -> Step[tuple[int, int, int]]:
        first = yield asked(3)
        second = yield asked(0)
        third = yield asked(1)
        return first, second, third

    assert run(called(_depth)) == (3, 0, 1)
