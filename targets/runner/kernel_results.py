"""Runs the kernels of a file, and gives their results to the shaders of the same file.

``burnish render`` uses it: a buffer has the elements of the result of the same name. The reference
runs the kernels, in the order in which they need each other, so that all routes draw the same
elements. For simulations, a step can be repeated: before it, some buffers get the results of the
step before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter

from ...compiler.documents.values import BufferRow, ResultRow
from .instances.instance import Instance
from .reference_kernels import elements_by_reference
from .subject import Subject

Progress = Callable[[float], None]
"""Called with the part of the work that is done, from 0 to 1."""


class FeedError(ValueError):
    """Kernels do not fit each other, or do not fit the readers of their results."""


@dataclass(frozen=True, slots=True)
class Kernel:
    """A kernel over buffers with the values of its parameters."""

    subject: Subject
    instance: Instance

    @property
    def name(self) -> str:
        """The declared name."""
        return self.subject.name

    @property
    def results(self) -> Mapping[str, ResultRow]:
        """The reflection's rows of the kernel's results, by name."""
        return {row.name: row for row in self.subject.reflection.results}


class Feeding:
    """The kernels that some instances need, and the results of these kernels."""

    def __init__(
        self, kernels: Sequence[Kernel], drawn: Sequence[Instance], again: Mapping[str, str]
    ) -> None:
        """``again`` says, of buffers that change from step to step, which results they become.

        Raises ``FeedError`` where two kernels write a result of one name, where types differ,
        where kernels wait for each other, and for unknown names in ``again``.
        """
        self._writers = _writers(kernels)
        self._again = again
        self._drawn = drawn
        self._elements: dict[str, bytes] = {}
        wanted = [name for each in drawn for name in self._reads(each)]
        self._order = self._ordered([*wanted, *again.values()])
        self._check_again()

    @property
    def kernels(self) -> Sequence[Kernel]:
        """The kernels that are run, in this order."""
        return self._order

    def unfed(self, instance: Instance) -> list[str]:
        """The buffers of an instance that have no elements, and get none."""
        rows = instance.reflection.buffers
        contents = instance.buffers()
        return [
            row.name
            for row in rows
            if row.stages and row.name not in self._writers and not contents[row.name].count
        ]

    def run(self, steps: int, tell: Progress) -> None:
        """Run all kernels, and again those that a step changes; then set the subjects' buffers.

        Raises ``MissingValuesError``.
        """
        repeated = self._repeated()
        for step in range(steps):
            if step:
                self._elements |= {to: self._elements[of] for to, of in self._again.items()}
            for kernel in repeated if step else self._order:
                self._give(kernel.instance)
                written = elements_by_reference(kernel.subject.shader, kernel.instance)
                self._elements |= {name: contents.data for name, contents in written.items()}
            tell((step + 1) / steps)
        for instance in self._drawn:
            self._give(instance)

    def _give(self, instance: Instance) -> None:
        for name in self._reads(instance):
            instance.set_bytes(name, self._elements[name])

    def _reads(self, instance: Instance) -> Iterator[str]:
        """The buffers of an instance that kernels write."""
        for row in instance.reflection.buffers:
            found = self._writers.get(row.name)
            if found is not None:
                self._check_type(instance, row, found)
                yield row.name

    def _check_type(self, reader: Instance, row: BufferRow, writer: Kernel) -> None:
        written = writer.results[row.name]
        if _stored(row) != _stored(written):
            raise FeedError(
                f"`{row.name}` of {reader.reflection.material} is {row.type}, and "
                f"{writer.name} writes {written.type}"
            )

    def _ordered(self, wanted: Sequence[str]) -> list[Kernel]:
        """The kernels that write these results, and those that they need, in order of execution."""
        sorter: TopologicalSorter[str] = TopologicalSorter()
        by_name: dict[str, Kernel] = {}
        waiting = [self._writers[name] for name in wanted if name in self._writers]
        while waiting:
            kernel = waiting.pop()
            if kernel.name not in by_name:
                by_name[kernel.name] = kernel
                needed = [self._writers[name] for name in self._reads(kernel.instance)]
                sorter.add(kernel.name, *(each.name for each in needed))
                waiting += needed
        try:
            return [by_name[name] for name in sorter.static_order()]
        except CycleError as error:
            circle = " → ".join(error.args[1])
            raise FeedError(f"kernels wait for each other's results: {circle}") from None

    def _repeated(self) -> list[Kernel]:
        """The kernels whose results change in a later step.

        They read something that changes, and do not write how it begins.
        """
        changing = set(self._again)
        found = []
        for kernel in self._order:
            if set(kernel.results).isdisjoint(self._again) and not changing.isdisjoint(
                self._reads(kernel.instance)
            ):
                changing.update(kernel.results)
                found.append(kernel)
        return found

    def _check_again(self) -> None:
        for buffer, result in self._again.items():
            for name in (buffer, result):
                if name not in self._writers:
                    known = ", ".join(f"`{known}`" for known in self._writers) or "none"
                    raise FeedError(f"no kernel writes `{name}`; there are {known}")
            source, target = (self._writers[name].results[name] for name in (result, buffer))
            if _stored(source) != _stored(target):
                raise FeedError(
                    f"`{buffer}` is {target.type}, and cannot become `{result}`, which is "
                    f"{source.type}"
                )


def _stored(row: BufferRow | ResultRow) -> object:
    """The memory layout of a buffer's elements; structures are compared by their members only."""
    members = [struct.members for struct in row.structs]
    return row.stride, members or row.layout


def _writers(kernels: Sequence[Kernel]) -> dict[str, Kernel]:
    """The kernel that writes each result, by the result's name."""
    found: dict[str, Kernel] = {}
    for kernel in kernels:
        for name in kernel.results:
            if name in found:
                raise FeedError(f"{found[name].name} and {kernel.name} both write `{name}`")
            found[name] = kernel
    return found
