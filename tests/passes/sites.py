"""Random operations that simplification rules may apply to, for the patterns of the rules."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence

from burnish.compiler.ir import build, signatures
from burnish.compiler.ir.build import Number
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, FoldOperator, Formal, Graph, Iterating, Node
from burnish.compiler.ir.stages import FRAGMENT, VERTEX, Crossing
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    Array,
    Matrix,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from burnish.compiler.passes.rules.rule import ANY, CONSTANT, Pattern, Rule, Site
from burnish.frozen import changed
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNIT, UNKNOWN, Fact

FACTS = (
    UNKNOWN, Fact(0.0, 1.0), Fact(0.0, 1.0), Fact(1.0, 2.0), Fact(2.0, 3.0), Fact(-1.0, 0.0),
    Fact(-3.0, -2.0), Fact(0.5, 4.0), Fact(2.0, 2.0),
)  # fmt: skip
NUMBERS: Mapping[ScalarKind, tuple[Number, ...]] = {
    "float": (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.25, 1e-30, 3e38),
    "int": (0, 1, -1, 2, 5, 31, 32, 33, 64, -32, 2**31 - 1, -(2**31)),
    "uint": (0, 1, 2, 5, 31, 32, 33, 64, 2**32 - 1),
    "bool": (True, False),
}
ACROSS = Crossing(VERTEX.domain, FRAGMENT.domain, "perspective")
PAIR = Struct("Pair", (("a", FLOAT), ("b", Vector("float", 3))))
KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")


class UnsuitableError(Exception):
    """A random choice that does not go together with another."""


class Sites:
    """Makes operations for one rule, from a seed."""

    def __init__(self, rule: Rule, seed: int) -> None:
        self.graph = Graph()
        self._rule = rule
        self._chance = random.Random(f"{rule.name} {seed}")
        self._swapped = rule.either and self._chance.random() < 0.5
        """Whether the operation has its operands the other way round than the pattern."""
        self._loose = self._chance.random() < 0.2
        """Whether only the heads of operands are as the pattern asks, which must not be enough."""
        self._outer = Formal("outer")
        """The variable of a loop around all."""
        self._made: list[Node] = []
        """The operands so far; some are used again."""

    def operation(self, site: Site) -> Node:
        """The operation itself. The operands of ``site`` are in the order of the pattern."""
        operands = site.operands[::-1] if self._swapped else site.operands
        return self.graph.node(site.op, site.type, operands, site.data)

    def uses_outer(self, node: Node) -> bool:
        """Whether a value depends on the turn of a loop around it."""
        return self._outer in node.variables

    def summed_up(self, node: Node) -> Node:
        """The value in that loop, which can be evaluated."""
        operator: FoldOperator = "or" if node.type == BOOL else "add"
        start = self.graph.node("constant", node.type, (), _nothing(node.type))
        operands = (build.constant(self.graph, INT, 3), start, node)
        return self.graph.node("fold", node.type, operands, Folding(operator, 3, (self._outer,)))

    def site(self) -> Site:
        """An operation; raises ``UnsuitableError`` where random choices did not fit."""
        head = self._chance.choice(list(BUILTINS) if self._rule.on == ("*",) else self._rule.on)
        self._made = []
        return self._builtin(head) if head in BUILTINS else _MAKERS[head](self)

    # --- builtins --------------------------------------------------------------------------------

    def _builtin(self, name: str) -> Site:
        types, result = self._chance.choice(_typed(name))
        if self._swapped:
            types = types[::-1]
        patterns = self._patterns(len(types))
        return Site("call", result, self._operands(types, patterns), name)

    def _patterns(self, count: int) -> list[Pattern]:
        """What each operand has to look like."""
        given = self._rule.pattern
        patterns = [given] * count if isinstance(given, Pattern) else list(given)
        if len(patterns) != count:
            raise UnsuitableError
        if self._loose:
            patterns = [changed(pattern, parts=()) for pattern in patterns]
        if self._rule.some is not ANY:
            patterns[self._chance.randrange(count)] = self._rule.some
        return patterns

    def _operands(self, types: Sequence[Type], patterns: Sequence[Pattern]) -> tuple[Node, ...]:
        return tuple(map(self._value, types, patterns))

    def _value(self, type_: Type, pattern: Pattern) -> Node:
        """A value that looks like a pattern; now and then one that is there already."""
        again = [node for node in self._made if node.type == type_ and pattern.matches(node)]
        if again and self._chance.random() < 0.3:
            return self._chance.choice(again)
        node = self._new(type_, pattern)
        if node.type != type_ or not pattern.matches(node):
            raise UnsuitableError
        self._made.append(node)
        return node

    def _new(self, type_: Type, pattern: Pattern) -> Node:
        if pattern.heads is None:
            if scalar_kind(type_) and self._chance.random() < 0.2:
                return self._new(type_, CONSTANT)
            return self._leaf(type_)
        head = str(self._chance.choice(sorted(map(str, pattern.heads))))
        if head.startswith(".constant"):
            return self._constant(type_, pattern.lane)
        if head in BUILTINS:
            typed = [types for types, result in _typed(head) if result == type_]
            if not typed:
                raise UnsuitableError
            types = self._chance.choice(typed)
            parts = pattern.parts or self._chance.choices((ANY, ANY, CONSTANT), k=len(types))
            return self.graph.node("call", type_, self._operands(types, parts), head)
        return _PARTS[head](self, type_)

    def _leaf(self, type_: Type) -> Node:
        fact = self._fact(type_)
        leaf = Parameter(f"p{len(self.graph)}", type_, "material", fact)
        return self.graph.node("parameter", type_, (), leaf)

    def _fact(self, type_: Type) -> Fact:
        kind = scalar_kind(type_)
        if kind is None or kind == "bool" or isinstance(type_, Matrix):
            return UNKNOWN
        if kind == "float" and isinstance(type_, Vector) and self._chance.random() < 0.2:
            return UNIT
        fact = self._chance.choice(FACTS)
        if kind != "float" and fact != UNKNOWN:
            low = float(max(int(fact.lo), 0 if kind == "uint" else -3))
            fact = Fact(low, float(max(int(fact.hi), low)))
        return fact.as_kind(kind)

    def _constant(self, type_: Type, lane: Number | None = None) -> Node:
        kind = scalar_kind(type_)
        if isinstance(type_, Matrix) and lane is None:
            column = Vector("float", type_.size)
            columns = tuple(self._constant(column).data for _ in range(type_.size))
            return self.graph.node("constant", type_, (), columns)
        if kind is None or isinstance(type_, Matrix):
            raise UnsuitableError
        if lane is not None and isinstance(lane, bool) != (kind == "bool"):
            raise UnsuitableError
        if kind == "uint" and lane is not None and lane < 0:
            raise UnsuitableError
        same = self._chance.random() < 0.5
        numbers = [self._chance.choice(NUMBERS[kind]) for _ in range(width(type_))]
        if lane is not None:
            numbers = [float(lane) if kind == "float" else lane] * len(numbers)
        elif same:
            numbers = numbers[:1] * len(numbers)
        data = tuple(numbers) if isinstance(type_, Vector) else numbers[0]
        return build.constant(self.graph, type_, data)

    def _numeric(self, least: int = 1) -> Scalar | Vector:
        return with_width(self._chance.choice(KINDS), self._chance.randint(least, 4))

    # --- what is put together --------------------------------------------------------------------

    def _splat(self, type_: Type) -> Node:
        kind = scalar_kind(type_)
        if not isinstance(type_, Vector) or kind is None:
            raise UnsuitableError
        return build.splat(self.graph, self._value(Scalar(kind), ANY), type_.size)

    def _joined(self, type_: Type) -> Node:
        if not isinstance(type_, Vector):
            raise UnsuitableError
        first = self._chance.randint(1, type_.size - 1)
        sizes = (first, type_.size - first)
        parts = tuple(self._value(with_width(type_.kind, size), ANY) for size in sizes)
        return build.vector(self.graph, parts)

    def _swizzled(self, type_: Type) -> Node:
        kind = scalar_kind(type_)
        if kind is None or isinstance(type_, Matrix):
            raise UnsuitableError
        source = self._leaf(with_width(kind, self._chance.randint(2, 4)))
        lanes = self._lanes(width(source.type), width(type_))
        return self.graph.node("swizzle", type_, (source,), lanes)

    def _lanes(self, size: int, count: int) -> tuple[int, ...]:
        return tuple(self._chance.randrange(size) for _ in range(count))

    def _columns(self, type_: Type) -> Node:
        if not isinstance(type_, Matrix):
            raise UnsuitableError
        column = Vector("float", type_.size)
        columns = [self._leaf(column) for _ in range(type_.size)]
        if self._chance.random() < 0.3:
            columns = [build.constant(self.graph, column, unit) for unit in units(type_.size)]
        return build.matrix(self.graph, tuple(columns))

    def _elements(self, type_: Type) -> Node:
        if not isinstance(type_, Array):
            raise UnsuitableError
        same = self._chance.random() < 0.5
        one = self._leaf(type_.element)
        elements = tuple(one if same else self._leaf(type_.element) for _ in range(type_.count))
        return self.graph.node("array", type_, elements)

    def _structure(self, type_: Type) -> Node:
        if not isinstance(type_, Struct):
            raise UnsuitableError
        members = tuple(self._leaf(inner) for _, inner in type_.members)
        return self.graph.node("struct", type_, members)

    # --- operations that are no builtins ---------------------------------------------------------

    def swizzle(self) -> Site:
        """Lanes of a vector."""
        source = self._value(self._numeric(2), self._patterns(1)[0])
        size = width(source.type)
        count = self._chance.randint(1, 4)
        lanes = self._lanes(size, count)
        if self._chance.random() < 0.3:
            lanes = tuple(range(size))
        kind = scalar_kind(source.type)
        assert kind is not None
        return Site("swizzle", with_width(kind, len(lanes)), (source,), lanes)

    def vector(self) -> Site:
        """Scalars and vectors joined."""
        kind = self._chance.choice(KINDS)
        sizes = self._chance.choice([(1, 1), (1, 1, 1), (2, 1), (1, 2), (2, 2), (1, 3), (1,) * 4])
        types = [with_width(kind, size) for size in sizes]
        if self._rule.some is not ANY and self._chance.random() < 0.5:
            whole = self._leaf(with_width(kind, self._chance.randint(2, 4)))
            operands = tuple(
                build.swizzle(self.graph, whole, self._lanes(width(whole.type), size))
                for size in sizes
            )
        else:
            operands = self._operands(types, self._patterns(len(types)))
        return Site("vector", with_width(kind, sum(sizes)), operands, None)

    def splat(self) -> Site:
        """A scalar in every lane."""
        type_ = self._numeric(2)
        kind = scalar_kind(type_)
        assert kind is not None
        return Site("splat", type_, self._operands([Scalar(kind)], self._patterns(1)), None)

    def index(self) -> Site:
        """A lane, a column or an element."""
        whole: Type = self._chance.choice(
            [self._numeric(2), Matrix(self._chance.randint(2, 4)), Array(self._numeric(), 3)]
        )
        part, count = _part(whole)
        source_pattern, position_pattern = self._patterns(2)
        source = self._value(whole, source_pattern)
        number = build.constant(self.graph, INT, self._chance.randrange(count))
        fact = Fact(0.0, float(count - 1)).as_kind("int")
        anywhere = self.graph.node("parameter", INT, (), Parameter("at", INT, "material", fact))
        position = number if position_pattern.heads else anywhere
        return Site("index", part, (source, position), None)

    def member(self) -> Site:
        """A member of a structure."""
        name, type_ = self._chance.choice(PAIR.members)
        return Site("member", type_, self._operands([PAIR], self._patterns(1)), name)

    def select(self) -> Site:
        """A choice."""
        type_ = self._chance.choice([self._numeric(), BOOL, FLOAT])
        return Site("select", type_, self._operands([BOOL, type_, type_], self._patterns(3)), None)

    def crossing(self) -> Site:
        """A value that crosses."""
        return Site("cross", FLOAT, self._operands([FLOAT], self._patterns(1)), ACROSS)

    def fold(self) -> Site:
        """A loop that sums up, or the like."""
        operators: tuple[FoldOperator, ...] = ("add", "mul", "min", "max")
        logic: tuple[FoldOperator, ...] = ("and", "or")
        types: list[Type] = [FLOAT, INT, BOOL, Vector("float", 3)]
        type_ = self._chance.choice(types)
        operator = self._chance.choice(logic if type_ == BOOL else operators)
        formal, bound = Formal("i"), self._chance.choice([0, 1, 2, 3, 4, 9])
        start = self._value(type_, self._patterns(3)[1])
        return Site(
            "fold", type_, (self._count(bound), start, self._body(type_, formal)),
            Folding(operator, bound, (formal,)),
        )  # fmt: skip

    def _count(self, bound: int) -> Node:
        if self._chance.random() < 0.8:
            return build.constant(self.graph, INT, self._chance.randint(0, bound))
        fact = Fact(0.0, float(bound)).as_kind("int")
        return self.graph.node("parameter", INT, (), Parameter("n", INT, "material", fact))

    def _body(self, type_: Type, formal: Formal) -> Node:
        """A term that depends on the turn, or does not."""
        if self._chance.random() < 0.3:
            return self._constant(type_)
        variable = formal if self._chance.random() < 0.8 else self._outer
        index = self.graph.node("formal", INT, (), variable)
        two = build.constant(self.graph, INT, 2)
        if type_ == BOOL:
            return self.graph.node("call", BOOL, (index, two), "lt")
        if type_ == INT:
            return self.graph.node("call", INT, (index, two), "mul")
        number = self.graph.node("call", FLOAT, (index,), "to_float")
        other = self._leaf(FLOAT) if self._chance.random() < 0.5 else self._constant(FLOAT, 0.5)
        term = self.graph.node("call", FLOAT, (number, other), "add")
        return term if type_ == FLOAT else build.splat(self.graph, term, width(type_))

    def loop(self) -> Site:
        """A loop over states."""
        count, bound = self._chance.randint(1, 2), self._chance.choice([0, 1, 2, 3, 4, 9])
        turn, *states = formals = tuple(Formal(f"s{i}") for i in range(count + 1))
        starts = tuple(self._value(FLOAT, ANY) for _ in states)
        leaves = [self.graph.node("formal", FLOAT, (), state) for state in states]
        half = build.floating(self.graph, 0.5)
        index = self.graph.node("formal", INT, (), turn)
        number = self.graph.node("call", FLOAT, (index,), "to_float")
        nexts = tuple(
            leaf if self._chance.random() < 0.3
            else self.graph.node(
                "call", FLOAT,
                (self._chance.choice(leaves), self._chance.choice([half, number])),
                self._chance.choice(["add", "mul"]),
            )
            for leaf in leaves
        )  # fmt: skip
        going = self._chance.choice([
            build.constant(self.graph, BOOL, True),
            build.constant(self.graph, BOOL, False),
            self.graph.node("call", BOOL, (leaves[0], half), "gt"),
        ])  # fmt: skip
        type_ = build.states_type([FLOAT] * count)
        operands = (self._count(bound), *starts, going, *nexts)
        return Site("iterate", type_, operands, Iterating(bound, count, formals))


_MAKERS: Mapping[str, Callable[[Sites], Site]] = {
    ".swizzle": Sites.swizzle,
    ".vector": Sites.vector,
    ".splat": Sites.splat,
    ".index": Sites.index,
    ".member": Sites.member,
    ".select": Sites.select,
    ".cross": Sites.crossing,
    ".fold": Sites.fold,
    ".iterate": Sites.loop,
}
_PARTS: Mapping[str, Callable[[Sites, Type], Node]] = {
    ".splat": Sites._splat,
    ".vector": Sites._joined,
    ".swizzle": Sites._swizzled,
    ".matrix": Sites._columns,
    ".array": Sites._elements,
    ".struct": Sites._structure,
}


def _nothing(type_: Type) -> Number | tuple[Number, ...]:
    """What a sum of values of this type begins with."""
    zero: Number = {"float": 0.0, "bool": False}.get(str(scalar_kind(type_)), 0)
    return (zero,) * width(type_) if isinstance(type_, Vector) else zero


def _part(whole: Type) -> tuple[Type, int]:
    """What indexing gives, and how many of these there are."""
    match whole:
        case Array(element=element, count=count):
            return element, count
        case Matrix(size=size):
            return Vector("float", size), size
        case Vector(kind=kind, size=size):
            return Scalar(kind), size
        case _:
            raise UnsuitableError


def _typed(name: str) -> list[tuple[tuple[Type, ...], Type]]:
    """Each way to type a builtin: its operands and its result."""
    if name not in _TYPED:
        _TYPED[name] = [
            (types, result)
            for types in dict.fromkeys(_operand_types(name))
            if (result := signatures.result_type(name, types)) is not None
        ]
    if not _TYPED[name]:
        raise UnsuitableError
    return _TYPED[name]


_TYPED: dict[str, list[tuple[tuple[Type, ...], Type]]] = {}


def _operand_types(name: str) -> Iterator[tuple[Type, ...]]:
    for signature in BUILTINS[name].signatures:
        words, _result = signatures.parsed(signature)
        for free in _free_types(words):
            bound = dict(free)
            for word in words:
                found = bound.get(word) or signatures.FIXED.get(word)
                found = found or signatures.dependent(word, bound)
                if found is None:
                    break
                bound[word] = found
            else:
                yield tuple(bound[word] for word in words)


def _free_types(words: Sequence[str]) -> Iterator[dict[str, Type]]:
    """What the letters of a signature may stand for that do not follow from others."""
    letters = [w for w in dict.fromkeys(words) if w in signatures.FAMILIES or w == "M"]
    choices: list[dict[str, Type]] = [{}]
    for letter in letters:
        types: Sequence[Type] = (
            [Matrix(size) for size in (2, 3, 4)]
            if letter == "M"
            else signatures.FAMILIES[letter].types()
        )
        choices = [{**chosen, letter: type_} for chosen in choices for type_ in types]
    yield from choices


def units(size: int) -> list[tuple[float, ...]]:
    """The columns of the identity."""
    return [tuple(float(row == column) for row in range(size)) for column in range(size)]
