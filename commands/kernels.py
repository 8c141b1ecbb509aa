"""The kernels of a file that ``burnish render`` draws: they fill the buffers of materials."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from .console import remark
from .failures import fail

if TYPE_CHECKING:
    from ..api.entry_points import CompiledMaterial
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.kernel_results import Feeding, Kernel


def kernels_of(materials: Iterable[CompiledMaterial]) -> list[Kernel]:
    """The kernels over buffers among a file's declarations: each once, whatever the rigs are."""
    from ..targets.runner.kernel_results import Kernel
    from ..targets.runner.kernels import is_over_buffers

    found = {each.name: each for each in materials if is_over_buffers(each.reflection)}
    return [Kernel(material, material.instance()) for material in found.values()]


def feed(kernels: Sequence[Kernel], drawn: Sequence[Instance], again: Mapping[str, str]) -> Feeding:
    """The kernels that fill the buffers of everything that is drawn.

    The command ends if there are kernels only. Raises ``FeedError``.
    """
    from ..targets.runner.kernel_results import Feeding

    if kernels and not drawn:
        _tell_how_to_draw(kernels)
    feeding = Feeding(kernels, drawn, again)
    for instance in drawn:
        for name in feeding.unfed(instance):
            material = instance.reflection.material
            remark("note", (
                f"`{name}` of {material} has no elements: a kernel with `result {name} : …` in the "
                f"same file makes some, or --set {name}=FILE.json"
            ))  # fmt: skip
    return feeding


def _tell_how_to_draw(kernels: Sequence[Kernel]) -> None:
    kernel = kernels[0]
    name, row = next(iter(kernel.results.items()))
    fail(f"{kernel.name} is a kernel over buffers, which draws nothing\n"
         f"  = help: a material in the same file that reads `buffer {name} : {row.type}` is "
         f"drawn with what {kernel.name} writes")  # fmt: skip
