"""What the names in a material's equations mean as nodes: its slots, functions and textures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ...compiler.semantics.checking.arguments import takers
from ...compiler.semantics.equations.reads import MeantSlot, Where, called, inherited, meant
from ...compiler.semantics.inheritance.records import Definition as Declared
from ...compiler.semantics.names.modules import Symbol
from ...compiler.semantics.state.scope import OUTERMOST, Instance
from ...compiler.syntax import ast
from ..constants import FROM
from ..leaves.geometry import MOVED
from .callees import Callee, leaf_of, node_of
from .closures import ASKED, ASKING, closure_node
from .enumerations import member
from .expressions import At, Expressions
from .geometry import attribute, property_of, seen_from
from .images import Border, read, with_space
from .lanes import upright
from .nodes import Nodes
from .own import OwnDefinitions
from .unsayable import ReadsMaterialError, UnsayableError
from .values import (
    SAME_LANES,
    Constant,
    Linked,
    Picture,
    Several,
    Value,
    lanes_of,
    type_named,
    vector,
)

_SPACES = {function: space for space, function in reversed(FROM.items())}
_COLORS = "std.mtlx.color"
_OWN_NOISE = "std.mtlx.noise has the noises that are nodes of MaterialX"
_INSTEAD = {
    "std.noise": _OWN_NOISE,
    "std.cellular": _OWN_NOISE,
    "std.patterns": "std.mtlx.patterns has patterns that are nodes of MaterialX",
}
"""What can be used in place of functions of the library."""
_SURFACE, _TEXTURES = "std.mtlx.surface", "std.mtlx.textures"


class ExportedSurface:
    """A material, for all of the graphs in which its names are read."""

    def __init__(
        self, instance: Instance, pictures: Mapping[str, Picture], own: OwnDefinitions
    ) -> None:
        self.instance, self.pictures, self.own = instance, pictures, own
        self.record = instance.record


class Meanings:
    """The meanings of names in one graph; see the protocol in ``expressions``."""

    def __init__(self, surface: ExportedSurface, nodes: Nodes, is_function: bool = False) -> None:
        self._surface, self._nodes, self._is_function = surface, nodes, is_function
        self._slots: dict[tuple[str, int], Value] = {}
        self.expressions = Expressions(nodes, self)

    def within(self, nodes: Nodes) -> Meanings:
        """The meanings in the body of a function, which has a graph of its own."""
        return Meanings(self._surface, nodes, is_function=True)

    # ---- Slots

    def slot(self, name: str, level: int = OUTERMOST, wanted: str = "") -> Value:
        """The value of a slot of the surface."""
        definition = self._surface.record.at(name, level)
        key = (name, definition.level)
        if key not in self._slots:
            self._slots[key] = self._declared(name, definition, wanted)
        return self._slots[key]

    def _declared(self, name: str, definition: Declared, wanted: str) -> Value:
        member, owner = definition.member, definition.owner
        if owner.module.is_standard:
            known = property_of(self._nodes, owner.name, name)
            if known is not None:
                return known
            if owner.name == "Bumped" and name == "normal":
                return self._bumped()
        if self._is_function:
            raise ReadsMaterialError
        match member:
            case ast.Param():
                return self._parameter(member, owner.module.is_standard)
            case ast.Attribute():
                return attribute(self._nodes, member)
            case ast.Texture():
                return self._surface.pictures[name]
            case ast.Slot(value=value) if value is not None:
                where = Where(
                    owner.module, self._surface.instance, self._surface.instance, definition.level
                )
                typing = self._surface.record.typing(name)
                written = None if typing is None else typing.member.type
                kind = type_named(written) if written is not None else ""
                found = self.expressions.value(value, At(where, {}), kind or wanted)
                return self._nodes.named(found, name) if definition.level == 0 else found
        raise UnsayableError(f"no node gives `{name}`", "set it by a texture or a parameter")

    def _bumped(self) -> Value:
        """The normal of the mixin ``Bumped``, which reads a map as MaterialX does."""
        picture, coordinate = self.slot("normal_map"), self.slot("uv")
        assert isinstance(picture, Picture)
        is_plain = self._surface.record.at("uv", OUTERMOST).owner.module.is_standard
        place = None if is_plain else upright(self._nodes, coordinate)
        texel = read(self._nodes, picture, place, "xyz")
        return self._nodes.node("normalmap", {"in": texel}, "vector3")

    def _parameter(self, member: ast.Param, is_of_library: bool) -> Value:
        name, kind = member.name.text, type_named(member.type)
        if is_of_library or not kind:
            raise UnsayableError(
                f"no node gives `{name}`, which a renderer sets" if is_of_library
                else f"MaterialX has no inputs of the type `{member.type.span.text}`",
                "leave it out" if is_of_library else "use numbers, vectors or colours",
            )  # fmt: skip
        value = self._constant(member.default, kind)
        about = _about(member)
        if member.range is not None:
            for attribute_name, end in zip(("uimin", "uimax"), member.range, strict=True):
                # Documents have an end for each lane.
                limit = self._constant(end, "float" if lanes_of(kind) > 1 else kind)
                about[attribute_name] = self._nodes_constant(limit, kind).text
        return self._nodes.interface(name, value, about)

    def _constant(self, e: ast.Expression | None, kind: str) -> Constant:
        if e is None:
            return vector((0,) * max(lanes_of(kind), 1), kind)
        at = At(Where(self._surface.record.symbol.module, self._surface.instance, None), {})
        if isinstance(e, ast.Call) and self._calls(e, at, _COLORS, *_SPACES):
            assert isinstance(e.callee, ast.Reference)
            return replace(self._constant(e.arguments[0], kind), space=_SPACES[e.callee.name])
        return self._nodes_constant(self.expressions.value(e, at, kind), kind)

    def _nodes_constant(self, value: Value, kind: str) -> Constant:
        found = self._nodes.converted(value, kind) if isinstance(value, Constant) else None
        if not isinstance(found, Constant):
            raise UnsayableError("the value of an input has to be a constant")
        return found

    # ---- Names

    def named(self, e: ast.Reference | ast.Field, at: At) -> Value | None:
        if isinstance(e, ast.Field):
            found = inherited(e, at.where)
            return member(e, at.where) if found is None else self._read(found)
        meaning = meant(e.name, at.where)
        if isinstance(meaning, MeantSlot):
            return self._read(meaning)
        for symbol in meaning or ():
            if _is(symbol, ASKING, "clear_bsdf"):
                return ASKED
            if isinstance(symbol.declaration, ast.Constant):
                declared = symbol.declaration
                where = Where(symbol.module, self._surface.instance)
                kind = type_named(declared.type) if declared.type is not None else ""
                return self.expressions.value(
                    declared.value, replace(at, where=where, own={}), kind
                )
        return None

    def _read(self, found: MeantSlot) -> Value:
        if found.instance is not self._surface.instance:
            raise UnsayableError("a light is no part of a MaterialX surface", "leave it out")
        return self.slot(*found.key)

    def converted(self, e: ast.Conversion, at: At) -> Value:
        if isinstance(e.operand, ast.Reference) and e.operand.name not in at.own:
            known = seen_from(self._nodes, e.operand.name, e.space.text)
            if known is not None:
                return known
        raise UnsayableError(
            "only the place and the directions of the mesh are known in other spaces",
            "write it by `position`, `normal` or `tangent in object`",
        )

    def swizzled(self, e: ast.Field, at: At) -> Value | None:
        """A texture that is read with lanes, such as ``paint(uv).rgb``."""
        return self._texel(e.operand, at, e.name.text)

    # ---- Calls

    def called(self, e: ast.Call, at: At, wanted: str) -> Value | None:
        texel = self._texel(e, at, "")
        if texel is not None:
            return texel
        if not isinstance(e.callee, ast.Reference):
            return None
        found = called(e.callee.name, at.where)
        if isinstance(found, MeantSlot) or not found:
            return None
        for symbol in found:
            if isinstance(symbol.declaration, ast.StructDeclaration):
                return self._structure(symbol.declaration, e, at)
        functions = [each for each in found if isinstance(each.declaration, ast.Function)]
        return self._function(functions, e, at, wanted)

    def _texel(self, e: ast.Expression, at: At, lanes: str) -> Value | None:
        """A texture that is read, plainly or with borders; nothing for all else."""
        if not isinstance(e, ast.Call) or not isinstance(e.callee, ast.Reference):
            return None
        picture = self._picture(e.callee.name, at)
        if picture is not None:
            if len(e.arguments) != 1:
                advice = "leave out layers and offsets"
                raise UnsayableError("MaterialX reads flat pictures only", advice)
            return read(self._nodes, picture, self._coordinate(e.arguments[0], at), lanes)
        if not self._calls(e, at, _TEXTURES, "bordered", "bordered_nearest") or e.names:
            return None
        file, place, axes, beyond = e.arguments
        picture = self._picture(file.name, at) if isinstance(file, ast.Reference) else None
        if picture is None:
            return None
        if picture.is_color and self._calls(beyond, at, _COLORS, "from_srgb_texture"):
            # The colour is encoded as the file is.
            assert isinstance(beyond, ast.Call)
            beyond = beyond.arguments[0]
        border = Border(self.expressions.value(beyond, at), self.expressions.value(axes, at))
        return read(self._nodes, picture, self._coordinate(place, at), lanes, border)

    def _picture(self, name: str, at: At) -> Picture | None:
        """The texture that a name means."""
        if name in at.own:
            own = at.own[name]
            return own if isinstance(own, Picture) else None
        found = called(name, at.where)
        if not isinstance(found, MeantSlot):
            return None
        value = self.slot(*found.key)
        return value if isinstance(value, Picture) else None

    def _coordinate(self, e: ast.Expression, at: At) -> Value | None:
        """Where a texture is read, with v upwards; nothing for the mesh's first coordinates."""
        if self._calls(e, at, _SURFACE, "upright"):
            assert isinstance(e, ast.Call)
            return self.expressions.value(e.arguments[0], at, "vector2")
        value = self.expressions.value(e, at, "vector2")
        return None if value == self.slot("uv") else upright(self._nodes, value)

    def _calls(self, e: ast.Expression, at: At, path: str, *names: str) -> bool:
        """True for the call of one of some functions of the library."""
        if not isinstance(e, ast.Call) or not isinstance(e.callee, ast.Reference):
            return False
        found = called(e.callee.name, at.where)
        symbols = () if isinstance(found, MeantSlot) or not found else found
        return any(_is(symbol, path, name) for symbol in symbols for name in names)

    def _structure(self, declared: ast.StructDeclaration, e: ast.Call, at: At) -> Value:
        names = [member.name.text for member in declared.members]
        kinds = [type_named(member.type) for member in declared.members]
        numbers = takers(names, e.names, len(e.arguments)) or []
        values = {}
        for number, argument in zip(numbers, e.arguments, strict=True):
            value = self.expressions.value(argument, at, kinds[number])
            is_same = isinstance(value, Linked) and SAME_LANES.get(value.type) == kinds[number]
            is_plain = isinstance(value, Several | Picture) or is_same or not kinds[number]
            values[names[number]] = (
                value if is_plain else self._nodes.converted(value, kinds[number])
            )
        return Several(values)

    def _function(self, symbols: list[Symbol], e: ast.Call, at: At, wanted: str) -> Value:
        symbol, given = self._chosen(symbols, e, at, wanted)
        if isinstance(symbol.declaration, ast.Function) and symbol.declaration.per is not None:
            raise UnsayableError(
                f"`{symbol.name}` is summed over lights, as only whole surfaces of MaterialX are",
                "extend a model of std.models, or an imported one",
            )
        try:
            return self._applied(symbol, given, at, wanted)
        except UnsayableError as error:
            if symbol.module.is_standard and not at.where.module.is_standard:
                # People look at their own text, where they can do something about it.
                own, path = symbol.name, symbol.module.import_path
                raise UnsayableError(
                    f"`{own}` of {path} is no node: {error.text}",
                    _INSTEAD.get(path, error.advice), e.span,
                ) from None  # fmt: skip
            raise

    def _applied(self, symbol: Symbol, given: Mapping[str, Value], at: At, wanted: str) -> Value:
        function, path = symbol.declaration, symbol.module.import_path
        assert isinstance(function, ast.Function)
        if symbol.module.is_standard and path == _COLORS and symbol.name in _SPACES:
            (argument,) = given.values()
            decoded = with_space(self._nodes, argument, _SPACES[symbol.name])
            if decoded is not None:
                return decoded
        if symbol.module.is_standard and path == _SURFACE and symbol.name in MOVED:
            category, texts = MOVED[symbol.name]
            (argument,) = given.values()
            return self._nodes.node(category, {"in": argument, **texts}, "vector3")
        if symbol.module.is_standard and path == _SURFACE and symbol.name == "upright":
            (argument,) = given.values()
            return upright(self._nodes, argument)
        closure = closure_node(self._nodes, symbol, given)
        if closure is not None:
            return closure
        callee = leaf_of(symbol) or node_of(symbol)
        if callee is not None:
            return self._node(callee, function, given, wanted)
        return self._surface.own.applied(self, symbol, given, at, wanted)

    def _node(
        self, callee: Callee, function: ast.Function, given: Mapping[str, Value], wanted: str
    ) -> Value:
        kind = type_named(function.result) if function.result is not None else ""
        is_known = bool(kind) and not function.type_parameters
        if callee.gives("EDF") and not callee.gives(kind):
            kind = "EDF"
        if is_known and SAME_LANES.get(kind) != wanted:
            wanted = kind
        inputs = callee.inputs(given, self.slot)
        if any(isinstance(value, Picture) and value.is_color for value in inputs.values()):
            wanted = (
                SAME_LANES[wanted]
                if wanted.startswith("vector") and wanted in SAME_LANES
                else wanted
            )
        return self._nodes.node(callee.category, inputs, wanted, must=is_known)

    def _chosen(
        self, symbols: list[Symbol], e: ast.Call, at: At, wanted: str
    ) -> tuple[Symbol, dict[str, Value]]:
        """The overload that a call means, with the values of its arguments."""
        fitting = [symbol for symbol in symbols if _takes(symbol.declaration, e)]
        fitting.sort(key=lambda symbol: not _gives(symbol.declaration, wanted))
        values: dict[int, Value] = {}
        for symbol in fitting:
            function = symbol.declaration
            assert isinstance(function, ast.Function)
            names = [argument.name.text for argument in function.arguments]
            numbers = takers(names, e.names, len(e.arguments)) or []
            given = {}
            for place, number in enumerate(numbers):
                kind = type_named(function.arguments[number].type)
                if place not in values:
                    hint = kind if kind.startswith("color") else ""
                    values[place] = self.expressions.value(e.arguments[place], at, hint)
                given[names[number]] = values[place]
            if len(fitting) == 1 or _fits(function, given):
                return symbol, given
        raise UnsayableError(f"the call of `{symbols[0].name}` is not understood")


def _is(symbol: Symbol, path: str, name: str) -> bool:
    return symbol.module.is_standard and symbol.module.import_path == path and symbol.name == name


def _takes(function: object, e: ast.Call) -> bool:
    """True if a function can have the arguments of a call, by their number and names."""
    assert isinstance(function, ast.Function)
    names = [argument.name.text for argument in function.arguments]
    numbers = takers(names, e.names, len(e.arguments))
    return numbers is not None and all(
        argument.default is not None
        for number, argument in enumerate(function.arguments) if number not in numbers
    )  # fmt: skip


def _gives(function: object, wanted: str) -> bool:
    """True if the written result of a function is of a type."""
    assert isinstance(function, ast.Function)
    return function.result is not None and type_named(function.result) == wanted


def _fits(function: ast.Function, given: Mapping[str, Value]) -> bool:
    """True if values have as many lanes as the arguments that they are for."""
    own = {parameter.name.text for parameter in function.type_parameters}
    for argument in function.arguments:
        value = given.get(argument.name.text)
        kind = type_named(argument.type)
        if value is None or argument.type.name.text in own:
            continue
        if isinstance(value, Constant) and len(value.numbers) == 1 and lanes_of(kind) == 1:
            continue
        if not isinstance(value, Constant | Linked):
            continue
        if value.type != kind and SAME_LANES.get(value.type) != kind:
            return False
    return True


def _about(member: ast.Param) -> dict[str, str]:
    """What people read of a parameter: a short comment is its title."""
    doc = " ".join(member.doc.split())
    if not doc:
        return {}
    return {"uiname": doc} if len(doc) <= 40 else {"doc": doc}
