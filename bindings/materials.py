"""The records of blocks and materials in a binding: what a host sets, computes and binds."""

from __future__ import annotations

from ..compiler.documents.backends import BackendRow
from ..compiler.documents.reflection import Reflection
from ..compiler.documents.steps import StepRow
from ..support.frozen import frozen
from .fields import Field, Numbers, Structure
from .statements import Statement


@frozen(kw_only=True)
class Block:
    """A uniform block, whose bytes a host fills."""

    structure: Structure
    plain_name: str
    """Name in the reflection of its material: ``View``, ``DerivedFromRig``."""
    group: str
    layout_id: str
    """The digest of its layout; empty where no text has it, and only derived values are of it."""
    derivation: Derivation | None = None
    """How its fields are computed; ``None`` where a host sets them."""
    steps: tuple[tuple[StepRow, ...], ...] = ()
    """The steps from which the derivation was made."""
    aliases: tuple[str, ...] = ()
    """Further names of it in the binding: those of other materials that share it."""
    about: str = ""
    """A sentence about a block of a frame; empty for those of materials."""

    @property
    def name(self) -> str:
        """Name in the binding."""
        return self.structure.name

    @property
    def roles(self) -> tuple[Field, ...]:
        """The fields that mean the same in all materials, such as the camera's.

        Those of a rig are not among them, as several of its lights have the same roles.
        """
        if self.derivation is not None or self.group == "rig":
            return ()
        return tuple([field for field in self.structure.fields if field.role is not None])

    @property
    def sources(self) -> tuple[Source, ...]:
        """The blocks from which it is computed; none where a host sets its fields."""
        return () if self.derivation is None else self.derivation.sources


@frozen(kw_only=True)
class Source:
    """A block that derived values read."""

    plain_name: str
    """Name in the reflection, by which the code calls it."""
    name: str
    """Name in the binding."""


@frozen(kw_only=True)
class Derivation:
    """Straight-line code that computes the fields of a block from those of others."""

    sources: tuple[Source, ...]
    """The blocks that are read."""
    statements: tuple[Statement, ...]


@frozen(kw_only=True)
class Helper:
    """A function of Burnish that no language has, with what it computes."""

    name: str
    parameters: tuple[str, ...]
    kinds: tuple[str, ...]
    """The kinds of the parameters: ``float`` or ``int``."""
    result: str
    """The kind of the result."""
    statements: tuple[Statement, ...]


@frozen(kw_only=True)
class Bound:
    """Something that a host binds, and where, for one profile."""

    name: str
    """Name in the binding of a block, or the name of a texture or a buffer."""
    kind: str
    """``uniform``, ``storage``, ``texture``, ``sampler``, ``image`` or ``result``.

    In Vulkan, ``combined`` is a texture with its sampler in one object, and ``push-constants`` is a
    block that lies in no buffer and has neither group nor binding.
    """
    group: int | None
    binding: int | None
    register: str | None
    identifier: str
    """Name in the text; empty for what no text has."""
    stages: tuple[str, ...]
    """The stages that read it; of a shared group, all that see it."""
    size: int = 0
    """Bytes of a block."""
    type: str = ""
    """WebGPU's word for the type of the binding, where there are groups: ``read-only-storage``."""
    is_shared: bool = False
    """True in a group that materials share: its layout is that of all, and names no sizes."""
    is_read: bool = True
    """False for what is there only since all materials of a project have one layout.

    The binding may have no type for such a block. A host binds whatever fits.
    """

    @property
    def is_block(self) -> bool:
        """True if it is a block that has a type in the binding."""
        return self.kind in ("uniform", "push-constants") and self.is_read


@frozen(kw_only=True)
class Buffer:
    """What lies in a storage buffer, one element behind the other."""

    name: str
    type: Numbers | Structure
    stride: int
    """Bytes from one element to the next."""
    count: str
    """The parameter with the number of elements; empty where a kernel writes them."""
    doc: str


@frozen(kw_only=True)
class Text:
    """One text of a profile."""

    stage: str
    file: str
    entry_point: str
    text: str | None
    """The text itself, if it is embedded."""
    module: str
    """The name of the file with the stage's module, without its end: ``Plastic.vert``.

    ``burnish compile --emit spirv`` writes it to ``Plastic.vert.spv``.
    """


@frozen(kw_only=True)
class Profile:
    """What the texts of one profile ask of a host."""

    name: str
    """Such as ``wgsl:webgpu``."""
    row: BackendRow
    binding_id: str
    """A digest of what a host binds and feeds, by which a stale binding is found out."""
    bound: tuple[Bound, ...]
    texts: tuple[Text, ...]


@frozen(kw_only=True)
class Material:
    """A material or a kernel."""

    name: str
    """Name in the binding, which no other material has."""
    reflection: Reflection
    blocks: tuple[Block, ...]
    """Its blocks, and those of which only derived values are."""
    buffers: tuple[Buffer, ...]
    """Its storage buffers: those that it reads, then those that it writes."""
    profiles: tuple[Profile, ...]

    def block(self, plain_name: str) -> Block:
        """The block that has this name in the reflection."""
        return next(each for each in self.blocks if each.plain_name == plain_name)
