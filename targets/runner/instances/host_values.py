"""Named values that a host sets: of one compiled material, or of a frame.

``Instance`` has those of a material, and ``FrameHost`` those of a frame. Nothing here imports
NumPy.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence, Sized
from copy import copy
from typing import TYPE_CHECKING, Any, Self

from ....compiler.documents.steps import ParameterStep, StepRow, TextureStep
from ....support.arguments import expect
from ....support.frozen import EMPTY
from . import derived
from .buffers import packed
from .contents import Contents, empty, layout_of
from .declared import Declared, TextureDeclaration
from .names import Names
from .parts import Part, Rig
from .shapes import Elements, Numbers
from .texts import elements_in_file, parse
from .values import ParameterError, changed, filled, initial, plain, unset

if TYPE_CHECKING:
    from ....compiler.budget import Tally
    from ..textures.texture import Texture


class MissingValuesError(ValueError):
    """Parameters that a shader reads, and that have neither a value nor a default."""

    def __init__(self, material: str, missing: Mapping[str, Numbers | Elements]) -> None:
        rows = [
            f"`{name}` : {shape.type}" + (f"   {shape.doc}" if shape.doc else "")
            for name, shape in missing.items()
        ]
        super().__init__("\n  ".join([f"{material} needs values for", *rows]))
        self.names = tuple(missing)


class HostValues:
    """Named values of a material, or of a frame.

    Names are those of the reflection: ``power``, ``torch.axis``, ``lamps[2].place``. The first
    values are the declared defaults. Colours are linear, or literals such as ``"#b5651d"``; angles
    are radians, or texts such as ``"30deg"``; a matrix is a sequence of its columns. The length of
    a ``direction`` may differ from one by a thousandth, and is then set to one.

    Parameters and their parts are also attributes: ``instance.torch.axis = (0, -1, 0)``.
    """

    def __init__(self, declared: Declared, meter: Tally | None = None) -> None:
        """``meter`` counts the steps of all computed values, if they are limited together."""
        self._declared = declared
        self._meter = meter
        self._names = Names(declared)
        self._values = {name: initial(shape) for name, shape in self._names.shapes.items()}
        self._textures: dict[str, Texture] = {}
        self._sized: dict[str, derived.OfSize] = {}
        layouts = map(layout_of, declared.buffers)
        self._buffers = {layout.name: empty(layout) for layout in layouts}

    @property
    def declared(self) -> Declared:
        """Everything that has a value."""
        return self._declared

    @property
    def rig(self) -> Rig:
        """The lights, and all other values per rig: ``instance.rig.torch.axis = (0, -1, 0)``."""
        return Rig(self, self._names.rig)

    def set(self, name: str, value: object) -> None:
        """Set a parameter, a part of one, a light, a texture or a storage buffer.

        A light takes a mapping of its parameters, and an array of lights a list of mappings. If the
        lights are counted at run time, the list also sets the count. Members that a mapping does
        not name keep their values.

        A buffer takes a list of elements, each like the value of a parameter, or a NumPy array: of
        numbers, or with a field for each member of a structure. It also sets the buffer's count.

        Raises ``ParameterError`` if there is no such parameter, or if it cannot have the value;
        then nothing changes.
        """
        _check_name(name)
        if name in self._names.textures:
            self._textures[name] = _texture(self._names.textures[name], value)
        elif name in self._buffers:
            self._set_buffer(packed(self._buffers[name].layout, value))
        else:
            self._values |= self._changes(name, value)

    def set_bytes(self, name: str, data: bytes) -> None:
        """Set a storage buffer to elements in a GPU's form, such as a kernel's results.

        Raises ``ParameterError`` if there is no such buffer, or for a part of an element.
        """
        _check_name(name)
        if name not in self._buffers:
            raise ParameterError(name, f"there is no storage buffer `{name}`")
        layout = self._buffers[name].layout
        count, rest = divmod(len(data), layout.stride)
        if rest:
            raise ParameterError(
                name, f"`{name}` takes elements of {layout.stride} bytes each, and was given "
                f"{len(data)} bytes"
            )  # fmt: skip
        self._set_buffer(Contents(layout, count, data))

    def bind_own(self, name: str, size: tuple[int, ...]) -> None:
        """Set the size of a texture that the host binds itself: one that it has drawn.

        Raises ``ParameterError`` if there is no such texture.
        """
        if name not in self._names.textures:
            raise ParameterError(name, f"there is no texture `{name}`")
        self._sized[name] = derived.OfSize(*size)

    def take(self, name: str, other: HostValues, source: str) -> None:
        """Take over the whole value of a parameter of this type from another instance.

        Parts that nobody has set are among it.
        """
        self._values[name] = other._values[source]

    def evaluated(self, steps: Sequence[StepRow]) -> Any:
        """The value that steps compute from parameters and sizes of textures, as ``set`` takes it.

        Raises ``MissingValuesError``.
        """
        found = derived.compute(steps, self._read_by(steps, self._sizes(steps)))
        if steps[-1].type.endswith("]"):
            return tuple(map(_without_lane, found))
        return _without_lane(found)

    def having(self, name: str, value: object) -> Self:
        """A copy that differs in one value. Raises ``ParameterError``, as ``set`` does."""
        made = self.copied()
        made.set(name, value)
        return made

    def copied(self) -> Self:
        """An instance with the same values, which can be changed by itself."""
        made = copy(self)
        made._values = dict(self._values)
        made._textures = dict(self._textures)
        made._sized = dict(self._sized)
        made._buffers = dict(self._buffers)
        return made

    def set_text(self, name: str, text: str) -> None:
        """Set a parameter or texture from a text, as on a command line.

        ``texts`` explains how values are written. A texture is a colour such as ``#b5651d``, or the
        file of a picture, whose colours are taken as sRGB if the texture's intent is ``color``, or
        if its name begins with ``srgb:``, and not if it begins with ``linear:``.
        Layers, slices or faces are files separated by commas. A storage buffer is a JSON file with
        a list of elements.

        Raises ``ParameterError`` as ``set`` does, also for a file that is no such list,
        ``PictureError`` for a picture that cannot be read, and ``FileError`` and ``BudgetError``
        for another file that cannot be read, or is too large.
        """
        _check_name(name)
        expect("text", text, str, "a text")
        if name in self._names.textures:
            from ..textures.texture import Texture

            row = self._names.textures[name]
            self._textures[name] = Texture.parse(
                text, dimension=row.dimension, sample=row.sample, intent=row.intent
            )
        elif name in self._buffers:
            self.set(name, elements_in_file(name, text))
        else:
            self.set(name, parse(text, self._names.place(name).shape, name))

    def get(self, name: str) -> Any:
        """The stored value, with floats rounded to float32; ``None`` if there is none yet.

        Vectors, matrices (as columns), arrays and buffers are tuples; structures and lights are
        mappings.
        Raises ``ParameterError`` if there is no such parameter.
        """
        _check_name(name)
        if name in self._names.textures:
            return self._textures.get(name)
        if name in self._buffers:
            return self._buffers[name].elements()
        if members := self._names.light(name):
            return {member: self.get(f"{name}.{member}") for member in members}
        place = self._names.place(name)
        value = self._values[place.parameter]
        for position in place.path:
            value = value[position]
        return plain(place.shape, value)

    def type_of(self, name: str) -> str:
        """The type of a parameter, a part of one, a texture or a buffer; empty if there is none."""
        if name in self._names.textures:
            return str(self._names.textures[name].type)
        if name in self._buffers:
            return "a storage buffer"
        try:
            return self._names.place(name).shape.type
        except ParameterError:
            return ""

    def is_light(self, name: str) -> bool:
        """True for the name of a light, which has no value of its own."""
        return bool(self._names.light(name))

    @property
    def needed(self) -> tuple[str, ...]:
        """The names of parameters that a shader reads, or from which the host computes a value."""
        return self._names.needed

    @property
    def missing(self) -> tuple[str, ...]:
        """The names of values that the blocks need and that nobody has set."""
        return tuple(self._missing(self._values))

    def values(self) -> dict[str, Any]:
        """The values of all parameters in the reference evaluator's form, as the GPU will see them.

        A value is a tuple: of lanes (of one lane, for a number), of a matrix's columns, of an
        array's elements or of a structure's members. Floats are rounded to float32. A parameter
        that no shader reads and that has no value is zero. Raises ``MissingValuesError``.
        """
        return self._values_of(self._values)

    def buffers(self) -> dict[str, Contents]:
        """The contents of every storage buffer by name; one that was not set has no elements."""
        return dict(self._buffers)

    def textures(self) -> dict[str, Texture]:
        """Every texture by name; one that was not set is the declared default, of a single
        texel."""
        return {name: self._bound(name) for name in self._names.textures}

    def __getattr__(self, name: str) -> Any:
        """The value of a parameter, or a ``Part`` if it has parts of its own."""
        if name.startswith("_"):  # Copying asks for names before there are any attributes.
            raise AttributeError(name)
        return self._attribute(name)

    def __setattr__(self, name: str, value: object) -> None:
        """Set a parameter."""
        if name.startswith("_"):
            super().__setattr__(name, value)
        elif hasattr(type(self), name):
            raise AttributeError(f"every instance has `{name}`: write set({name!r}, …)")
        else:
            self.set(name, value)

    # --- inside ----------------------------------------------------------------------------------

    def _attribute(self, name: str) -> Any:
        """The object that a name means as an attribute. Raises ``AttributeError`` if there is
        none."""
        if self._names.light(name):
            return Part(self, name)
        if name in self._names.textures or name in self._buffers:
            return self.get(name)
        try:
            place = self._names.place(name)
        except ParameterError as error:
            raise AttributeError(str(error)) from None
        if isinstance(place.shape, Numbers):
            return self.get(name)
        return Part(self, name, place.shape.count if isinstance(place.shape, Elements) else None)

    def _bound(self, name: str) -> Texture:
        """A texture that was set, or its default."""
        from ..textures.texture import default_texture

        row = self._names.textures[name]
        set_ = self._textures.get(name)
        return set_ or default_texture(row.default, row.dimension, row.sample)

    def _set_buffer(self, contents: Contents) -> None:
        layout = contents.layout
        self._buffers[layout.name] = contents
        self._values[layout.counter] = (contents.count,)

    def _changes(self, name: str, value: object) -> dict[str, Any]:
        """The new values of all parameters that change if ``name`` is set."""
        if members := self._names.light(name):
            return self._light_changes(name, members, value)
        place = self._names.place(name)
        if place.parameter in self._names.counters:
            buffer = self._names.counters[place.parameter]
            raise ParameterError(name, f"`{name}` is set with `{buffer}`, whose elements it counts")
        shape, old = self._names.shapes[place.parameter], self._values[place.parameter]
        changes = {place.parameter: changed(shape, old, place.path, value, name)}
        if isinstance(shape, Elements) and shape.counter and not place.path:
            assert isinstance(value, Sized)
            changes[shape.counter] = (len(value),)
        return changes

    def _light_changes(self, name: str, members: tuple[str, ...], value: object) -> dict[str, Any]:
        if not isinstance(value, Mapping):
            listed = ", ".join(members)
            raise ParameterError(name, f"`{name}` is a light and takes a mapping of {listed}")
        changes: dict[str, Any] = {}
        for member, inner in value.items():
            changes |= self._changes(f"{name}.{member}", inner)
        return changes

    def _sizes(self, steps: Iterable[StepRow]) -> dict[str, derived.Sized]:
        """The textures whose sizes steps read."""
        names = {step.texture for step in steps if isinstance(step, TextureStep)}
        return {name: self._sized.get(name) or self._bound(name) for name in names}

    def _read_by(
        self, steps: Iterable[StepRow], textures: Mapping[str, derived.Sized] = EMPTY
    ) -> derived.Inputs:
        """The values that steps of a host's computation read, and that need no other values.

        Raises ``MissingValuesError``.
        """
        read = [step.parameter for step in steps if isinstance(step, ParameterStep)]
        return derived.Inputs(self._names.shapes, self._values_of(read), textures, self._meter)

    def _values_of(self, names: Collection[str]) -> dict[str, Any]:
        """The values of some parameters. Raises ``MissingValuesError``."""
        missing = self._missing(names)
        if missing:
            raise MissingValuesError(self._declared.material, missing)
        shapes = self._names.shapes
        return {name: filled(shapes[name], self._values[name]) for name in names}

    def _missing(self, names: Collection[str]) -> dict[str, Numbers | Elements]:
        """The parts of these parameters that the blocks need and that have no value."""
        found: dict[str, Numbers | Elements] = {}
        for name in filter(self._names.is_needed, names):
            shape, value = self._names.shapes[name], self._values[name]
            if isinstance(shape, Elements) and shape.counter:
                value = value[: self._values[shape.counter][0]]
            found.update(unset(shape, value, name))
        return found


def _check_name(name: str) -> None:
    expect("name", name, str, "a text")


def _texture(row: TextureDeclaration, value: object) -> Texture:
    from ..textures.texture import Texture, described

    name = row.name
    if not isinstance(value, Texture):
        given = type(value).__name__
        raise ParameterError(
            name, f"`{name}` takes a Texture, and was given a value of type {given}"
        )
    if (value.dimension, value.sample) != (row.dimension, row.sample):
        wanted = described(row.dimension, row.sample)
        given = described(value.dimension, value.sample)
        raise ParameterError(name, f"`{name}` takes {wanted}, and was given {given}")
    return value


def _without_lane(value: Any) -> Any:
    """A number in place of its single lane; anything else as it is."""
    is_number = len(value) == 1 and not isinstance(value[0], tuple)
    return value[0] if is_number else value
