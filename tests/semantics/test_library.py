"""The standard library's results that are read once, for all compiles."""

from __future__ import annotations

import time
from threading import Barrier

from burnish.compiler.library import once

from ..suite.processes import LIMIT, at_once


def test_threads_that_ask_at_the_same_time_get_the_same() -> None:
    together = Barrier(8)

    @once
    def made() -> object:
        time.sleep(0.05)
        return object()

    def ask() -> object:
        together.wait(timeout=LIMIT)
        return made()

    found = at_once([ask] * 8)
    assert all(one is found[0] for one in found)
