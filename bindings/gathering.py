"""Makes the binding of compiled materials: blocks that several share become one.

``burnish.bind`` calls ``gathered`` with the reflections of all materials of some files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..compiler.documents.plan import FramePlan
from ..compiler.documents.reflection import Reflection
from ..support.frozen import frozen
from .blocks import Blocks
from .frames.gathering import frame_of
from .helpers import Helpers
from .model import Binding, Block, Material
from .profiles import profiles_of
from .scheduling import Names
from .structures import Structures


@frozen(kw_only=True)
class Compiled:
    """A compiled material, of which a binding is made."""

    reflection: Reflection
    texts: Mapping[str, str]
    """The texts to embed by their files' names; empty if a host reads the files."""
    stem: str = ""
    """What the names of its files begin with; by default, its name in the binding."""


@frozen(kw_only=True)
class CompiledPlan:
    """The plan of a compiled frame."""

    plan: FramePlan
    shaders: tuple[int, ...]
    """Its shaders, by their numbers among all that was compiled."""


def gathered(
    compiled: Sequence[Compiled],
    frames: Sequence[CompiledPlan],
    sources: tuple[str, ...],
    namespace: str,
) -> Binding:
    """The binding of materials and frames."""
    helpers, structures = Helpers(), Structures()
    shared: dict[str, Block] = {}
    materials = []
    for each, name in zip(compiled, _names(compiled), strict=True):
        blocks = tuple(Blocks(name, each.reflection, structures, helpers, shared).all())
        profiles = profiles_of(each.reflection, blocks, each.texts, each.stem or name)
        materials.append(
            Material(
                name=name, reflection=each.reflection, blocks=blocks,
                buffers=structures.buffers(each.reflection), profiles=profiles,
            )
        )  # fmt: skip
    found = []
    for frame, name in zip(frames, _told_apart(frames), strict=True):
        shaders = [materials[number] for number in frame.shaders]
        found.append(frame_of(name, frame.plan, shaders, structures, helpers))
        shared |= {block.name: block for block in (found[-1].parameters, found[-1].numbers)}
    return Binding(
        sources=sources, namespace=namespace, enumerations=structures.enumerations,
        structures=structures.found, blocks=tuple(shared.values()), helpers=helpers.found,
        materials=tuple(materials), frames=tuple(found),
    )  # fmt: skip


def _names(compiled: Sequence[Compiled]) -> list[str]:
    """A name for each material; those that have one name are told apart by what differs."""
    passes: dict[str, set[object]] = {}
    rigs: dict[str, set[object]] = {}
    for each in compiled:
        passes.setdefault(each.reflection.material, set()).add(each.reflection.pass_)
        rigs.setdefault(each.reflection.material, set()).add(each.reflection.rig)
    found: dict[str, None] = {}
    for row in (each.reflection for each in compiled):
        parts = (
            row.pass_ if len(passes[row.material]) > 1 else None,
            row.rig if len(rigs[row.material]) > 1 else None,
        )
        wish = ".".join((row.material, *filter(None, parts)))
        wishes = (wish, *(f"{wish}.{number}" for number in range(2, len(found) + 3)))
        found[next(each for each in wishes if each not in found)] = None
    return list(found)


def _told_apart(frames: Iterable[CompiledPlan]) -> list[str]:
    """A name for each frame; those of several files that have one name get numbers."""
    names = Names(())
    return [names.new(each.plan.frame) for each in frames]
