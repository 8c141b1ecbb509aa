"""Draws with the reference in processes of their own.

Python evaluates in one thread at a time. ``burnish conform`` of many materials therefore lends the
pictures that it expects to as many processes as there are processors. A process that ends for any
reason costs only time: the caller draws its picture.
"""

from __future__ import annotations

import pickle

from ...compiler.budget import BudgetError, current, raised
from ...compiler.ir.node import Graph
from ...compiler.ir.shader import Notes, Shader
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, RasterRules
from ...support.frozen import changed
from ..closing import Closing
from ..toolchain.limits import WORKERS
from ..toolchain.pipe import Packet, serve
from ..toolchain.surroundings import python_worker
from ..toolchain.workers import Pool, Worker
from .drivers.device import DriverError
from .reference import dumped, expected, loaded
from .scene_state import SceneState

TIME_LIMIT = 600.0
"""The seconds after which a process is given up."""


class References(Closing):
    """A few processes that draw; several threads may ask them at once."""

    def __init__(self, size: int) -> None:
        """``size`` is the number of processes; without any, the caller draws everything."""
        self._size = size
        self._closed = False
        self._pool = Pool(size, lambda: Worker(lambda: python_worker(__name__), WORKERS))

    def close(self) -> None:
        self._closed = True
        self._pool.close()

    def expected(
        self, shader: Shader, state: SceneState, rules: RasterRules, errors: Errors | None = None
    ) -> Expected:
        """Draw like ``reference.expected``: the same result, and the same errors.

        Raises ``DriverError`` if the processes were closed meanwhile.
        """
        question = self._size and _question(shader, state, rules, errors)
        if question:
            with self._pool.borrow() as worker:
                answer = worker.ask({}, TIME_LIMIT, question)
            if answer.data:
                return loaded(answer.data)
            if "refused" in answer.reply:
                raise BudgetError(answer.reply["refused"])
            if "lacks_memory" in answer.reply:
                raise MemoryError
        if self._closed:
            raise DriverError("the run has ended")
        return expected(shader, state, rules, errors)


def _question(
    shader: Shader, state: SceneState, rules: RasterRules, errors: Errors | None
) -> bytes | None:
    """The data for a process; ``None`` if the graph is too deep to be sent."""
    # Results hold their nodes. The graph, in which passes look for equal nodes, stays here.
    bare = changed(shader, graph=Graph(), notes=Notes())
    try:
        whole = bare, state, rules, errors, current()
        return pickle.dumps(whole)
    except RecursionError:
        return None


def _answer(question: Packet) -> Packet:
    shader, state, rules, errors, limits = pickle.loads(question.data)
    try:
        with raised(limits):
            return Packet({}, dumped(expected(shader, state, rules, errors)))
    except BudgetError as error:
        return Packet({"refused": str(error)})
    except MemoryError as error:
        return Packet({"lacks_memory": str(error)})


if __name__ == "__main__":
    serve(_answer, 1.5 * TIME_LIMIT)
