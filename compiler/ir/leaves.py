"""The data of leaves, which are the values that come from outside a shader."""

from __future__ import annotations

from typing import ClassVar

from ...stdlib.builtins.facts import UNKNOWN, Fact
from ...support.frozen import frozen
from .meaning import Meaning
from .node import Op
from .stages import VERTICES, Domain
from .types import INT, RuntimeArray, Type

Number = float | int | bool

MOST_ELEMENTS = float(2**31 - 1)
"""Elements of a storage buffer: their numbers are of type ``int``."""
LARGEST_PLACE = 65535
"""The largest number of a group or a binding.

The number of them that a language has is a limit of its profiles.
"""


@frozen
class HostPlace:
    """A uniform block that the host owns, and where it binds it."""

    name: str
    group: int
    binding: int


@frozen(key=True)
class Leaf:
    """A value that comes from outside a shader: one of the classes below."""

    KIND: ClassVar[Op]
    """The operation of the nodes that read it."""

    name: str
    """The name by which a host sets it: ``power``, ``torch.axis``, ``lamps.count``."""
    type: Type
    group: str = ""
    """The group that it is bound with; empty for a vertex input."""
    owner: str = ""
    """The light or the pass that it belongs to, which its name begins with: ``torch``.

    Empty for what belongs to the material, and where a pass has a name to itself.
    """

    @property
    def short_name(self) -> str:
        """The name that its owner declares: ``axis``."""
        return self.name[len(self.owner) + 1 :] if self.owner else self.name


def behind(owner: str, name: str) -> str:
    """The name of a thing behind that of its owner, as hosts call it: ``torch.axis``."""
    return f"{owner}.{name}" if owner else name


@frozen(key=True)
class Parameter(Leaf):
    """A member of a group's uniform block.

    Struct-valued members carry a fact per struct member.
    """

    KIND = "parameter"

    fact: Fact = UNKNOWN
    member_facts: tuple[tuple[str, Fact], ...] = ()
    derived: bool = False
    """Computed on the host side from other parameters and kept in the group's derived block."""
    meaning: Meaning | None = None
    host: HostPlace | None = None
    """The host's own block that holds it, instead of the group's."""
    value: Number | tuple[Number, ...] | None = None
    """The only value that it may have, or the lanes of it, where lanes may differ.

    A compile that was told one has it (``--set tint=#b5651d``). A single number, or one in all
    lanes, needs none: its ``fact`` says it.
    """


@frozen(key=True)
class Texture(Leaf):
    """A texture and the state of the sampler that reads it."""

    KIND = "texture"

    default: str = "white"
    state: tuple[tuple[str, str], ...] = ()
    """The sampler's state as sorted (key, value) pairs: ``filter`` linear/nearest, ``wrap`` …"""
    meaning: Meaning | None = None
    """The meaning of its texels, if it is declared."""


@frozen(key=True)
class Buffer(Leaf):
    """A storage buffer: any number of elements of one type, which the host binds."""

    KIND = "buffer"

    type: RuntimeArray
    fact: Fact = UNKNOWN
    """A fact that holds of each element."""
    member_facts: tuple[tuple[str, Fact], ...] = ()
    meaning: Meaning | None = None

    @property
    def count(self) -> Parameter:
        """The parameter that says how many elements there are; the runtime sets it."""
        fact = Fact(0.0, MOST_ELEMENTS, kind="int")
        return Parameter(f"{self.name}.count", INT, self.group, self.owner, fact)


@frozen(key=True)
class Argument(Leaf):
    """An argument of a function that an engine calls: a value that whoever calls it has.

    The passes make arguments of parameters, vertex inputs, varyings and the pipeline's values, once
    the guards are decided (``stage_functions``). Each has a name of its own, also beside textures.
    """

    KIND = "argument"

    fact: Fact = UNKNOWN
    member_facts: tuple[tuple[str, Fact], ...] = ()


@frozen(key=True)
class Attribute(Leaf):
    """A vertex input: a number or vector, or a matrix's column (``bend.0``)."""

    KIND = "attribute"

    step: Domain = VERTICES
    """The domain over which it varies: ``VERTICES`` or ``INSTANCES``."""
    meaning: Meaning | None = None
