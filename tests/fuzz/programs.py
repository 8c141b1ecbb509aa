"""Writes whole random programs, each from a seed: the same seed always gives the same program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass, field, replace
from random import Random

from . import declarations, kernels
from .expansions import SPREAD, expansion
from .expressions import FUEL, Writer
from .frames import frame, render_states
from .rules import GEOMETRIC, TYPES
from .scope import (
    FRAGMENT,
    IN_MATERIAL,
    LIT,
    SPACES,
    SURFACE,
    TRANSFORMS,
    UNIFORM,
    Map,
    Scope,
    Signature,
    variable,
)
from .tessellations import divided_and_expanded, tessellation
from .textures import DEFAULTS, KINDS, SETTINGS, settings_of
from .tree import Node, expression, listed

FORMATS = {
    "float": ("r8", "r16f", "r32f"),
    "vec2": ("rg8", "rg16f", "rg32f"),
    "vec4": ("rgba8", "rgba8_srgb", "bgra8", "rgb10a2", "rgba16f", "rgba32f"),
}
CAPTURED = ("float", "vec2", "vec3", "vec4", "int", "uint", "ivec2", "uvec2")
"""Some of the types that can be captured."""
BLENDS = ("none", "none", "add", "multiply")
BLENDS_BY_ALPHA = ("alpha", "premultiplied")
"""Further blendings, which only targets of four lanes have."""
FACTORS = ("zero", "one", "src", "one_minus_src", "dst", "one_minus_dst")
FACTORS_BY_ALPHA = (
    "src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated",
)  # fmt: skip
OPERATIONS = ("add", "add", "subtract", "reverse_subtract")
CHOICES = ("min", "max")
MASKS = ("rgb", "a", "rb", "gba", "none")
FLOATS = "32f"
"""The ending of the names of formats that frames do not blend."""
LIBRARY_MIXINS = {
    "VertexColors": "vertices", "SecondUv": "vertices", "Tangents": "tangents",
    "Skinned": "skinning", "Instanced": "instancing", "Morphed": "morphing",
    "Billboard": "billboards",
}  # fmt: skip
OVERRIDES = {
    "float": ("0.5", "0.5 + 0.4 * saturate({})"), "int": ("1", "clamp({}, 1, 2)"), "uint": ("2u",),
    "vec3": ("vec3(0.5)", "saturate({})"), "vec2": ("vec2(0.5)", "0.5 * {}"), "rgb": ("#808080",),
    "vec4": ("{}.wzyx",), "bool": ("not {}",), "mat3": ("transpose({})",),
}  # fmt: skip
"""Other definitions of what a base declares, within all ranges that it may have."""
_SURFACE = frozenset({SURFACE})
_VARYING = (
    variable("uv", "vec2", _SURFACE), variable("uv.x", "float", _SURFACE),
    variable("uv.y", "float", _SURFACE), variable("vec3(position)", "vec3", _SURFACE),
    variable("vec3(normal)", "vec3", _SURFACE), variable("int(9 * uv.x)", "int", _SURFACE),
    variable("uint(7 * uv.y)", "uint", _SURFACE), variable("(uv.x < uv.y)", "bool", _SURFACE),
)  # fmt: skip
"""Values that differ from pixel to pixel, so that not too much of a program is constant."""
_OWN = (variable("inherited.color", "rgb"),)


def program(seed: str) -> Node:
    """The program of a seed."""
    return _Program(Writer(Random(f"burnish {seed}"))).tree()


@dataclass
class _Program:
    """Writes one program, part by part."""

    writer: Writer
    imports: list[str] = field(default_factory=lambda: ["std.lights", "std.terms"])
    file: list[Node] = field(default_factory=list)
    """The declarations in front of materials."""
    scope: Scope = field(default_factory=Scope)
    """The scope of functions."""
    hosted: tuple[Node, ...] = ()
    """References to the members of the host's block."""
    has_bench: bool = False
    """True if the program declares a space of its own."""
    divides_patches: bool = False
    """True if a material divides patches: a pass must not expand all primitives then."""
    has_buffers: bool = False
    """True if there may be storage buffers.

    Then no fragment compares neighbouring pixels: Mesa reads zeros in pixels that are computed only
    for their neighbours (``docs/drivers.md``).
    """
    inherited: list[Node] = field(default_factory=list)
    """References to what the base declares, which the material may override."""

    def tree(self) -> Node:
        """The whole file."""
        writer = self.writer
        writer.wild = writer.maybe(0.2)
        self.has_buffers = writer.maybe(0.25)
        self.file += declarations.enumerations(writer)
        self.file += declarations.structures(writer)
        for node, reference in declarations.constants(writer):
            self.file.append(node)
            self.scope = self.scope.having(reference)
        self._surroundings()
        functions = list(declarations.functions(writer, self.scope))
        own_light = writer.maybe(0.4)
        callables = tuple(signature for signature, _ in functions)
        outside = replace(self.scope, callables=callables)
        terms = list(declarations.terms(writer, outside))
        self.file += [node for _, node in (*functions, *terms)]
        if writer.maybe(0.06):
            self.file.append(kernels.kernel(writer, outside))
        if own_light:
            mixed = writer.maybe(0.2)
            self.file += [declarations.light_mixin(writer)] * mixed
            self.file.append(declarations.light(writer, callables, mixed=mixed))
        usable = (*callables, *(signature for signature, _ in terms))
        materials = list(self._materials(replace(outside, callables=usable)))
        passes = [self._any_pass(usable, materials)] if writer.maybe(0.3) else []
        if any(drawn.name for drawn in passes) and writer.maybe(0.3):
            form = "material Random{} by Drawn {}"
            materials[-1] = replace(materials[-1], form=form)
        rigs = [declarations.rig(writer, own=own_light, any_number=self.has_buffers)]
        frames = [
            frame(writer, drawn, [*materials, drawn])
            for drawn in passes
            if drawn.name and writer.maybe(0.5)
        ]
        imports = [Node(f"import {path}", optional=True) for path in dict.fromkeys(self.imports)]
        items = [*imports, *self.file, *materials, *passes, *rigs, *frames]
        if writer.maybe(0.1):
            items.insert(0, Node("burnish 1", optional=True))
        return listed("{}\n", items, "\n", "file")

    def _surroundings(self) -> None:
        """Extends the scope of functions by a block of the host and by the library's transforms."""
        writer = self.writer
        if writer.maybe(0.15):
            block, members = declarations.extern_block(writer)
            self.file.append(block)
            self.hosted = tuple(members)
        if writer.maybe(0.2):
            self.imports.append("std.transforms")
            self.scope = replace(self.scope, can=self.scope.can | {TRANSFORMS})
        if writer.maybe(0.2):
            self.file.append(Node("space bench", optional=True))
            self.has_bench = True

    def _fragments(self, can: Set[str]) -> frozenset[str]:
        """The abilities among ``can`` that fragments of this program have."""
        return frozenset(can - {UNIFORM} if self.has_buffers else can)

    # --- materials -------------------------------------------------------------------------------

    def _materials(self, outside: Scope) -> Iterator[Node]:
        """A material, perhaps with a base and mixins."""
        writer = self.writer
        can = self._fragments(IN_MATERIAL | self.scope.can)
        scope = replace(outside, can=can).having(*_VARYING, *self.hosted)
        base, mixins = "Surface", []
        if writer.maybe(0.3):
            scope, node = self._base(scope)
            base = "Base"
            yield node
        if writer.maybe(0.25):
            name = writer.chance.choice([*LIBRARY_MIXINS])
            self.imports.append(f"std.{LIBRARY_MIXINS[name]}")
            mixins.append(name)
        if writer.maybe(0.25):
            yield self._mixin(scope)
            mixins.append("Mixed")
        names = [Node(base, role="base"), *(Node(name, optional=True) for name in mixins)]
        header = listed(" : {}", names, " + ")
        scope, items = self._members(scope, "p", most=5)
        if self.has_bench:
            text = "param bench_to_world : transform<bench, world> per draw = mat4(1)"
            items.append(Node(text, role="parameter", optional=True, name="bench_to_world"))
            scope = replace(scope, can=scope.can | {SPACES})
        items += self._overrides()
        items += self._places(scope)
        items += self._slots(scope, "s", most=3)[1]
        if writer.maybe(0.2):
            made = writer.chance.choice((expansion, expansion, tessellation, divided_and_expanded))
            items += made(writer, scope)
            scope = scope.having(SPREAD)
            self.divides_patches |= made is not expansion
        below = scope.having(*_OWN)
        last_scope, slots = self._slots(below, "c", most=1)
        color = writer.expression("rgb", last_scope)
        alpha = writer.expression("float", replace(last_scope, leaves=scope.leaves), FUEL // 2)
        items += slots
        items.append(Node("color = {}", (self._tamed(color),), role="slot", name="color"))
        items.append(
            Node("alpha = {}", (self._tamed(alpha),), role="slot", optional=True, name="alpha")
        )
        members = listed("{{\n    {}\n}}", items, "\n    ", "members")
        yield Node("material Random{} {}", (header, members), role="material")

    def _tamed(self, node: Node) -> Node:
        """A result that float32 holds, in most programs."""
        if self.writer.wild or self.writer.maybe(0.3):
            return node
        return expression(node.type, "clamp({}, -100.0, 100.0)", [node], "tamed")

    def _base(self, scope: Scope) -> tuple[Scope, Node]:
        """An abstract material, and the scope of those that are derived from it."""
        known = scope.leaves
        scope, items = self._members(scope, "b", most=2)
        scope, slots = self._slots(scope, "d", most=2)
        new = (leaf for leaf in scope.leaves if leaf not in known)
        # An element of a buffer is no name that could be overridden.
        self.inherited += [leaf for leaf in new if str(leaf) == leaf.name]
        color = self.writer.expression("rgb", scope, FUEL // 2)
        items += [*slots, Node("color = {}", (color,), role="slot", optional=True)]
        form = "abstract material Base {{\n    {}\n}}"
        return scope, replace(listed(form, items, "\n    ", "base material"), optional=True)

    def _overrides(self) -> Iterator[Node]:
        """Parameters and slots of the base that the material defines in another way."""
        for reference in self.inherited:
            if reference.type in OVERRIDES and self.writer.maybe(0.3):
                name, form = reference.name, self.writer.chance.choice(OVERRIDES[reference.type])
                text = f"{name} = {form.format(f'inherited.{name}')}"
                yield Node(text, role="override", optional=True, name=name)

    def _mixin(self, scope: Scope) -> Node:
        """A mixin that continues the colour that it finds."""
        outside = Scope((), scope.callables, (), scope.can)
        inner, items = self._members(outside.having(*_VARYING), "x", most=1)
        inner, slots = self._slots(inner.having(*_OWN), "y", most=1)
        color = self.writer.expression("rgb", inner, FUEL // 2)
        items += [*slots, Node("color = {}", (color,), role="slot", optional=True)]
        made = listed("mixin Mixed {{\n    {}\n}}", items, "\n    ", "mixin")
        return replace(made, optional=True)

    def _members(self, scope: Scope, letter: str, most: int) -> tuple[Scope, list[Node]]:
        """Parameters, textures and inputs of the vertices, and the scope that has them."""
        writer, items = self.writer, []
        for node, reference in declarations.parameters(writer, letter, most):
            items.append(node)
            scope = scope.having(reference)
        maps = list(self._maps(letter))
        items += [node for _, node in maps]
        for number in range(writer.chance.choice((0, 0, 0, 1, 2))):
            type_ = writer.chance.choice(("float", "vec2", "vec3", "vec4", "int", "uvec2", "mat2"))
            rate = writer.chance.choice(("", "", " per instance"))
            name = f"{letter}_in{number}"
            items.append(Node(f"attribute {name} : {type_}{rate}", optional=True, name=name))
            scope = scope.having(variable(name, type_, () if type_ != "mat2" else {SURFACE}))
        if self.has_buffers and writer.maybe(0.3):
            node, references = declarations.buffer(writer, f"{letter}_buffer")
            items.append(node)
            scope = scope.having(*references)
        return replace(scope, maps=(*scope.maps, *(each for each, _ in maps))), items

    def _maps(self, letter: str) -> Iterator[tuple[Map, Node]]:
        chance = self.writer.chance
        for number in range(chance.choice((0, 0, 0, 1, 1, 2))):
            type_ = chance.choice(("texture2d", "texture2d", *KINDS))
            name, default, state = f"{letter}_map{number}", "", ""
            if chance.random() < 0.5:
                default = f" = {chance.choice(DEFAULTS[type_])}"
            settings = [s for s in settings_of(type_) if chance.random() < 0.4]
            if settings:
                chosen = ", ".join(f"{s} = {chance.choice(SETTINGS[s])}" for s in settings)
                state = f" with {{{{ {chosen} }}}}"
            text = f"map {name} : {type_}{default}{state}"
            yield Map(name, type_), Node(text, role="map", optional=True, name=name)

    def _places(self, scope: Scope) -> Iterator[Node]:
        """Slots of the surface that move or turn it a little."""
        writer = self.writer
        plain = [leaf for leaf in scope.leaves if not leaf.needs]
        before = replace(scope, can=frozenset[str](), maps=())
        if writer.maybe(0.12):
            leaves = (*plain, variable("vec3(vertex_normal)", "vec3"))
            moved = writer.expression("vec3", replace(before, leaves=leaves), FUEL // 3)
            text = "position = @vertex (inherited.position + 0.1 * sin(vec3({})))"
            yield Node(text, (moved,), role="place", optional=True)
        if writer.maybe(0.12):
            bent = writer.expression("vec3", before.having(variable("uv.xyx", "vec3")), FUEL // 3)
            text = "normal = normalize(vec3(inherited.normal) + 0.3 * cos(vec3({})))"
            yield Node(text, (bent,), role="place", optional=True)
        if writer.maybe(0.1):
            yield Node("uv = 3 * inherited.uv - 1", role="place", optional=True)

    def _slots(self, scope: Scope, letter: str, most: int) -> tuple[Scope, list[Node]]:
        """Slots that later ones can use."""
        writer, items = self.writer, []
        kinds = (
            *TYPES,
            *GEOMETRIC,
            *writer.structures,
            *writer.enumerations,
            "float[3]",
            "vec3[2]",
        )
        for number in range(writer.chance.randint(0, most)):
            type_, name = writer.chance.choice(kinds), f"{letter}{number}"
            value = writer.pinned(writer.expression(type_, scope))
            written = f" : {type_}" if type_ not in TYPES or writer.maybe(0.5) else ""
            form = f"{name}{written} = {{}}"
            items.append(Node(form, (value,), role="slot", optional=True, name=name))
            needs = {each for each in value.needs if not each.startswith("local ")}
            scope = scope.having(variable(name, type_, needs))
        return scope, items

    # --- passes ----------------------------------------------------------------------------------

    def _any_pass(self, callables: tuple[Signature, ...], materials: Sequence[Node]) -> Node:
        """A pass that draws or, now and then, one that captures vertices."""
        return self._capturing() if self.writer.maybe(0.15) else self._pass(callables, materials)

    def _capturing(self) -> Node:
        """A pass that captures values of several types, of what every surface has at vertices."""
        writer = self.writer
        leaves = (
            variable("vec3(position)", "vec3"), variable("vec3(normal)", "vec3"),
            variable("uv", "vec2"), variable("vertex_index", "uint"),
        )  # fmt: skip
        scope = Scope(leaves, can=frozenset[str]())
        items = []
        for node, reference in declarations.parameters(writer, "r", 1):
            items.append(node)
            scope = scope.having(reference)
        for number in range(writer.chance.randint(1, 4)):
            type_ = writer.chance.choice(CAPTURED)
            value = writer.expression(type_, scope, FUEL // 2)
            if type_[0] in "fv":
                value = self._tamed(value)
            text = f"capture o{number} : {type_} = {{}}"
            items.append(Node(text, (value,), role="capture", optional=number > 0))
        return replace(listed("pass Drawn {{\n    {}\n}}", items, "\n    ", "pass"), optional=True)

    def _pass(self, callables: tuple[Signature, ...], materials: Sequence[Node]) -> Node:
        """A pass with targets of several formats, blending, discarding; or one of depths only."""
        writer = self.writer
        scope = Scope((variable("vec3(color)", "vec3"), variable("alpha", "float")), callables,
                      can=self._fragments({SURFACE, LIT, FRAGMENT, UNIFORM}))  # fmt: skip
        items = []
        for node, reference in declarations.parameters(writer, "r", 1):
            items.append(node)
            scope = scope.having(reference)
        if not self.divides_patches and writer.maybe(0.2):
            # What the color follows from cannot follow from the color.
            before = replace(scope, leaves=scope.leaves[2:])
            items += expansion(writer, before, layers=writer.chance.choice((0, 2, 3)))
            scope = scope.having(SPREAD)
        elif writer.maybe(0.15):
            items.append(Node("views of 2", role="views"))
            scope = scope.having(variable("view_index", "int"))
        is_deep = writer.maybe(0.12)
        adds = not is_deep and writer.maybe(0.25)
        types = []
        for number in range(0 if is_deep else writer.chance.randint(0, 2)):
            type_ = writer.chance.choice([*FORMATS])
            types.append(type_)
            value = self._tamed(writer.expression(type_, scope, FUEL // 2))
            blends = adds or writer.maybe(0.4)
            formats = [name for name in FORMATS[type_] if not (blends and name.endswith(FLOATS))]
            text = f"target o{number} : {writer.chance.choice(formats)} = {{}}"
            text += f" blend {'add' if adds else self._blending(type_) if blends else 'none'}"
            items.append(Node(text, (value,), role="target", optional=True, name=f"o{number}"))
        if len(types) == 2:
            items.append(Node(f"clear {{{{ o1 = {types[1]}(0.25) }}}}", optional=True))
        if writer.maybe(0.3):
            condition = writer.expression("bool", scope, FUEL // 2)
            items.append(Node("discard when {}", (condition,), role="discard", optional=True))
        items += render_states(writer, [*materials, *items], is_deep=is_deep)
        if is_deep:
            form = "pass Drawn {{\n    {}\n}}"
            return replace(listed(form, items, "\n    ", "pass"), optional=True, name="Drawn")
        blended = adds or writer.maybe(0.4)
        blend = f" blend {'add' if adds else self._blend('vec4')}" if blended else ""
        form = f"pass Drawn : Forward{blend} {{{{\n    {{}}\n}}}}"
        return replace(listed(form, items, "\n    ", "pass"), optional=True, name="Drawn")

    def _blend(self, type_: str) -> str:
        """A word for how a target of a type is blended."""
        return self.writer.chance.choice(BLENDS + BLENDS_BY_ALPHA * (type_ == "vec4"))

    def _blending(self, type_: str) -> str:
        """The blending of a target of a type, and the lanes that are written."""
        chance, of_alpha = self.writer.chance, type_ == "vec4"
        settings = {}
        if chance.random() < 0.5:
            factors = FACTORS + FACTORS_BY_ALPHA * of_alpha
            settings = {name: chance.choice(factors) for name in ("source", "destination")}
            settings["operation"] = chance.choice(OPERATIONS)
        elif chance.random() < 0.3:
            settings = {"operation": chance.choice(CHOICES)}
        if chance.random() < 0.3:
            settings["mask"] = chance.choice(MASKS)
        said = ", ".join(f"{name} = {word}" for name, word in settings.items())
        return f"{self._blend(type_)}{f' {{{{ {said} }}}}' if said else ''}"
