"""Makes the binding of compiled materials: blocks that several share become one.

``burnish.bind`` calls ``gathered`` with the reflections of all materials of some files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..compiler.documents.plan import FramePlan
from ..compiler.documents.reflection import Reflection
from ..support.frozen import frozen
from ..support.unique import Names
from .block_names import Owner, named
from .blocks import Blocks
from .frames.gathering import frame_of
from .helpers import Helpers
from .model import Binding, Material
from .profiles import profiles_of
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
    owners, buffers = [], []
    for each, name in zip(compiled, _names(compiled), strict=True):
        blocks = tuple(Blocks(each.reflection, structures, helpers).all())
        owners.append(Owner(name=name, reflection=each.reflection, blocks=blocks))
        buffers.append(structures.buffers(each.reflection))
    blocks_of, every = named(owners)
    materials = [
        Material(
            name=owner.name, reflection=owner.reflection, blocks=blocks, buffers=own,
            profiles=profiles_of(
                owner.reflection, blocks, each.texts, each.stem or owner.name
            ),
        )
        for each, owner, blocks, own in zip(compiled, owners, blocks_of, buffers, strict=True)
    ]  # fmt: skip
    found, of_frames = [], []
    for frame, name in zip(frames, _told_apart(frames), strict=True):
        shaders = [materials[number] for number in frame.shaders]
        found.append(frame_of(name, frame.plan, shaders, structures, helpers))
        of_frames += [found[-1].parameters, found[-1].numbers]
    return Binding(
        sources=sources, namespace=namespace, enumerations=structures.enumerations,
        structures=structures.found, blocks=(*every, *of_frames), helpers=helpers.found,
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
