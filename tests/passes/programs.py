"""Generates random Burnish programs as text: well typed, small, and with a bit of everything."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import product

from hypothesis import strategies as st

from burnish.compiler.ir.signatures import parsed, result_type
from burnish.compiler.ir.types import BOOL, FLOAT, INT, UINT, VEC3, Matrix, Scalar, Type, Vector
from burnish.compiler.ir.types import width as lanes_of
from burnish.compiler.semantics.checking.expressions import OPERATORS
from burnish.stdlib.builtins import BUILTINS

VECTORS = tuple(Vector("float", n) for n in (2, 3, 4))
TYPES: tuple[Type, ...] = (
    FLOAT, INT, UINT, BOOL, *VECTORS, Vector("int", 2), Vector("uint", 2), Vector("bool", 2),
    *(Matrix(n) for n in (2, 3, 4)),
)  # fmt: skip
FUEL = 12
"""The approximate number of operations of one expression."""
NUMBERS = ("0.0", "1.0", "0.5", "2.0", "0.25", "3.0", "1e-3", "7.5")
INFIX = {builtin: symbol for symbol, builtin in OPERATORS.items()}
CONVERSIONS = ("to_float", "to_int", "to_uint")
PREFIX = {"neg": "-", "bit_not": "~", "not": "not "}


@dataclass(frozen=True)
class Variable:
    """A name that is in scope."""

    text: str
    type: Type
    textured: bool = False
    """Whether its value depends on a texture read, which is not allowed everywhere."""
    turning: bool = False
    """Whether it changes with the iterations of a loop, so that it cannot be passed between
    stages."""


@dataclass(frozen=True)
class Scope:
    """What an expression may use."""

    variables: tuple[Variable, ...] = ()
    functions: tuple[tuple[str, tuple[Type, ...], Type], ...] = ()
    terms: tuple[str, ...] = ()
    arrays: tuple[Variable, ...] = ()
    """Parameters that are arrays; the types are those of their elements."""
    maps: tuple[str, ...] = ()
    surface: bool = False
    """Whether values may be moved to the vertices."""

    def within(self, *variables: Variable) -> Scope:
        """The scope with more variables, and without textures to read with an implicit level."""
        return replace(self, variables=self.variables + variables, maps=())

    def at_vertex(self) -> Scope:
        """The scope of an operand of ``@vertex``."""
        plain = tuple(v for v in self.variables if not (v.textured or v.turning))
        return Scope(plain, self.functions, arrays=self.arrays)


@cache
def instances(result: Type) -> tuple[tuple[str, tuple[Type, ...]], ...]:
    """The builtins that can give ``result``, with types of operands."""
    return tuple(
        (name, operands)
        for name in BUILTINS
        if not BUILTINS[name].uniform_control_flow
        for operands in fitting(name)
        if result_type(name, operands) == result
    )


@cache
def fitting(name: str) -> tuple[tuple[Type, ...], ...]:
    """The types of operands that the builtin ``name`` accepts."""
    counts = {len(parsed(signature)[0]) for signature in BUILTINS[name].signatures}
    return tuple(
        operands
        for count in sorted(counts)
        for operands in product(TYPES, repeat=count)
        if result_type(name, operands) is not None
    )


@dataclass
class Writer:
    """Writes random expressions."""

    draw: st.DrawFn
    textured: bool = field(default=False, init=False)
    """Whether anything that was written since this was cleared reads a texture."""

    def expression(self, type_: Type, scope: Scope, fuel: int = FUEL) -> str:
        """An expression of a type."""
        if fuel <= 0:
            return self._leaf(type_, scope)
        ways: list[Callable[[Type, Scope, int], str]] = [self._plain_leaf, self._builtin]
        ways += [self._builtin, self._builtin, self._conditional, self._constructed]
        if any(result == type_ for _, _, result in scope.functions):
            ways += [self._function, self._function]
        if any(array.type == type_ for array in scope.arrays):
            ways += [self._indexed, self._indexed]
        if type_ in (FLOAT, INT, *VECTORS):
            ways += [self._fold, self._open_fold]
        if type_ == BOOL:
            ways.append(self._any)
        if type_ in (FLOAT, VEC3):
            ways.append(self._member)
        ways += [self._element, self._iterate, self._two_states]
        if type_ in (FLOAT, *VECTORS):
            ways.append(self._swizzled)
        if type_ == VEC3 and scope.terms:
            ways += [self._term, self._term]
        if scope.surface and isinstance(type_, Scalar | Vector):
            ways.append(self._crossing)
        if type_ == Vector("float", 4) and scope.maps:
            ways.append(self._read)
        return self.draw(st.sampled_from(ways))(type_, scope, fuel - 1)

    def _leaf(self, type_: Type, scope: Scope) -> str:
        known = [v for v in scope.variables if v.type == type_]
        if known and self.draw(st.sampled_from([True, True, True, False])):
            chosen = self.draw(st.sampled_from(known))
            self.textured |= chosen.textured
            return chosen.text
        return self._literal(type_, scope)

    def _plain_leaf(self, type_: Type, scope: Scope, _fuel: int) -> str:
        return self._leaf(type_, scope)

    def _literal(self, type_: Type, scope: Scope) -> str:
        match type_:
            case Scalar("float"):
                return self.draw(st.sampled_from(NUMBERS))
            case Scalar("int"):
                return str(self.draw(st.sampled_from([0, 1, 2, 3, 7])))
            case Scalar("uint"):
                return f"{self.draw(st.sampled_from([0, 1, 2, 5]))}u"
            case Scalar("bool"):
                return self.draw(st.sampled_from(["true", "false"]))
            case Vector(kind, size):
                parts = (self._leaf(Scalar(kind), scope) for _ in range(size))
                return f"{type_}({', '.join(parts)})"
            case Matrix(size):
                columns = (self._leaf(Vector("float", size), scope) for _ in range(size))
                return f"{type_}({', '.join(columns)})"
        raise TypeError(type_)

    def _builtin(self, type_: Type, scope: Scope, fuel: int) -> str:
        found = instances(type_)
        names = sorted({name for name, _ in found})
        name = self.draw(st.sampled_from(names))
        operands = self.draw(st.sampled_from([o for n, o in found if n == name]))
        share = fuel // len(operands)
        texts = [self.expression(operand, scope, share) for operand in operands]
        if name in INFIX:
            return f"({texts[0]} {INFIX[name]} {texts[1]})"
        if name in PREFIX:
            return f"({PREFIX[name]}{texts[0]})"
        shown = str(type_) if name in CONVERSIONS else name
        return f"{shown}({', '.join(texts)})"

    def _conditional(self, type_: Type, scope: Scope, fuel: int) -> str:
        condition = self.expression(BOOL, scope, fuel // 3)
        then, otherwise = (self.expression(type_, scope, fuel // 3) for _ in range(2))
        return f"(if {condition} then {then} else {otherwise})"

    def _constructed(self, type_: Type, scope: Scope, fuel: int) -> str:
        match type_:
            case Vector(kind, size):
                parts = (self.expression(Scalar(kind), scope, fuel // size) for _ in range(size))
                return f"{type_}({', '.join(parts)})"
            case Matrix(size) if self.draw(st.booleans()):
                column = Vector("float", size)
                columns = (self.expression(column, scope, fuel // size) for _ in range(size))
                return f"{type_}({', '.join(columns)})"
            case Matrix():
                return f"{type_}({self.expression(FLOAT, scope, fuel)})"
            case _:
                return self._builtin(type_, scope, fuel)

    def _swizzled(self, type_: Type, scope: Scope, fuel: int) -> str:
        source = self.draw(st.sampled_from(VECTORS))
        inner = self.expression(source, scope, fuel)
        lanes = "xyzw"[: source.size]
        if type_ == FLOAT and self.draw(st.booleans()):
            position = self.expression(INT, scope, 0)
            return f"({inner})[({position}) mod {source.size}]"
        picked = (self.draw(st.sampled_from(lanes)) for _ in range(lanes_of(type_)))
        return f"({inner}).{''.join(picked)}"

    def _function(self, type_: Type, scope: Scope, fuel: int) -> str:
        fitting = [f for f in scope.functions if f[2] == type_]
        name, operands, _ = self.draw(st.sampled_from(fitting))
        texts = (self.expression(operand, scope, fuel // len(operands)) for operand in operands)
        return f"{name}({', '.join(texts)})"

    def _fold(self, type_: Type, scope: Scope, fuel: int) -> str:
        index = self._fresh("i", scope)
        end = self.draw(st.integers(0, 5))
        start = self.draw(st.sampled_from([0, 0, 1, -1]))
        word = self.draw(st.sampled_from(["sum", "product"]))
        body = self.expression(type_, scope.within(Variable(index, INT)), fuel // 2)
        if type_ == INT:
            body = f"{index} + {body}"  # a literal by itself would be a float
        return f"({word} {index} in {start}..{end} : {body})"

    def _open_fold(self, type_: Type, scope: Scope, fuel: int) -> str:
        """A fold whose count is known at run time."""
        index = self._fresh("i", scope)
        end = f"clamp({self._leaf(INT, scope)}, 0, {self.draw(st.integers(0, 5))})"
        if self.draw(st.booleans()):
            end = f"{self._leaf(INT, scope)} up to {self.draw(st.integers(0, 5))}"
        word = self.draw(st.sampled_from(["sum", "product", "min", "max"]))
        first = f" from {self.expression(type_, scope, fuel // 4)}"
        body = self.expression(type_, scope.within(Variable(index, INT, turning=True)), fuel // 2)
        if type_ == INT:
            body = f"{index} + {body}"
        return f"({word} {index} in 0..{end}{first} : {body})"

    def _any(self, _type: Type, scope: Scope, fuel: int) -> str:
        index = self._fresh("i", scope)
        word = self.draw(st.sampled_from(["any", "all"]))
        inner = scope.within(Variable(index, INT, turning=True))
        body = self.expression(BOOL, inner, fuel // 2)
        return f"({word} {index} in 0..{self.draw(st.integers(0, 4))} : {body})"

    def _iterate(self, type_: Type, scope: Scope, fuel: int) -> str:
        """A state, by itself or as a member beside another one."""
        state, index = self._fresh("x", scope), self._fresh("i", scope)
        first = self.expression(type_, scope, fuel // 4)
        if type_ in (INT, FLOAT, BOOL):
            first = f"{type_}({first})"  # a literal by itself could be something else
        variable = Variable(state, type_, turning=True)
        inner = scope.within(variable, Variable(index, INT, turning=True))
        condition = self.expression(BOOL, inner, fuel // 4)
        going = f" while {condition}" if self.draw(st.booleans()) else ""
        turns = f"for {index} in 0..{self.draw(st.integers(0, 4))}"
        body = self.expression(type_, inner, fuel // 2)
        return f"(iterate {state} from {first} {turns}{going} : {body})"

    def _two_states(self, type_: Type, scope: Scope, fuel: int) -> str:
        """A structure as the state; the result is one of its members, or is computed from one."""
        state, index = self._fresh("x", scope), self._fresh("i", scope)
        turning = (
            Variable(f"{state}.number", FLOAT, turning=True),
            Variable(f"{state}.vector", VEC3, turning=True),
        )
        inner = scope.within(*turning, Variable(index, INT, turning=True))
        first, following = (
            f"Pair({self.expression(FLOAT, s, share)}, {self.expression(VEC3, s, share)})"
            for s, share in ((scope, fuel // 6), (inner, fuel // 4))
        )
        condition = self.expression(BOOL, inner, fuel // 4)
        going = f" while {condition}" if self.draw(st.booleans()) else ""
        turns = f"for {index} in 0..{self.draw(st.integers(0, 12))}"
        loop = f"(iterate {state} from {first} {turns}{going} : {following})"
        member = {FLOAT: ".number", VEC3: ".vector"}.get(type_)
        if member is not None:
            return loop + member
        then, otherwise = self._leaf(type_, scope), self._leaf(type_, scope)
        return f"(if {loop}.number > 0.5 then {then} else {otherwise})"

    def _indexed(self, type_: Type, scope: Scope, fuel: int) -> str:
        """An element of a parameter, usually the one with the loop's index."""
        array = self.draw(st.sampled_from([a for a in scope.arrays if a.type == type_]))
        indices = [v.text for v in scope.variables if v.text[0] == "i" and v.type == INT]
        if indices and self.draw(st.sampled_from([True, True, False])):
            at = self.draw(st.sampled_from(indices))
        else:
            at = self.expression(INT, scope, fuel // 3)
        return array.text.format(at)

    def _element(self, type_: Type, scope: Scope, fuel: int) -> str:
        count = self.draw(st.integers(1, 3))
        elements = [self.expression(type_, scope, fuel // count) for _ in range(count)]
        if type_ in (INT, FLOAT, UINT):
            elements = [f"{type_}({element})" for element in elements]
        return f"[{', '.join(elements)}][({self.expression(INT, scope, 0)}) mod {count}]"

    def _member(self, type_: Type, scope: Scope, fuel: int) -> str:
        """A member of one of two structures."""
        condition = self.expression(BOOL, scope, fuel // 4)
        made = [
            f"Pair({self.expression(FLOAT, scope, fuel // 4)}, "
            f"{self.expression(VEC3, scope, fuel // 4)})"
            for _ in range(2)
        ]
        member = "number" if type_ == FLOAT else "vector"
        return f"(if {condition} then {made[0]} else {made[1]}).{member}"

    def _fresh(self, letter: str, scope: Scope) -> str:
        """A name for a loop's variable that no surrounding loop uses."""
        return f"{letter}{sum(v.text.startswith(letter) for v in scope.variables)}"

    def _term(self, _type: Type, scope: Scope, fuel: int) -> str:
        name = self.draw(st.sampled_from(scope.terms))
        if name in ("phong", "blinn_phong"):
            power = self.draw(st.sampled_from(["1.0", "4.0", "p_power"]))
            return f"vec3({name}({self.expression(VEC3, scope, fuel)}, {power}))"
        return f"vec3({name}({self.expression(VEC3, scope, fuel)}))"

    def _crossing(self, type_: Type, scope: Scope, fuel: int) -> str:
        return f"(@vertex {self.expression(type_, scope.at_vertex(), fuel)})"

    def _read(self, _type: Type, scope: Scope, fuel: int) -> str:
        name = self.draw(st.sampled_from(scope.maps))
        coordinate = self.expression(VECTORS[0], scope, fuel)
        self.textured = True
        return f"{name}({coordinate})"


SURFACE = (  # as bare numbers, which all operations take
    Variable("uv", VECTORS[0]),
    *(
        Variable(f"vec3({name})", VEC3)
        for name in ("position", "normal", "to_eye", "vertex_normal")
    ),
    Variable("p_power", FLOAT),
)
LIGHT = (
    Variable("vec3(light.to_light)", VEC3), Variable("vec3(light.diffuse)", VEC3),
    Variable("light.falloff", FLOAT),
)  # fmt: skip
RANGES: Mapping[Type, tuple[str, ...]] = {
    FLOAT: ("", "in 0..1 ", "in 0.5..4 ", "in -1..1 "),
    INT: ("", "in 0..7 ", "in 1..4 "),
    UINT: ("", "in 1..9 "),
    VEC3: ("", "in 0..1 "),
}
GROUPS = ("", "per frame ", "per view ", "per draw ")


@st.composite
def programs(draw: st.DrawFn) -> str:
    """The text of a program with one material."""
    writer = Writer(draw)
    functions = tuple(_functions(writer))
    scope = Scope(functions=tuple(row for row, _ in functions))
    parameters = tuple(_parameters(draw))
    arrays = tuple(_arrays(draw))
    shaded = replace(
        scope,
        variables=(*SURFACE, *(variable for variable, _ in parameters)),
        arrays=tuple(variable for variables, _ in arrays for variable in variables),
    )
    lines = [
        "import std.lights",
        "import std.terms",
        "struct Pair { number : float, vector : vec3 }",
    ]
    lines += [text for _, text in functions]
    lines.append(_light(writer, scope))
    lines.append(_term(writer, scope))
    lines += ["material Random {", "    param p_power : float in 1..64 = 8.0"]
    lines.append("    map m : texture2d")
    lines += [f"    {text}" for _, text in (*parameters, *arrays)]
    terms = ("ambient", "lambert", "phong", "blinn_phong", "own")
    shaded = replace(shaded, terms=terms, maps=("m",), surface=True)
    lines += [f"    {text}" for text in _slots(writer, shaded)]
    return "\n".join([*lines, "}", _rig(draw)]) + "\n"


RESULTS: tuple[Type, ...] = (FLOAT, VEC3, INT, VECTORS[0])
"""The types of functions' results."""

Row = tuple[str, tuple[Type, ...], Type]


def _functions(writer: Writer) -> Iterator[tuple[Row, str]]:
    """Functions that call earlier ones, also in the parts of their bodies."""
    known: tuple[Row, ...] = ()
    for number in range(writer.draw(st.integers(0, 3))):
        types = writer.draw(st.lists(st.sampled_from(TYPES), min_size=1, max_size=3))
        result = writer.draw(st.sampled_from(RESULTS))
        formals = tuple(Variable(f"x{i}", type_) for i, type_ in enumerate(types))
        scope, parts = Scope(formals, known), []
        for i in range(writer.draw(st.integers(0, 2))):
            part = Variable(f"part{i}", writer.draw(st.sampled_from(TYPES)))
            parts.append(f"{part.text} = {_written(writer, part.type, scope)}")
            scope = replace(scope, variables=(*scope.variables, part))
        body = writer.expression(result, scope, FUEL // 2)
        shown = ", ".join(f"{formal.text}: {formal.type}" for formal in formals)
        where = f" where {{ {'; '.join(reversed(parts))} }}" if parts else ""
        row = f"f{number}", tuple(types), result
        known = (*known, row)
        yield row, f"fn f{number}({shown}) -> {result} = {body}{where}"


def _written(writer: Writer, type_: Type, scope: Scope) -> str:
    """An expression that has its type without a context, which literals alone may not have."""
    text = writer.expression(type_, scope, FUEL // 3)
    return f"{type_}({text})" if type_ in (FLOAT, INT, UINT) else text


ELEMENTS: tuple[Type, ...] = (FLOAT, INT, VEC3, VECTORS[0], Matrix(3))
"""The types of elements of parameters that are arrays."""


def _arrays(draw: st.DrawFn) -> Iterator[tuple[tuple[Variable, ...], str]]:
    """Arrays of numbers, and of structures."""
    for number, type_ in enumerate(draw(st.lists(st.sampled_from(ELEMENTS), max_size=2))):
        limits = draw(st.sampled_from(RANGES.get(type_, ("",))))
        group, name = draw(st.sampled_from(GROUPS)), f"a{number}"
        text = f"param {name} : {type_}[{draw(st.integers(1, 4))}] {limits}{group}"
        yield (Variable(f"{name}[{{}}]", type_),), text
    if draw(st.booleans()):
        members = (Variable("pairs[{}].number", FLOAT), Variable("pairs[{}].vector", VEC3))
        yield members, f"param pairs : Pair[{draw(st.integers(1, 4))}]"


def _parameters(draw: st.DrawFn) -> Iterator[tuple[Variable, str]]:
    for number, type_ in enumerate(draw(st.lists(st.sampled_from(TYPES), max_size=5))):
        limits = draw(st.sampled_from(RANGES.get(type_, ("",))))
        group = draw(st.sampled_from(GROUPS))
        name = f"p{number}"
        yield Variable(name, type_), f"param {name} : {type_} {limits}{group}"


def _light(writer: Writer, scope: Scope) -> str:
    own = replace(
        scope, variables=(*SURFACE[1:3], Variable("q", FLOAT), Variable("vec3(place)", VEC3))
    )
    falloff = writer.expression(FLOAT, own, FUEL // 2)
    towards = writer.expression(VEC3, own, FUEL // 3)
    return (
        f"light Own : Point {{ param q : float in 0..2 = 1.0; falloff = {falloff}; "
        f"to_light = normalize({towards}) }}"
    )


def _term(writer: Writer, scope: Scope) -> str:
    own = replace(scope, variables=(Variable("k", VEC3), Variable("vec3(normal)", VEC3), *LIGHT))
    return f"term own(k: vec3) per light = {writer.expression(VEC3, own, FUEL // 2)}"


def _slots(writer: Writer, scope: Scope) -> Iterator[str]:
    for number in range(writer.draw(st.integers(0, 4))):
        type_ = writer.draw(st.sampled_from(TYPES))
        writer.textured = False
        yield f"s{number} = {writer.expression(type_, scope)}"
        slot = Variable(f"s{number}", type_, writer.textured)
        scope = replace(scope, variables=(*scope.variables, slot))
    yield f"color = {writer.expression(VEC3, scope)}"
    yield f"alpha = {writer.expression(FLOAT, scope, FUEL // 2)}"


def _rig(draw: st.DrawFn) -> str:
    lights = st.sampled_from(["Directional", "Point", "Spot", "Own"])
    counts = st.sampled_from(["", "", "[1]", "[2]", "[3]", "[<= 3]"])
    entries = draw(st.lists(st.tuples(lights, counts), min_size=1, max_size=3))
    shown = "; ".join(f"l{i} : {light}{count}" for i, (light, count) in enumerate(entries))
    return f"rig Some {{ {shown} }}"
