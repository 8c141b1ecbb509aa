"""Functions that Dask carries to workers, which may have no Burnish.

Dask sends functions by their names, and whoever cannot import a name fails in the middle of Dask.
Functions and classes that are made within functions are sent as their code instead. So these here
reach every worker and the scheduler, and import Burnish where they run: who lacks it, says so.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def asking_ability() -> Callable[[bytes], Any]:
    """A function by which a worker says what it is; it works in a thread, as Dask must go on."""

    async def ask(routes: bytes) -> bytes:
        import asyncio

        from burnish.commands.farming import worker

        return await asyncio.to_thread(worker.ability, routes)

    return ask


def working() -> Callable[[str, str, bytes], bytes]:
    """The function of all tasks: a worker does a work by its name, for a run."""

    def work(name: str, key: str, packed: bytes) -> bytes:
        from burnish.commands.farming import worker

        return worker.WORKS[name](key, packed)

    return work


def plugin(key: str, packed: bytes) -> Any:
    """The plugin by which all workers take part in a run, also those that come later.

    Those that fit get a resource that is called as the run, and the tasks want this resource.
    """
    from distributed import WorkerPlugin

    class Taking(WorkerPlugin):  # type: ignore[misc, unused-ignore]
        async def setup(self, worker: Any) -> None:
            import asyncio

            try:
                from burnish.commands.farming.worker import begin
            except ImportError:
                return
            threads = worker.state.nthreads
            if await asyncio.to_thread(begin, key, packed, threads):
                await worker.set_resources(**{key: threads})

        async def teardown(self, worker: Any) -> None:
            import asyncio

            try:
                from burnish.commands.farming.worker import end
            except ImportError:
                return
            await worker.set_resources(**{key: 0})
            await asyncio.to_thread(end, key)

    return Taking()
