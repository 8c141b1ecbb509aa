"""Values that a host sets and computes: parameters, storage buffers, lights, and their layout."""

from __future__ import annotations

from typing import Annotated, Literal

from ...support.frozen import frozen
from ..constraints import Count, Lanes, Range
from ..packing import LaneKind
from .steps import StepRow


@frozen(kw_only=True)
class LayoutRow:
    """The layout of lanes from the start of the value.

    A lane is 32 bits, little-endian; fields that do not apply to the type are absent.
    """

    stored: str
    """The stored type.

    Bools are uints, 2- and 3-row matrices have columns of four rows (``mat3x4``), and arrays are
    arrays of ``vec4``. For a table's member, it is the type of one element.
    """
    kind: LaneKind | None = None
    """Kind of the lanes; bools are uints 0 and 1. Absent for structs."""
    lanes: Annotated[int, Range(least=0, most=4)] | None = None
    """Lanes of a scalar or vector, or of one column of a matrix, 4 bytes apart."""
    columns: Annotated[int, Range(least=0, most=4)] | None = None
    """Columns of a matrix."""
    column_stride: Count | None = None
    """Bytes from one column of a matrix to the next."""
    count: Count | None = None
    """Elements of an array; everything else describes one element."""
    stride: Count | None = None
    """Bytes from one element of an array to the next."""


@frozen(kw_only=True)
class StructMember:
    """One member."""

    name: str
    """The member's name; padding is ``pad_N``."""
    type: str
    """Stored type."""
    offset: Count
    """Bytes from the start of the struct."""
    size: Count
    """Bytes."""


@frozen(kw_only=True)
class StructRow:
    """A struct in stored form."""

    name: str
    """The struct's name."""
    size: Annotated[int, Range(least=0, multiple_of=16)]
    """Bytes, a multiple of 16."""
    members: tuple[StructMember, ...]
    """Members in order, padding included."""


@frozen(kw_only=True)
class ChoiceRow:
    """A member of an enumeration."""

    name: str
    """The member's name: ``add`` of ``enum Mode { add, mix }``."""
    doc: str
    """Doc comment; empty where there is none."""


@frozen(kw_only=True)
class MemberRow:
    """A member of a struct, or of the elements of an array of structs."""

    name: str
    """The member's name."""
    type: str
    """The type as written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    range: tuple[float, float] | None
    """Lowest and highest value that a host may set; null where the declaration gives none."""
    choices: tuple[ChoiceRow, ...] | None = None
    """Members of the enumeration that it is, by their numbers, from 0; left out for others."""
    default: Lanes
    """Value before a host sets one; null where the declaration gives none."""
    doc: str
    """Doc comment; empty where there is none."""
    library: str | None
    """Declaration of the library that it is, ``std.skinning.Skinned.bones``; null for others."""
    offset: Count
    """Bytes from the start of the struct."""
    size: Count
    """Bytes of the stored value, padding inside it included."""
    layout: LayoutRow
    members: tuple[MemberRow, ...]
    """Members of a struct inside this one."""


@frozen(kw_only=True)
class ParameterRow:
    """A declared parameter."""

    name: str
    """Name as the host says it, ``lamps`` or ``torch.axis``."""
    type: str
    """The type as written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    range: tuple[float, float] | None
    """Lowest and highest value that a host may set; null where the declaration gives none."""
    choices: tuple[ChoiceRow, ...] | None = None
    """Members of the enumeration that it is, by their numbers, from 0; left out for others."""
    default: Lanes
    """Value before a host sets one; null where the declaration gives none."""
    doc: str
    """Doc comment; empty where there is none."""
    library: str | None
    """Declaration of the library that it is, ``std.skinning.Skinned.bones``; null for others."""
    declared_by: str | None = None
    """Declaration that declares it: the material, or a base, a mixin, the pass or a light.

    Left out where no record declares it.
    """
    role: str | None
    """Meaning for a program that shows scenes, such as ``world_to_clip`` of the camera.

    Null where it is the material's own affair.
    """
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    block: str | None
    """Block that holds it; null where the program reads nothing of that block."""
    offset: Count | None
    """Bytes from the start of the block; null without a block."""
    size: Count
    """Bytes of the stored value, padding inside it included."""
    layout: LayoutRow
    members: tuple[MemberRow, ...]
    """Members of a struct or of an array's elements; empty otherwise."""
    count: str | None
    """Parameter with the run-time number of elements in use; null where all are."""
    read: tuple[str, ...] | None = None
    """Parts that a stage reads, or a value that the host computes: ``lamps.place``.

    Empty where nothing reads any of it. Left out where all of it is read.
    """


@frozen(kw_only=True)
class DerivedRow:
    """A value that the host computes in double precision from stored parameters and rounds once.

    Where ``layout`` has a ``count``, there is one for each element of an array.
    """

    name: str
    """Name in its block.

    For a table's member, the table's name stands before it, ``lamps_derived.falloff_cos``.
    """
    representation: str
    """The type on the machine: ``float``, ``vec3``, ``Lamp[8]``."""
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    block: str | None
    """Block that holds it; null where the program reads nothing of that block."""
    offset: Count | None
    """Bytes from the start of the block; null without a block."""
    size: Count
    """Bytes of the stored value, padding inside it included."""
    layout: LayoutRow
    doc: str
    """Doc comment; empty where there is none."""
    role: str | None
    """Meaning for a program that shows scenes, such as ``normal_matrix``.

    Such a program may have the value already, and then needs no steps. Null where they are all that
    is known.
    """
    steps: tuple[StepRow, ...]
    """The computation, operands first; the last step is the value.

    Where ``layout`` has a ``count`` it is done for each element, whose number is the ``bound``
    outside of bodies.
    """


@frozen(kw_only=True)
class PromiseRow:
    """A vector that is not zero wherever a shader uses it."""

    value: str
    """The vector as a formula in Burnish."""
    least_length: float
    """The length that the vector has at least."""
    parameters: tuple[str, ...]
    """The parameters that it depends on."""


@frozen(kw_only=True)
class LightRow:
    """A light, or an array of lights, of the rig."""

    name: str
    """Name by which it is set: ``torch``, or ``Rig.torch`` where that name is taken."""
    entry: str
    """Name in the rig: ``torch``."""
    kind: str
    """The declaration of the light: ``Lantern``."""
    library: str | None
    """Declaration of the library that it is, ``std.lights.Lantern``; null for others."""
    doc: str
    """Doc comment of the rig's entry; empty where there is none."""
    capacity: Count | None
    """Largest number of lights of an array; null for a single light."""
    count: str | None
    """Parameter with the number of lights in use; null where it is fixed."""
    parameters: tuple[str, ...]
    """The array's parameter, or a single light's parameters, of whatever groups.

    Each has a row in ``parameters`` with its block and offset.
    """

    def member(self, parameter: str) -> str:
        """The light's own name of one of its parameters: ``axis`` of ``torch.axis``."""
        return parameter[len(self.name) + 1 :]


@frozen(kw_only=True)
class BufferRow:
    """A storage buffer, the same bytes on every backend."""

    name: str
    """Name as the host says it, ``lanterns`` or ``torch.bulbs``."""
    type: str
    """The type as written: ``Lantern[]``."""
    representation: str
    """The type on the machine: ``vec3[]``."""
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    count: str
    """The parameter that says how many elements there are.

    A buffer without elements is bound with one of zeros.
    """
    stride: Annotated[int, Range(least=4)]
    """Bytes from one element to the next."""
    layout: LayoutRow
    members: tuple[MemberRow, ...]
    """Members of an element that is a struct."""
    structs: tuple[StructRow, ...]
    """Stored structs that elements use, those inside others first."""
    stages: tuple[str, ...]
    """Stages that read it."""
    doc: str
    """Doc comment."""


@frozen(kw_only=True)
class ResultRow:
    """A storage buffer that a kernel writes.

    It writes each element once or, if it scatters to the buffer, as often as invocations choose the
    element. Padding is not written.
    """

    name: str
    """Name as the host says it, ``lanterns`` or ``torch.bulbs``."""
    type: str
    """The type as written: ``Lantern[]``."""
    representation: str
    """The type on the machine: ``vec3[]``."""
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    stride: Annotated[int, Range(least=4)]
    """Bytes from one element to the next."""
    layout: LayoutRow
    members: tuple[MemberRow, ...]
    """Members of an element that is a struct."""
    structs: tuple[StructRow, ...]
    """Stored structs that elements use, those inside others first."""
    doc: str
    """Doc comment."""
    count: tuple[StepRow, ...]
    """Steps that compute how many elements it has."""
    scattered: Literal["add", "min", "max", "and", "or", None]
    """Operator by which invocations join values with elements; null if each writes its own."""
    initial: int | None
    """Value of each element before the kernel runs, so that it then has the joined ones alone.

    Null if that does not matter.
    """


@frozen(kw_only=True)
class BlockMember:
    """One member."""

    name: str
    """Suggested identifier; each backend says its final name."""
    type: str
    """Stored type."""
    offset: Count
    """Bytes from the start of the block."""
    size: Count
    """Bytes."""
    parameter: str | None
    """Parameter that it holds; null for padding."""


@frozen(kw_only=True)
class BlockRow:
    """A uniform block, the same bytes on every backend."""

    name: str
    """Name by which other parts of this document refer to it."""
    group: str
    """Parameter group, which the host updates together.

    It is ``frame``, ``view``, ``rig``, ``material``, ``draw`` or a user's own.
    """
    derived: bool
    """True if the host computes its contents from other parameters."""
    extern: bool
    """True if the file says that the host owns it: names, offsets and binding are the host's."""
    size: Annotated[int, Range(least=0, multiple_of=16)]
    """Bytes, a multiple of 16."""
    stages: tuple[str, ...]
    """Stages that read it."""
    layout_id: str
    """A digest of the members, with their types and offsets, and of the structs.

    Of a derived block, it is also of the steps that compute its values. Blocks with one id have
    the same bytes for the same values, in whatever material.
    """
    members: tuple[BlockMember, ...]
    """Members in order, padding included; they leave no gap.

    A text does not write padding that all languages leave by themselves.
    """
    structs: tuple[StructRow, ...]
    """Stored structs that members use, those inside others first."""
