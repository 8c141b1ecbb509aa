"""The data of leaves, which are the values that come from outside a shader."""

from __future__ import annotations

from ...stdlib.builtins.facts import UNKNOWN, Fact
from ...support.frozen import frozen
from .meaning import Meaning
from .stages import VERTICES, Domain
from .types import INT, RuntimeArray, Type

MOST_ELEMENTS = float(2**31 - 1)
"""Elements of a storage buffer: their numbers are of type ``int``."""


@frozen
class HostPlace:
    """A uniform block that the host owns, and where it binds it."""

    name: str
    group: int
    binding: int


@frozen(key=True)
class Parameter:
    """A member of a group's uniform block.

    ``name`` is how a host sets it (``power``, ``torch.axis``, ``lamps.count``). Struct-valued
    members carry a fact per struct member.
    """

    name: str
    type: Type
    group: str
    fact: Fact = UNKNOWN
    member_facts: tuple[tuple[str, Fact], ...] = ()
    derived: bool = False
    """Computed on the host side from other parameters and kept in the group's derived block."""
    meaning: Meaning | None = None
    host: HostPlace | None = None
    """The host's own block that holds it, instead of the group's."""


@frozen(key=True)
class Resource:
    """A texture and the state of the sampler that reads it."""

    name: str
    type: Type
    group: str
    default: str = "white"
    state: tuple[tuple[str, str], ...] = ()
    """The sampler's state as sorted (key, value) pairs: ``filter`` linear/nearest, ``wrap`` …"""


@frozen(key=True)
class Buffer:
    """A storage buffer: any number of elements of one type, which the host binds."""

    name: str
    type: RuntimeArray
    group: str
    fact: Fact = UNKNOWN
    """A fact that holds of each element."""
    member_facts: tuple[tuple[str, Fact], ...] = ()
    meaning: Meaning | None = None

    @property
    def count(self) -> Parameter:
        """The parameter that says how many elements there are; the runtime sets it."""
        fact = Fact(0.0, MOST_ELEMENTS, kind="int")
        return Parameter(f"{self.name}.count", INT, self.group, fact)


@frozen(key=True)
class Attribute:
    """A vertex input: a number or vector, or a matrix's column (``bend.0``)."""

    name: str
    type: Type
    step: Domain = VERTICES
    """The domain over which it varies: ``VERTICES`` or ``INSTANCES``."""
    meaning: Meaning | None = None
