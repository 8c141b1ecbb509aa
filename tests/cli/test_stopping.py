"""Signals that ask a command to end: where they end it at once, and where later."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest

from burnish.commands import stopping
from burnish.commands.stopping import NAMES, Stopping

SIGNALS = [number for name in NAMES if (number := getattr(signal, name, None)) is not None]


@pytest.fixture(autouse=True)
def handlers(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Puts back the handlers of signals, and lets the process forget that one has come."""
    monkeypatch.setattr(stopping, "remember_signal", lambda _number: None)
    before = {number: signal.signal(number, signal.default_int_handler) for number in SIGNALS}
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("number", SIGNALS)
def test_at_once(number: signal.Signals) -> None:
    steps = []
    with pytest.raises(KeyboardInterrupt), Stopping() as stops:
        steps.append(stops.asked)
        signal.raise_signal(number)
        steps.append(False)
    assert (steps, stops.asked) == ([False], True)


def test_later() -> None:
    """The block goes on, and so does the whole one behind it: the end of that is the end."""
    steps = []
    with pytest.raises(KeyboardInterrupt), Stopping() as stops:
        with stops.later():
            signal.raise_signal(signal.SIGINT)
            steps.append("in the block")
        signal.raise_signal(signal.SIGINT)
        steps.append("behind it")
    assert steps == ["in the block", "behind it"]


def test_blocks_nest() -> None:
    """Behind the inner block, a signal does again what it does in the outer one."""
    steps: list[str] = []
    with pytest.raises(KeyboardInterrupt), Stopping() as stops:
        with stops.later():
            with stops.at_once(), stops.by(lambda: steps.append("act")):
                steps.append("inner")
            signal.raise_signal(signal.SIGINT)
            steps.append("outer")
        steps.append("whole")
    assert steps == ["inner", "outer", "whole"]


def test_what_a_signal_calls() -> None:
    """The function is called once, and the block that it is within goes on to its end."""
    steps: list[str] = []
    with pytest.raises(KeyboardInterrupt), Stopping() as stops:
        with stops.by(lambda: steps.append("act")):
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
            steps.append("inner")
        steps.append("whole")
    assert steps == ["act", "inner", "whole"]


def test_a_signal_that_has_come_before() -> None:
    """No long work begins any more."""
    steps: list[str] = []
    with pytest.raises(KeyboardInterrupt), Stopping() as stops, stops.later():
        signal.raise_signal(signal.SIGINT)
        with stops.at_once():
            steps.append("begun")
    assert not steps


@pytest.mark.parametrize("kind", [ValueError, SystemExit])
def test_a_library_that_raises_another_exception(kind: type[BaseException]) -> None:
    with pytest.raises(KeyboardInterrupt), Stopping() as stops, stops.at_once():
        try:
            signal.raise_signal(signal.SIGINT)
        except KeyboardInterrupt:
            raise kind from None


def test_no_signal() -> None:
    """Errors are told as they are, and the handlers are as before."""
    with pytest.raises(ValueError, match="own"), Stopping() as stops, stops.at_once():
        raise ValueError("own")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
