"""Draws with the reference in processes of their own.

Python evaluates in one thread at a time. ``burnish conform`` of many materials therefore lends the
pictures that it expects to as many processes as there are processors. A process that ends for any
reason costs only time: the caller draws its picture.
"""

from __future__ import annotations

import base64
import faulthandler
import json
import os
import pickle
import sys

from ...compiler.budget import BudgetError, current, raised
from ...compiler.ir.node import Graph
from ...compiler.ir.shader import Notes, Shader
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, RasterRules
from ...support.frozen import changed
from ..closing import Closing
from ..toolchain.limits import WORKERS
from ..toolchain.surroundings import python_worker
from ..toolchain.workers import Pool, Worker
from .reference import dumped, expected, loaded
from .scene_state import SceneState

TIME_LIMIT = 600.0
"""The seconds after which a process is given up."""


class References(Closing):
    """A few processes that draw; several threads may ask them at once."""

    def __init__(self, size: int) -> None:
        """``size`` is the number of processes; without any, the caller draws everything."""
        self._size = size
        self._pool = Pool(size, lambda: Worker(lambda: python_worker(__name__), WORKERS))

    def close(self) -> None:
        self._pool.close()

    def expected(
        self, shader: Shader, state: SceneState, rules: RasterRules, errors: Errors | None = None
    ) -> Expected:
        """Draw like ``reference.expected``: the same result, and the same errors."""
        question = self._size and _question(shader, state, rules, errors)
        if question:
            with self._pool.borrow() as worker:
                answer = worker.ask({"question": question}, TIME_LIMIT)
            if "picture" in answer.reply:
                return loaded(base64.b64decode(answer.reply["picture"]))
            if "refused" in answer.reply:
                raise BudgetError(answer.reply["refused"])
            if "lacks_memory" in answer.reply:
                raise MemoryError
        return expected(shader, state, rules, errors)


def _question(
    shader: Shader, state: SceneState, rules: RasterRules, errors: Errors | None
) -> str | None:
    """The data for a process, encoded; ``None`` if the graph is too deep to be sent."""
    # Results hold their nodes. The graph, in which passes look for equal nodes, stays here.
    bare = changed(shader, graph=Graph(), notes=Notes())
    try:
        whole = bare, state, rules, errors, current()
        return base64.b64encode(pickle.dumps(whole)).decode("ascii")
    except RecursionError:
        return None


def _answer(question: str) -> dict[str, str]:
    shader, state, rules, errors, limits = pickle.loads(base64.b64decode(question))
    try:
        with raised(limits):
            picture = dumped(expected(shader, state, rules, errors))
    except BudgetError as error:
        return {"refused": str(error)}
    except MemoryError as error:
        return {"lacks_memory": str(error)}
    return {"picture": base64.b64encode(picture).decode("ascii")}


def main() -> None:
    """Answer questions until the input ends. Output of libraries goes to standard error."""
    with os.fdopen(os.dup(1), "w") as answers:
        os.dup2(2, 1)
        for line in sys.stdin:
            # The caller has given up earlier, unless its process has died.
            faulthandler.dump_traceback_later(1.5 * TIME_LIMIT, exit=True)
            answers.write(json.dumps(_answer(json.loads(line)["question"])) + "\n")
            answers.flush()
            faulthandler.cancel_dump_traceback_later()


if __name__ == "__main__":
    main()
