"""Writes the declarations of random programs that stand outside of materials."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from .expressions import FUEL, Writer
from .rules import BOOLS, FLOATS, GEOMETRIC, INTS, NUMBERS, SQUARE_MATRICES, TYPES, UINTS
from .scope import IN_TERM, LIGHT, SURFACE, Scope, Signature, local, variable
from .textures import KINDS, all_reads
from .tree import Node, expression, listed

Callables = tuple[Signature, ...]

GROUPS = ("", "", "per frame ", "per view ", "per draw ", "per weather ")
RANGES = {
    "float": ("", "in 0..1 ", "in 0.5..4 ", "in -1..1 "),
    "int": ("", "in 0..7 ", "in 1..4 ", "in -3..3 "),
    "uint": ("", "in 1..9 "),
    "vec2": ("", "in -1..1 "),
    "vec3": ("", "in 0..1 "),
    "rgb": ("", "in 0..1 "),
}
VALUES = {"float": "1.0", "int": "1", "uint": "1u", "bool": "true", "vec2": "vec2(0.5)",
          "vec3": "vec3(0.5)", "rgb": "#8040c0"}  # fmt: skip
"""Defaults, which lie in all ranges of their types."""
LIGHT_LEAVES = (
    variable("vec3(position)", "vec3", IN_TERM), variable("vec3(normal)", "vec3", IN_TERM),
)  # fmt: skip


def enumerations(writer: Writer) -> Iterator[Node]:
    """An enumeration of some members, in some files."""
    if writer.maybe(0.3):
        members = ("low", "mix", "light")[: writer.chance.randint(1, 3)]
        writer.enumerations["Mode"] = members
        shown = ", ".join(members)
        yield Node(f"enum Mode {{{{ {shown} }}}}", role="enum", optional=True, name="Mode")


def structures(writer: Writer) -> Iterator[Node]:
    """Structures, of which the second may contain the first."""
    members = ["float", "vec3", "int", "uvec2", "bool", "rgb", "mat2", "vec4"]
    members += writer.enumerations
    for name in ("Pair", "Nested")[: writer.chance.choice((0, 1, 1, 2))]:
        kinds = writer.chance.choices(members, k=writer.chance.randint(1, 3))
        if writer.structures:
            kinds.append("Pair")
        writer.structures[name] = tuple((f"m{i}", kind) for i, kind in enumerate(kinds))
        shown = ", ".join(f"{member} : {kind}" for member, kind in writer.structures[name])
        yield Node(f"struct {name} {{{{ {shown} }}}}", role="struct", optional=True, name=name)


def constants(writer: Writer) -> Iterator[tuple[Node, Node]]:
    """Constants with references to them; their values are literals."""
    for number in range(writer.chance.choice((0, 0, 1, 2))):
        type_ = writer.chance.choice(("float", "int", "vec3", "rgb", "mat2", "angle"))
        value = writer.literal(type_, Scope())
        yield (
            Node(f"k{number} : {type_} = {{}}", (value,), role="constant", optional=True),
            variable(f"k{number}", type_),
        )


def functions(writer: Writer, outside: Scope) -> Iterator[tuple[Signature, Node]]:
    """Functions that call earlier ones; some are overloads, and some have type parameters."""
    known: Callables = ()
    for _ in range(writer.chance.choice((0, 1, 1, 2, 3))):
        (made,) = writer.chance.choices((_function, _generic, _reading), (6, 2, 1))
        signature, node = made(writer, replace(outside, callables=known), known)
        known = (*known, signature)
        yield signature, node


def _function(writer: Writer, outside: Scope, known: Callables) -> tuple[Signature, Node]:
    choices = (*TYPES, *GEOMETRIC, *writer.structures, *writer.enumerations,
               "float[2]", "float", "vec3")  # fmt: skip
    types = tuple(writer.chance.choices(choices, k=writer.chance.randint(1, 3)))
    result = writer.chance.choice(("float", "vec3", "int", "vec2", "bool", "rgb", "vec4",
                                   *writer.structures, *writer.enumerations))  # fmt: skip
    name, optional = writer.fresh("f"), 0
    if known and writer.maybe(0.2) and all(types != other.formals for other in known):
        name = known[-1].name
    elif writer.maybe(0.3):
        optional = writer.chance.randint(1, len(types))
    formals = [local(writer.fresh("a"), type_) for type_ in types]
    defaults = _defaults(writer, outside, formals, optional)
    shown = ", ".join(
        f"{formal.name}: {formal.type}{default}"
        for formal, default in zip(formals, _places(len(formals), optional), strict=True)
    )
    scope, parts = _parts(writer, outside.having(*formals))
    body = writer.expression(result, scope, FUEL // 2)
    where = listed(" where {{ {} }}", parts, "; ", "parts") if parts else Node("")
    form = f"fn {name}({shown}) -> {result} = {{0}}{{1}}"
    node = Node(form, (body, where, *defaults), role="function", optional=True, name=name)
    names = tuple(formal.name for formal in formals)
    return Signature(name, types, result, names=names, optional=optional), node


def _places(count: int, optional: int) -> list[str]:
    """The text behind the type of each argument: for the last ones, the place of a default."""
    return [""] * (count - optional) + [f" = {{{number}}}" for number in range(2, 2 + optional)]


def _defaults(writer: Writer, outside: Scope, formals: list[Node], optional: int) -> list[Node]:
    """Defaults of the last arguments, which may read those before them."""
    first = len(formals) - optional
    return [
        writer.pinned(writer.expression(formal.type, outside.having(*formals[:number]), FUEL // 4))
        for number, formal in enumerate(formals[first:], first)
    ]


def _parts(writer: Writer, scope: Scope) -> tuple[Scope, list[Node]]:
    """Parts behind ``where``, and the scope that sees them; the last one comes first."""
    parts: list[Node] = []
    for _ in range(writer.chance.choice((0, 0, 1, 2))):
        name, type_ = writer.fresh("w"), writer.chance.choice((*TYPES, *GEOMETRIC[:2]))
        value = writer.expression(type_, scope, FUEL // 3)
        parts.insert(0, Node(f"{name} : {type_} = {{}}", (value,), optional=True, name=name))
        scope = scope.having(local(name, type_))
    return scope, parts


def _generic(writer: Writer, _outside: Scope, _known: Callables) -> tuple[Signature, Node]:
    """A function with a type parameter, which is called with one of the types it stands for."""
    name = writer.fresh("f")
    family, types, bodies = writer.chance.choice((
        ("floats", FLOATS, ("a + (b - a) * 0.25", "min(a, b) * 0.5", "fract(a) + abs(b)")),
        ("numbers", NUMBERS, ("max(a, b)", "a * b + a", "if all(a == a) then b else a")),
        ("integers", (*INTS, *UINTS), ("(a & b) ^ (a | b)", "a + (b << 2)")),
        ("bools", BOOLS, ("a and not b", "a or b")),
        ("matrices", SQUARE_MATRICES, ("a * b", "transpose(a) - b")),
    ))  # fmt: skip
    type_ = writer.chance.choice(types)
    body = writer.chance.choice(bodies)
    if "all(" in body:
        body = "max(min(a, b), b)"
    default = writer.chance.choice(("", " = a"))
    text = f"fn {name}<T: {family}>(a: T, b: T{default}) -> T = {body}"
    node = Node(text, role="function", optional=True, name=name)
    optional = int(bool(default))
    return Signature(name, (type_, type_), type_, names=("a", "b"), optional=optional), node


def _reading(writer: Writer, outside: Scope, _known: Callables) -> tuple[Signature, Node]:
    """A function that reads a texture, which it is given."""
    name, type_ = writer.fresh("f"), writer.chance.choice(("texture2d", *KINDS))
    place = local(writer.fresh("a"), writer.chance.choice(("vec2", "vec3", "float", "int")))
    reads = [read for read in all_reads(type_) if not read.needs]
    read = writer.chance.choice(reads)
    scope = outside.having(place)
    operands = [writer.expression(operand, scope, FUEL // 4) for operand in read.operands]
    body = expression(read.result, f"t{read.form}", operands, "read")
    form = f"fn {name}(t: {type_}, {place.name}: {place.type}) -> {read.result} = {{}}{{}}"
    node = Node(form, (body, Node("")), role="reading function", optional=True, name=name)
    return Signature(name, (type_, place.type), read.result), node


def extern_block(writer: Writer) -> tuple[Node, list[Node]]:
    """A block of the host's own, with references to its members."""
    kinds = writer.chance.choices(("vec4", "mat4", "float", "vec3", "ivec2", "uint"), k=3)
    at, members, references = 0, [], []
    for number, kind in enumerate(kinds):
        members.append(f"e{number} : {kind} at {at}")
        references.append(variable(f"e{number}", kind))
        at += 64 if kind == "mat4" else 16
    group = writer.chance.choice(("", " per view"))
    text = f"extern block Host{group} at group 3, binding 2 {{{{ {', '.join(members)} }}}}"
    return Node(text, role="extern", optional=True, name="Host"), references


def light_mixin(writer: Writer) -> Node:
    """A mixin for lights, which weakens them."""
    scope = Scope((*LIGHT_LEAVES, variable("waning", "float")), can=IN_TERM)
    share = writer.expression("float", scope, FUEL // 3)
    items = [
        Node("param waning : float in 0..1"),
        Node("falloff = inherited.falloff * float({})", (share,), role="slot", optional=True),
    ]
    form = "mixin Waning for light {{\n    {}\n}}"
    return replace(listed(form, items, "\n    ", "mixin"), optional=True)


def parameters(writer: Writer, letter: str, most: int) -> Iterator[tuple[Node, Node]]:
    """Parameters of all types, with references to them."""
    kinds = (*TYPES, "float", "int", "vec3", "rgb", "angle", "point<world>", "direction<world>",
             *writer.structures, *writer.enumerations, "float[3]", "vec3[2]", "int[4]", "mat3[2]",
             *(f"{name}[2]" for name in (*writer.structures, *writer.enumerations)))  # fmt: skip
    for number in range(writer.chance.randint(0, most)):
        type_ = writer.chance.choice(kinds)
        limits = writer.chance.choice(RANGES.get(type_.split("[")[0], ("",)))
        group, default = writer.chance.choice(GROUPS), ""
        if type_ in VALUES and writer.maybe(0.4):
            default = f"= {VALUES[type_]}"
        name = f"{letter}{number}"
        text = f"param {name} : {type_} {limits}{group}{default}".strip()
        yield Node(text, role="parameter", optional=True, name=name), variable(name, type_)


def buffer(writer: Writer, name: str) -> tuple[Node, list[Node]]:
    """A storage buffer, with references to its elements and to their number."""
    type_ = writer.chance.choice(("float", "vec3", "int", "uvec2", "mat3"))
    group = writer.chance.choice(GROUPS)
    number, last = f"{name}.count", f"{name}[{name}.count - 1]"
    elements = [f"{name}[2]", last, f"{name}[int(9 * uv.x)]"]
    references = [
        variable(number, "int"),
        *(expression(type_, text, role="variable", needs={SURFACE} if "uv" in text else ())
          for text in elements),
    ]  # fmt: skip
    declared = Node(f"buffer {name} : {type_}[] {group}".strip(), role="buffer", optional=True)
    return declared, [replace(reference, name=name) for reference in references]


def light(writer: Writer, callables: Callables, *, mixed: bool) -> Node:
    """A light of the program's own, or one of the library's with other slots."""
    base = writer.chance.choice(("Light", "Point", "Spot", "Directional"))
    leaves = [*LIGHT_LEAVES, variable("q", "float")]
    if base in ("Point", "Spot"):
        leaves.append(variable("vec3(place)", "vec3"))
    scope = Scope(tuple(leaves), tuple(c for c in callables if not c.needs), can=IN_TERM)
    items = [Node("param q : float in 0..2 = 1.0")]
    if writer.maybe(0.7):
        falloff = writer.expression("float", scope, FUEL // 2)
        if base != "Light" and writer.maybe(0.5):
            falloff = expression("float", "(inherited.falloff * {})", [falloff], "mul")
        items.append(Node("falloff = float({})", (falloff,), role="slot", optional=True))
    if base == "Light" or writer.maybe(0.3):
        towards = writer.expression("vec3", scope, FUEL // 3)
        items.append(Node("to_light = normalize(vec3({}))", (towards,), optional=base != "Light"))
    mixins = [Node("Waning", optional=True)] if mixed else []
    header = listed("{}", [Node(base), *mixins], " + ")
    members = listed("{{\n    {}\n}}", items, "\n    ")
    return Node("light Own : {} {}", (header, members), role="light", optional=True)


def terms(writer: Writer, outside: Scope) -> Iterator[tuple[Signature, Node]]:
    """Terms, summed over the lights or not."""
    for per_light in writer.chance.choice(((), (True,), (False,), (True, False))):
        name, formal = writer.fresh("t"), local(writer.fresh("a"), "rgb")
        can = IN_TERM | {LIGHT} if per_light else IN_TERM
        scope = replace(outside, can=can).having(formal)
        scope, parts = _parts(writer, scope)
        body = writer.expression("rgb", scope, FUEL // 2)
        where = listed(" where {{ {} }}", parts, "; ", "parts") if parts else Node("")
        rate = " per light" if per_light else ""
        form = f"term {name}({formal.name}: rgb) -> rgb{rate} = {{}}{{}}"
        needs = frozenset({"surface", "lit"})
        node = Node(form, (body, where), role="term", optional=True, name=name)
        yield Signature(name, ("rgb",), "rgb", needs), node


def rig(writer: Writer, *, own: bool, any_number: bool) -> Node:
    """The lights that shine; a storage buffer has any number of them."""
    kinds = ["Directional", "Point", "Spot", "FocusedSpot"] + ["Own"] * (3 * own)
    counts = ("", "", "[1]", "[2]", "[3]", "[<= 3]", *["[]"] * any_number)
    entries = []
    for number in range(writer.chance.randint(1, 3)):
        kind = writer.chance.choice(kinds)
        override = ""
        if writer.maybe(0.2):
            override = " {{ falloff = 0.5 * inherited.falloff }}"
        text = f"l{number} : {kind}{writer.chance.choice(counts)}{override}"
        entries.append(Node(text, optional=number > 0))
    return replace(listed("rig Some {{\n    {}\n}}", entries, "\n    ", "rig"), optional=True)
