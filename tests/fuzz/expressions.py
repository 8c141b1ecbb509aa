"""Writes random expressions of a given type."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from random import Random

from .rules import BOOLS, FLOATS, GEOMETRIC, INTS, MATRICES, NUMBERS, UINTS, Rule, rules_of
from .scope import CROSSING, Map, Scope, Signature, element_of, local
from .textures import KINDS, Read, reads_of
from .tree import Node, expression, walk

FUEL = 12
"""The approximate number of operations of one expression."""

FLOAT_LITERALS = ("0.0", "1.0", "0.5", "2.0", "0.25", "3.0", "1e-3", "7.5", "0.7", "0.125")
INT_LITERALS = (0, 1, 2, 3, 7)
WILD_LITERALS = {
    "float": ("1e10", "3.4e38", "1e-30", "1e-40", "16777216.0", "2147483648.0", "9.3e18"),
    "int": ("2147483647", "-2147483647", "0x10000", "31", "33"),
    "uint": ("4294967295u", "0x80000000u", "31u", "2147483648u"),
}
"""Numbers at which types end, and beyond which conversions are clamped."""

USUAL = frozenset(
    {"add", "sub", "mul", "div", "mix", "min", "max", "clamp", "saturate", "dot", "abs", "floor",
     "fract", "length", "normalize", "smoothstep", "sqrt", "sin", "cos", "pow", "lt", "gt", "and",
     "or", "constructor", "swizzle"}
)  # fmt: skip
"""The roles that programs mostly consist of."""
WEIGHTS = {"meaning": 12, "rare meaning": 12}
"""The weights of roles that stand for many forms; they are chosen more often."""
STEEP = frozenset(
    {"exp", "exp2", "sinh", "cosh", "pow", "tan", "ldexp", "float_of_bits", "inversesqrt", "div",
     "product", "inverse", "log", "log2", "log10", "mod", "determinant", "unpack_half2x16"}
)  # fmt: skip
"""The roles that make large numbers of small ones."""


def is_constant(node: Node) -> bool:
    """True if the compiler can compute the value: no part of it comes from outside the program."""
    outside = ("variable", "local", "read")
    return not node.needs and all(part.role not in outside for _, part in walk(node))


@dataclass
class Writer:
    """Writes random expressions."""

    chance: Random
    structures: dict[str, tuple[tuple[str, str], ...]] = field(default_factory=dict)
    """The members of each structure: names and types."""
    enumerations: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """The members of each enumeration."""
    wild: bool = False
    """True if numbers may become arbitrarily large or small."""
    _names: int = field(default=0, init=False)

    def fresh(self, letter: str) -> str:
        """A name that nothing else in the program has."""
        self._names += 1
        return f"{letter}{self._names}"

    def maybe(self, probability: float) -> bool:
        """True with this probability."""
        return self.chance.random() < probability

    def expression(self, type_: str, scope: Scope, fuel: int = FUEL) -> Node:
        """An expression of a type."""
        if fuel <= 0:
            return self.leaf(type_, scope)
        ways: list[tuple[int, Callable[[str, Scope, int], Node]]] = [
            (2, self._plain_leaf), (2, self._conditional),
        ]  # fmt: skip
        if rules_of(type_):
            ways.append((12, self._by_rule))
        if any(each.result == type_ for each in scope.callables):
            ways.append((4, self._call))
        if scope.arrays(type_):
            ways.append((3, self._element))
        if type_ in NUMBERS or type_ in BOOLS or type_ in MATRICES or type_ in self.structures:
            ways += [(1, self._iterate), (1, self._of_array)]
        if type_ in NUMBERS:
            ways.append((2, self._fold))
        if type_ == "bool":
            ways.append((1, self._any))
        if self.enumerations and type_ in ("bool", "int"):
            ways.append((2, self._of_enumeration))
        if any(type_ == kind for members in self.structures.values() for _, kind in members):
            ways.append((1, self._member))
        if CROSSING in scope.can and (type_ in NUMBERS or type_ in BOOLS):
            ways.append((1, self._crossing))
        if any(reads_of(each.type, type_) for each in scope.maps):
            ways.append((5, self._read))
        weights = [weight for weight, _ in ways]
        (way,) = self.chance.choices([way for _, way in ways], weights)
        return way(type_, scope, fuel - 1)

    # --- leaves ----------------------------------------------------------------------------------

    def leaf(self, type_: str, scope: Scope) -> Node:
        """A variable, or the simplest that has the type."""
        known = scope.of(type_)
        if known and self.maybe(0.75):
            return self.chance.choice(known)
        return self.literal(type_, scope)

    def _plain_leaf(self, type_: str, scope: Scope, _fuel: int) -> Node:
        return self.leaf(type_, scope)

    def literal(self, type_: str, scope: Scope) -> Node:
        """A literal, or an expression of leaves for a type that has no literals."""
        if self.wild and type_ in WILD_LITERALS and self.maybe(0.15):
            text = self.chance.choice(WILD_LITERALS[type_])
            return expression(type_, f"({text})" if text[0] == "-" else text, role="literal")
        match type_:
            case "float":
                return expression(type_, self.chance.choice(FLOAT_LITERALS), role="literal")
            case "int":
                return expression(type_, str(self.chance.choice(INT_LITERALS)), role="literal")
            case "uint":
                text = f"{self.chance.choice((0, 1, 2, 5))}u"
                return expression(type_, text, role="literal")
            case "bool":
                return expression(type_, self.chance.choice(("true", "false")), role="literal")
        if type_ in self.enumerations:
            member = self.chance.choice(self.enumerations[type_])
            return expression(type_, f"{type_}.{member}", role="named")
        if type_ in GEOMETRIC:
            return self._simplest_meaning(type_, scope)
        if type_ in self.structures:
            members = [self.leaf(kind, scope) for _, kind in self.structures[type_]]
            return _called(type_, type_, members, "structure")
        if element := element_of(type_):
            count = int(type_[len(element) + 1 : -1])
            return self._array(type_, [self.leaf(element, scope) for _ in range(count)])
        if type_ in MATRICES:
            columns = [self.leaf(f"vec{type_[-1]}", scope) for _ in range(int(type_[3]))]
            return _called(type_, type_, columns, "constructor")
        kind = next(kinds[0] for kinds in (FLOATS, INTS, UINTS, BOOLS) if type_ in kinds)
        lanes = [self.leaf(kind, scope) for _ in range(int(type_[-1]))]
        return _called(type_, type_, lanes, "constructor")

    def _simplest_meaning(self, type_: str, scope: Scope) -> Node:
        rules = [rule for rule in rules_of(type_)["meaning"] if rule.needs <= scope.can]
        found = [rule for rule in rules if not {*rule.operands} & {*GEOMETRIC}] or rules
        rule = self.chance.choice(found)
        parts = [self.leaf(operand, scope) for operand in rule.operands]
        return expression(type_, rule.form, parts, rule.role, rule.needs)

    def pinned(self, node: Node) -> Node:
        """The node with its type written, as a literal would adapt its type to its place."""
        if node.type in ("float", "int", "uint"):
            return expression(node.type, f"{node.type}({{}})", [node], "constructor")
        return node

    # --- by the tables ---------------------------------------------------------------------------

    def _by_rule(self, type_: str, scope: Scope, fuel: int) -> Node:
        by_role = {
            role: found
            for role, rules in rules_of(type_).items()
            if (found := [rule for rule in rules if rule.needs <= scope.can])
        }
        if not by_role:
            return self.leaf(type_, scope)
        weights = [WEIGHTS.get(role, 4 if role in USUAL else 1) for role in by_role]
        (role,) = self.chance.choices([*by_role], weights)
        rule = self.chance.choice(by_role[role])
        parts = self._operands(rule, scope, fuel)
        made = expression(type_, rule.form, parts, rule.role, rule.needs)
        if self.wild and role in ("div", "sqrt", "normalize", "pow", "log") and self.maybe(0.05):
            return expression(type_, "unguarded({})", [made], "unguarded")
        return made

    def _operands(self, rule: Rule, scope: Scope, fuel: int) -> list[Node]:
        share = fuel // max(1, len(rule.operands))
        parts = [self.expression(operand, scope, share) for operand in rule.operands]
        if rule.role in ("div", "mod") and is_constant(parts[1]):
            # A divisor that is always zero is an error.
            parts[1] = expression(parts[1].type, f"{parts[1].type}(3)", role="constructor")
        if rule.role == "index" and len(parts) > 1 and is_constant(parts[1]):
            parts[1] = expression("int", self.chance.choice("01"), role="literal")
        if self.wild or rule.role not in STEEP:
            return parts
        tamed = {"div": self._away_from_zero, "mod": self._away_from_zero}
        tame = tamed.get(rule.role, self._small)
        return [
            tame(part) if part.type in FLOATS and (index or rule.role not in tamed) else part
            for index, part in enumerate(parts)
        ]

    def _small(self, node: Node) -> Node:
        return expression(node.type, "clamp({}, -2.0, 2.0)", [node], "tamed")

    def _away_from_zero(self, node: Node) -> Node:
        return expression(node.type, "(0.25 + abs({}))", [node], "tamed")

    # --- forms of their own ----------------------------------------------------------------------

    def _conditional(self, type_: str, scope: Scope, fuel: int) -> Node:
        if self.enumerations and self.maybe(0.3):
            return self._between_members(type_, scope, fuel)
        condition = self.expression("bool", scope, fuel // 3)
        sides = [self.expression(type_, scope, fuel // 3) for _ in range(2)]
        if type_ in INTS[:1] + UINTS[:1] + FLOATS[:1]:
            sides[0] = self.pinned(sides[0])
        return expression(type_, "(if {} then {} else {})", [condition, *sides], "if")

    def _call(self, type_: str, scope: Scope, fuel: int) -> Node:
        callables = [each for each in scope.callables if each.result == type_]
        allowed = [each for each in callables if each.needs <= scope.can]
        if not allowed:
            return self.leaf(type_, scope)
        chosen = self.chance.choice(allowed)
        share = fuel // max(1, len(chosen.formals))
        given = [self._argument(each, scope, share) for each in chosen.formals]
        parts = [part for part in given if part is not None]
        if len(parts) < len(given):
            return self.leaf(type_, scope)
        by_name = chosen.names and self.maybe(0.3)
        made = (
            self._called_by_name(chosen, parts)
            if by_name
            else _called(type_, chosen.name, parts, "call")
        )
        return replace(made, needs=made.needs | chosen.needs, name=chosen.name)

    def _called_by_name(self, chosen: Signature, given: Sequence[Node]) -> Node:
        """A call that names its last arguments, and leaves out some of those with a default."""
        first = self.chance.randint(0, len(given))
        named = list(range(first, len(given)))
        self.chance.shuffle(named)
        needed = len(given) - chosen.optional
        named = [number for number in named if number < needed or self.maybe(0.5)]
        places = [*range(first), *named]
        texts = ["{}"] * first + [f"{chosen.names[number]} = {{}}" for number in named]
        form = f"{chosen.name}({', '.join(texts)})"
        return expression(chosen.result, form, [given[n] for n in places], "call by name")

    def _argument(self, type_: str, scope: Scope, fuel: int) -> Node | None:
        """An argument of a function; ``None`` if it has to be a texture, and there is none."""
        if type_ not in KINDS:
            return self.pinned(self.expression(type_, scope, fuel))
        fitting = [each for each in scope.maps if each.type == type_]
        if not fitting:
            return None
        chosen = self.chance.choice(fitting)
        return expression(type_, chosen.name, role="read", name=chosen.name)

    def _member(self, type_: str, scope: Scope, fuel: int) -> Node:
        owners = [
            (owner, name)
            for owner, members in self.structures.items()
            for name, kind in members
            if kind == type_
        ]
        owner, name = self.chance.choice(owners)
        return expression(type_, f"{{}}.{name}", [self.expression(owner, scope, fuel)], "member")

    def _between_members(self, type_: str, scope: Scope, fuel: int) -> Node:
        """A value for each member, in any order."""
        name = self.chance.choice(list(self.enumerations))
        names = self.chance.sample(self.enumerations[name], k=len(self.enumerations[name]))
        values = [self.pinned(self.expression(type_, scope, fuel // 3)) for _ in names]
        of = self.expression(name, scope, fuel // 3)
        form = f"choose({{}}, {', '.join(f'{each} = {{}}' for each in names)})"
        return expression(type_, form, [of, *values], "choose")

    def _of_enumeration(self, type_: str, scope: Scope, fuel: int) -> Node:
        """The number of a member, or a comparison of two."""
        name = self.chance.choice(list(self.enumerations))
        members = [self.expression(name, scope, fuel // 2) for _ in range(2)]
        if type_ == "int":
            return expression(type_, "int({})", members[:1], "numbered")
        form = f"({{}} {self.chance.choice(('==', '!='))} {{}})"
        return expression(type_, form, members, "compared")

    def _crossing(self, type_: str, scope: Scope, fuel: int) -> Node:
        inner = self.expression(type_, scope.at_vertices(), fuel)
        return expression(type_, "(@vertex ({}))", [inner], "crossing")

    # --- arrays ----------------------------------------------------------------------------------

    def _element(self, type_: str, scope: Scope, fuel: int) -> Node:
        array = self.chance.choice(scope.arrays(type_))
        indices = [leaf for leaf in scope.of("int") if leaf.role == "local"]
        if indices and self.maybe(0.6):
            return expression(type_, "{}[{}]", [array, self.chance.choice(indices)], "index")
        index = self.expression("int", scope, fuel // 3)
        form = self.chance.choice(("{}[{} mod " + array.type[len(type_) + 1 : -1] + "]", "{}[{}]"))
        if index.role == "literal":
            form = "{}[clamp({}, 0, 0)]"
        return expression(type_, form, [array, index], "index")

    def _of_array(self, type_: str, scope: Scope, fuel: int) -> Node:
        count = self.chance.randint(1, 3)
        elements = [self.expression(type_, scope, fuel // count) for _ in range(count)]
        array = self._array(f"{type_}[{count}]", elements)
        index = self.expression("int", scope, 0)
        return expression(type_, f"{{}}[({{}}) mod {count}]", [array, index], "index")

    def _array(self, type_: str, elements: Sequence[Node]) -> Node:
        places = ", ".join("{}" for _ in elements)
        return expression(type_, f"[{places}]", map(self.pinned, elements), "array")

    # --- loops -----------------------------------------------------------------------------------

    def _fold(self, type_: str, scope: Scope, fuel: int) -> Node:
        name = self.fresh("i")
        word = self.chance.choice(("sum", "product", "min", "max"))
        header, parts, alike = self._range(scope, most=5 if word == "sum" else 3)
        start = ""
        if word in ("min", "max") or self.maybe(0.3):
            start = " from {}"
            parts.append(self.pinned(self.expression(type_, scope, fuel // 4)))
        index = local(name, "int")
        inner = scope.having(index) if alike else scope.turning(index)
        body = self.pinned(self.expression(type_, inner, fuel // 2))
        if word == "product" and not self.wild and type_ in FLOATS:
            body = self._small(body)
        form = f"({word} {name} in {header}{start} : {{}})"
        return expression(type_, form, [*parts, body], "fold", binds=[name], name=name)

    def _range(self, scope: Scope, most: int) -> tuple[str, list[Node], bool]:
        """A range in words, its operands, and whether all pixels have the same number of turns."""
        end = self.chance.randint(0, most)
        match self.chance.randrange(5):
            case 0:
                return f"0..clamp({{}}, 0, {end})", [self.leaf("int", scope)], False
            case 1:
                return f"0..{{}} up to {end}", [self.leaf("int", scope)], False
            case 2:
                start = self.expression("int", scope, 1)
                return f"{{}}..{{}} up to {end}", [start, self.leaf("int", scope)], False
            case _:
                return f"{self.chance.choice((0, 0, 1, -1))}..{end}", [], True

    def _any(self, type_: str, scope: Scope, fuel: int) -> Node:
        name = self.fresh("i")
        word = self.chance.choice(("any", "all"))
        header, parts, _alike = self._range(scope, most=4)
        body = self.expression("bool", scope.turning(local(name, "int")), fuel // 2)
        form = f"({word} {name} in {header} : {{}})"
        return expression(type_, form, [*parts, body], "fold", binds=[name], name=name)

    def _iterate(self, type_: str, scope: Scope, fuel: int) -> Node:
        state, index = self.fresh("x"), self.fresh("i")
        first = self.pinned(self.expression(type_, scope, fuel // 4))
        turns = f" up to {self.chance.randint(0, 6)}"
        names, parts, inner = [state], [first], scope.turning(local(state, type_))
        if self.maybe(0.6):
            header, operands, _alike = self._range(scope, most=6)
            turns, names = f" for {index} in {header}", [state, index]
            parts, inner = [*parts, *operands], inner.having(local(index, "int"))
        going = ""
        if self.maybe(0.4):
            going = " while {}"
            parts.append(self.expression("bool", inner, fuel // 4))
        body = self.pinned(self.expression(type_, inner, fuel // 2))
        form = f"(iterate {state} from {{}}{turns}{going} : {{}})"
        return expression(type_, form, [*parts, body], "iterate", binds=names)

    # --- textures --------------------------------------------------------------------------------

    def _read(self, type_: str, scope: Scope, fuel: int) -> Node:
        ways: list[tuple[Map, Read]] = [
            (each, read)
            for each in scope.maps
            for read in reads_of(each.type, type_)
            if read.needs <= scope.can
        ]
        if not ways:
            return self.leaf(type_, scope)
        chosen, read = self.chance.choice(ways)
        share = fuel // max(1, len(read.operands))
        parts = [self.expression(operand, scope, share) for operand in read.operands]
        return expression(
            type_, chosen.name + read.form, parts, "read", read.needs, name=chosen.name
        )


def _called(type_: str, name: str, parts: Sequence[Node], role: str) -> Node:
    places = ", ".join("{}" for _ in parts)
    return expression(type_, f"{name}({places})", parts, role)
