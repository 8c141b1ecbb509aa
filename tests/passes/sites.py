"""Random operations that simplification rules may apply to, made from their left sides."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Number, Parameter
from burnish.compiler.ir.node import (
    Folding,
    FoldOperator,
    Formal,
    Iterating,
    Node,
)
from burnish.compiler.ir.stages import FRAGMENT, VERTEX, Crossing
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    MATRICES,
    Array,
    Scalar,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from burnish.compiler.passes.rules.matching import heads_of, orders
from burnish.compiler.passes.rules.rule import Rule
from burnish.compiler.passes.rules.terms import (
    Operation,
    Several,
    Term,
    Uniform,
    Variable,
)
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import Fact

from .random_values import KINDS, PAIR, RandomValues
from .typings import UnsuitableError, part, typed

ACROSS = Crossing(VERTEX.domain, FRAGMENT.domain, "perspective")


class Sites(RandomValues):
    """Makes an operation for one rule, from a seed."""

    def __init__(self, rule: Rule, seed: int) -> None:
        super().__init__(f"{rule.name} {seed}")
        left, _right = self._chance.choice(rule.equations)
        self._left: Operation = self._chance.choice(list(orders(left)))
        self._loose = self._chance.random() < 0.2
        """True if only the heads of operands are as the rule asks, which must not be enough."""
        self._outer = Formal("outer")
        """The variable of a loop around all."""
        self._named: dict[str, Node] = {}
        """The values of the rule's variables, by their names."""

    def operation(self) -> Node:
        """An operation; raises ``UnsuitableError`` where random choices did not fit."""
        head = self._chance.choice(self._left.function.heads)
        return self._builtin(head) if head in BUILTINS else _MAKERS[head](self)

    def uses_outer(self, node: Node) -> bool:
        """True if a value depends on the iteration of a loop around it."""
        return self._outer in node.variables

    def summed_up(self, node: Node) -> Node:
        """The value in that loop, which can be evaluated."""
        operator: FoldOperator = "or" if node.type == BOOL else "add"
        start = self.graph.node("constant", node.type, (), _nothing(node.type))
        operands = (build.constant(self.graph, INT, 3), start, node)
        return self.graph.node("fold", node.type, operands, Folding(operator, 3, (self._outer,)))

    # --- operands --------------------------------------------------------------------------------

    def _builtin(self, name: str) -> Node:
        types, result = self._chance.choice(typed(name))
        return self.graph.node("call", result, self._operands(types), name)

    def _operands(self, types: Sequence[Type]) -> tuple[Node, ...]:
        """Operands that look like the terms of the left side."""
        terms = self._terms(self._left, len(types))
        if self._loose:
            terms = [Variable("", heads_of(term)) for term in terms]
        return tuple(map(self._value, types, terms))

    def _terms(self, operation: Operation, count: int) -> list[Term]:
        """One term for each operand."""
        terms = list(operation.operands)
        if terms and isinstance(rest := terms[-1], Several):
            terms[-1:] = [Variable("", rest.every) for _ in range(count - len(terms) + 1)]
            if rest.some is not None and terms:
                terms[self._chance.randrange(len(terms))] = Variable("", rest.some)
        if len(terms) != count:
            raise UnsuitableError
        return terms

    def _value(self, type_: Type, term: Term) -> Node:
        """A value that looks like a term; now and then one that is there already."""
        match term:
            case Variable(name=name, heads=heads):
                node = self._named.get(name) or self._any(type_, heads)
                if name:
                    self._named[name] = node
            case Uniform(value=number):
                node = self._constant(type_, number)
            case Operation():
                node = self._operation(type_, term)
            case _:
                raise TypeError(term)
        heads = heads_of(term)
        if node.type != type_ or not (heads is None or node.head in heads):
            raise UnsuitableError
        self._made.append(node)
        return node

    def _operation(self, type_: Type, term: Operation) -> Node:
        """A value that looks like an operation of terms."""
        head = self._chance.choice(term.function.heads)
        if head in BUILTINS:
            types = self._types(type_, head)
            operands = tuple(map(self._value, types, self._terms(term, len(types))))
            node = self.graph.node("call", type_, operands, head)
        else:
            node = self._with_head(type_, head)
        if term.label is not None:
            self._named[term.label.name] = node
        return node

    # --- operations that are no builtins ---------------------------------------------------------

    def swizzle(self) -> Node:
        """Lanes of a vector."""
        (source,) = self._operands([self._numeric(2)])
        size = width(source.type)
        count = self._chance.randint(1, 4)
        lanes = self._lanes(size, count)
        if self._chance.random() < 0.3:
            lanes = tuple(range(size))
        kind = scalar_kind(source.type)
        assert kind is not None
        return self.graph.node("swizzle", with_width(kind, len(lanes)), (source,), lanes)

    def vector(self) -> Node:
        """Scalars and vectors joined."""
        kind = self._chance.choice(KINDS)
        sizes = self._chance.choice([(1, 1), (1, 1, 1), (2, 1), (1, 2), (2, 2), (1, 3), (1,) * 4])
        if self._chance.random() < 0.3:
            whole = self._leaf(with_width(kind, self._chance.randint(2, 4)))
            operands = tuple(
                build.swizzle(self.graph, whole, self._lanes(width(whole.type), size))
                for size in sizes
            )
        else:
            operands = self._operands([with_width(kind, size) for size in sizes])
        return self.graph.node("vector", with_width(kind, sum(sizes)), operands)

    def splat(self) -> Node:
        """A scalar in every lane."""
        type_ = self._numeric(2)
        kind = scalar_kind(type_)
        assert kind is not None
        return self.graph.node("splat", type_, self._operands([Scalar(kind)]))

    def index(self) -> Node:
        """A lane, a column or an element."""
        whole: Type = self._chance.choice(
            [self._numeric(2), self._chance.choice(MATRICES), Array(self._numeric(), 3)]
        )
        element, count = part(whole)
        source_term, position_term = self._terms(self._left, 2)
        source = self._value(whole, source_term)
        number = build.constant(self.graph, INT, self._chance.randrange(count))
        fact = Fact(0.0, float(count - 1)).as_kind("int")
        anywhere = self.graph.node(
            "parameter", INT, (), Parameter("at", INT, "material", fact=fact)
        )
        position = anywhere if heads_of(position_term) is None else number
        return self.graph.node("index", element, (source, position))

    def member(self) -> Node:
        """A member of a structure."""
        name, type_ = self._chance.choice(PAIR.members)
        return self.graph.node("member", type_, self._operands([PAIR]), name)

    def select(self) -> Node:
        """A choice."""
        type_ = self._chance.choice([self._numeric(), BOOL, FLOAT])
        return self.graph.node("select", type_, self._operands([BOOL, type_, type_]))

    def crossing(self) -> Node:
        """A value that crosses."""
        return self.graph.node("cross", FLOAT, self._operands([FLOAT]), ACROSS)

    def fold(self) -> Node:
        """A loop that sums up, or the like."""
        operators: tuple[FoldOperator, ...] = ("add", "mul", "min", "max")
        logic: tuple[FoldOperator, ...] = ("and", "or")
        types: list[Type] = [FLOAT, INT, BOOL, Vector("float", 3)]
        type_ = self._chance.choice(types)
        operator = self._chance.choice(logic if type_ == BOOL else operators)
        formal, bound = Formal("i"), self._chance.choice([0, 1, 2, 3, 4, 9])
        start = self._value(type_, self._left.operands[1])
        return self.graph.node(
            "fold", type_, (self._count(bound), start, self._body(type_, formal)),
            Folding(operator, bound, (formal,)),
        )  # fmt: skip

    def _count(self, bound: int) -> Node:
        if self._chance.random() < 0.8:
            return build.constant(self.graph, INT, self._chance.randint(0, bound))
        fact = Fact(0.0, float(bound)).as_kind("int")
        return self.graph.node("parameter", INT, (), Parameter("n", INT, "material", fact=fact))

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

    def loop(self) -> Node:
        """A loop over states."""
        count, bound = self._chance.randint(1, 2), self._chance.choice([0, 1, 2, 3, 4, 9])
        turn, *states = formals = tuple(Formal(f"s{i}") for i in range(count + 1))
        starts = tuple(self._any(FLOAT, None) for _ in states)
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
        return self.graph.node("iterate", type_, operands, Iterating(bound, count, formals))


_MAKERS: Mapping[str, Callable[[Sites], Node]] = {
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


def _nothing(type_: Type) -> Number | tuple[Number, ...]:
    """The initial value of a sum of values of this type."""
    zero: Number = {"float": 0.0, "bool": False}.get(str(scalar_kind(type_)), 0)
    return (zero,) * width(type_) if isinstance(type_, Vector) else zero
