"""Rewrites random programs into others that mean the same.

Each rewriting is tried at a random node, or at the whole file. Its result may be refused where the
original is not: with a constant in place of a value that is known later, a mistake comes to light.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from random import Random

from .rules import BOOLS, FLOATS, INTS, NUMBERS, UINTS
from .tree import Node, Path, changed, expression, listed, substituted, walk

Rewriting = Callable[[Node, Random], Node | None]
"""Makes a program of a program; ``None`` if it finds no place."""

COMMUTATIVE = frozenset(
    {"add", "mul", "min", "max", "and", "or", "eq", "ne", "dot", "distance", "bit_and", "bit_or",
     "bit_xor", "hadamard"}
)  # fmt: skip
MIRRORED = {"lt": ">", "gt": "<", "le": ">=", "ge": "<="}
OPPOSITE = {"lt": ">=", "gt": "<=", "le": ">", "ge": "<", "eq": "!=", "ne": "=="}

NEUTRAL: Mapping[tuple[str, ...], tuple[str, ...]] = {
    FLOATS: ("({} + 0.0)", "(1.0 * {})", "(-(-{}))", "({} / 1.0)", "({} - 0.0)"),
    INTS: ("({} + 0)", "({} ^ 0)", "(~(~{}))", "(1 * {})", "({} << 0)", "(-(-{}))", "({} | 0)"),
    UINTS: ("({} + 0u)", "({} ^ 0u)", "(~(~{}))", "({} >> 0u)", "({} | 0u)"),
    BOOLS: ("(not (not {}))", "({} and true)", "(false or {})"),
}
"""The operations that may be written around a value of a type without changing it."""


def _chosen(tree: Node, chance: Random, fits: Callable[[Node], bool]) -> tuple[Path, Node] | None:
    """A random node, among those that fit."""
    found = [(path, node) for path, node in walk(tree) if fits(node)]
    return chance.choice(found) if found else None


def _at(
    tree: Node, chance: Random, fits: Callable[[Node], bool], change: Callable[[Node], Node | None]
) -> Node | None:
    """The tree with a change at a random node that fits."""
    chosen = _chosen(tree, chance, fits)
    return None if chosen is None else changed(tree, chosen[0], change)


# --- one expression ------------------------------------------------------------------------------


def _swap_operands(tree: Node, chance: Random) -> Node | None:
    """``a + b`` becomes ``b + a``."""

    def fits(node: Node) -> bool:
        alike = len(node.parts) == 2 and node.parts[0].type == node.parts[1].type
        matrices = alike and node.role == "mul" and node.parts[0].type.startswith("mat")
        return alike and node.role in COMMUTATIVE and not matrices

    return _at(tree, chance, fits, lambda node: replace(node, parts=node.parts[::-1]))


def _mirror_comparison(tree: Node, chance: Random) -> Node | None:
    """``a < b`` becomes ``b > a``."""

    def change(node: Node) -> Node:
        return replace(node, form=f"({{}} {MIRRORED[node.role]} {{}})", parts=node.parts[::-1])

    return _at(tree, chance, lambda node: node.role in MIRRORED, change)


def _negate_comparison(tree: Node, chance: Random) -> Node | None:
    """``a < b`` becomes ``not (a >= b)``."""

    def change(node: Node) -> Node:
        return replace(node, form=f"(not ({{}} {OPPOSITE[node.role]} {{}}))")

    return _at(tree, chance, lambda node: node.role in OPPOSITE, change)


def _turn_choice(tree: Node, chance: Random) -> Node | None:
    """``if c then a else b`` becomes ``if not c then b else a``."""

    def change(node: Node) -> Node:
        condition, then, otherwise = node.parts
        negated = expression(condition.type, "(not {})", [condition], "not")
        return replace(node, parts=(negated, otherwise, then))

    def fits(node: Node) -> bool:
        scalar = node.role == "choose" and node.parts[0].type == "bool"
        return node.role == "if" or (scalar and node.parts[1].type == node.parts[2].type)

    return _at(tree, chance, fits, change)


def _add_nothing(tree: Node, chance: Random) -> Node | None:
    """``x`` becomes ``x + 0``."""

    def change(node: Node) -> Node:
        forms = next(forms for types, forms in NEUTRAL.items() if node.type in types)
        form = chance.choice(forms)
        return expression(node.type, form, [_pinned(node)], "nothing")

    return _at(tree, chance, _is_number, change)


def _choose_alike(tree: Node, chance: Random) -> Node | None:
    """``x`` becomes ``if c then x else x``, with a condition that is known late."""

    def change(node: Node) -> Node:
        condition = Node("(ambient_light.x > 0.3)", type="bool", role="variable")
        return expression(node.type, "(if {} then {} else {})", [condition, node, node], "if")

    def fits(node: Node) -> bool:
        return _is_number(node) and "surface" in node.needs

    return _at(tree, chance, fits, change)


def _is_number(node: Node) -> bool:
    return node.type in NUMBERS or node.type in BOOLS


def _pinned(node: Node) -> Node:
    """The value with its type, even if it is a literal."""
    return replace(
        expression(node.type, f"{node.type}({{}})", [node], "constructor"), needs=node.needs
    )


# --- loops ---------------------------------------------------------------------------------------

_CONSTANT_SUM = re.compile(r"\((sum|product) \w+ in (-?\d+)\.\.(\d+) : \{\}\)")


def _unroll(tree: Node, chance: Random) -> Node | None:
    """``sum i in 0..2 : e`` becomes ``e[0] + e[1]``."""

    def change(node: Node) -> Node:
        matched = _CONSTANT_SUM.fullmatch(node.form)
        assert matched
        word, start, end = matched.groups()
        turns = [
            substituted(node.parts[0], "local", {node.name: _pinned(_whole(i))})
            for i in range(int(start), int(end))
        ]
        operator, role = (" + ", "add") if word == "sum" else (" * ", "mul")
        places = operator.join("{}" for _ in turns)
        return expression(node.type, f"({places})", turns, role if len(turns) == 2 else "turns")

    def fits(node: Node) -> bool:
        matched = _CONSTANT_SUM.fullmatch(node.form)
        return matched is not None and int(matched[2]) < int(matched[3])

    return _at(tree, chance, fits, change)


def _whole(number: int) -> Node:
    return expression("int", str(number) if number >= 0 else f"({number})", role="literal")


# --- names ---------------------------------------------------------------------------------------


def _name_value(tree: Node, chance: Random) -> Node | None:
    """``f(x)`` becomes ``y = x`` and ``f(y)``, in a material."""
    members = [(path, node) for path, node in walk(tree) if node.role == "members"]
    inside = [
        (path, (*place, *rest), node)
        for path, member in members
        for place, slot in ((((*path, i)), part) for i, part in enumerate(member.parts))
        if slot.role == "slot"
        for rest, node in walk(slot)
        if node.type and node.parts and not _is_bound(node)
    ]
    if not inside:
        return None
    owner, place, node = chance.choice(inside)
    slot = Node(f"named_value : {node.type} = {{}}", (node,), role="slot", name="named_value")
    reference = expression(node.type, "named_value", role="variable", needs=node.needs)
    tree = changed(tree, place, lambda _: reference)
    return changed(tree, owner, lambda old: replace(old, parts=(*old.parts, slot)))


def _is_bound(node: Node) -> bool:
    """True if a value depends on a name that a loop or a function binds."""
    return any(need.startswith("local ") for need in node.needs)


def _extract_function(tree: Node, chance: Random) -> Node | None:
    """``e`` becomes ``fn g(a) = e`` and ``g(a)``, for an expression of variables alone."""

    def fits(node: Node) -> bool:
        if len(node.parts) < 2 or not _is_number(node) or node.role in ("fold", "iterate"):
            return False
        roles = {part.role for _, part in walk(node)}
        needy = {"meaning", "call", "crossing", "read", "ddx", "ddy", "fold", "iterate", "tamed"}
        return not roles & needy and not any(
            part.type.endswith("]") and part.role in ("variable", "local") for _, part in walk(node)
        )

    chosen = _chosen(tree, chance, fits)
    if chosen is None:
        return None
    path, node = chosen
    leaves = {
        str(leaf): leaf
        for _, leaf in walk(node)
        if leaf.role in ("variable", "local") and not leaf.name.startswith("k")
    }
    if not leaves:
        return None
    formals = {
        text: expression(leaf.type, f"g{i}", role="formal")
        for i, (text, leaf) in enumerate(leaves.items())
    }
    body = _with_leaves(node, formals)
    shown = ", ".join(f"g{i}: {leaf.type}" for i, leaf in enumerate(leaves.values()))
    function = Node(f"fn extracted({shown}) -> {node.type} = {{}}", (body,), role="function")
    places = ", ".join("{}" for _ in leaves)
    call = expression(node.type, f"extracted({places})", map(_pinned_leaf, leaves.values()), "call")
    tree = changed(tree, path, lambda _: call)
    return replace(tree, parts=(*tree.parts, function))


def _pinned_leaf(node: Node) -> Node:
    return _pinned(node) if node.type in ("float", "int", "uint") else node


def _with_leaves(node: Node, values: Mapping[str, Node]) -> Node:
    if node.role in ("variable", "local") and str(node) in values:
        return values[str(node)]
    return replace(node, parts=tuple(_with_leaves(part, values) for part in node.parts))


def _functions(tree: Node) -> dict[str, Node | None]:
    """The functions by name; an overload is not told from its namesakes."""
    functions: dict[str, Node | None] = {}
    for part in tree.parts:
        if part.role == "function":
            functions[part.name] = None if part.name in functions else part
    return functions


def _inline_function(tree: Node, chance: Random) -> Node | None:
    """A call becomes the body of the function, with the arguments in it."""
    functions = _functions(tree)

    def fits(node: Node) -> bool:
        function = functions.get(node.name) if node.role == "call" else None
        return function is not None and len(function.parts) == 2 and not str(function.parts[1])

    def change(node: Node) -> Node:
        function = functions[node.name]
        assert function is not None
        values = {n: _typed(p) for n, p in zip(_formals(function), node.parts, strict=True)}
        body = substituted(function.parts[0], "local", values)
        return replace(_typed(body), needs=node.needs)

    return _at(tree, chance, fits, change)


def _formals(function: Node) -> list[str]:
    """The names of a function's arguments."""
    header = function.form.partition(")")[0].partition("(")[2]
    return [formal.partition(":")[0].strip() for formal in header.split(", ")]


def _name_arguments(tree: Node, chance: Random) -> Node | None:
    """The arguments of a call are given by name, in another order."""
    functions = _functions(tree)

    def fits(node: Node) -> bool:
        return node.role == "call" and functions.get(node.name) is not None

    def change(node: Node) -> Node:
        function = functions[node.name]
        assert function is not None
        names = _formals(function)
        order = list(range(len(node.parts)))
        chance.shuffle(order)
        form = f"{node.name}({', '.join(f'{names[number]} = {{}}' for number in order)})"
        parts = tuple(node.parts[number] for number in order)
        return replace(node, form=form, parts=parts, role="call by name")

    return _at(tree, chance, fits, change)


def _typed(node: Node) -> Node:
    """A value that has exactly its type, as an argument or a result has."""
    if "<" in node.type or node.type in ("rgb", "angle"):
        if node.type.startswith(("direction", "normal")):
            return node  # Its length would have to be proven again.
        return replace(node, form="({} as " + node.type + ")", parts=(node,), role="typed")
    return _pinned_leaf(node)


def _rename(tree: Node, _chance: Random) -> Node:
    """Functions, slots and what loops bind get other names."""
    names = {
        node.name
        for _, node in walk(tree)
        if (node.role in ("function", "term", "slot", "local") and node.name)
        and node.name not in ("color", "alpha")
    }
    pattern = re.compile(rf"\b({'|'.join(sorted(names))})\b") if names else None

    def renamed(node: Node) -> Node:
        form = pattern.sub(r"other_\1", node.form) if pattern else node.form
        return replace(node, form=form, parts=tuple(map(renamed, node.parts)))

    return renamed(tree)


def _declare_more(tree: Node, _chance: Random) -> Node:
    """More declarations, which nobody uses."""
    unused = (
        "unused_constant = 2.5", "fn unused_function(x: vec3) -> float = dot(x, x) * 0.5",
        "struct Unused { a : float }", "mixin UnusedMixin { unused_slot = 1.0 }",
    )  # fmt: skip
    nodes = (Node(text.replace("{", "{{").replace("}", "}}")) for text in unused)
    return replace(tree, parts=(*tree.parts, *nodes))


def _turn_file(tree: Node, _chance: Random) -> Node:
    """The declarations in another order, which has no meaning."""
    first = tuple(part for part in tree.parts if str(part) == "burnish 1")
    rest = tuple(part for part in tree.parts if str(part) != "burnish 1")
    return replace(tree, parts=first + rest[::-1])


def _move_to_mixin(tree: Node, chance: Random) -> Node | None:
    """A slot of the material moves to a mixin, which says what it needs from the material."""
    (path, material) = next((p, node) for p, node in walk(tree) if node.role == "material")
    header, members = material.parts
    movable = [
        part
        for part in members.parts
        if part.role == "slot" and part.name not in ("color", "alpha") and not _reads(part)
    ]
    if not movable:
        return None
    moved = chance.choice(movable)
    rest = tuple(part for part in members.parts if part is not moved)
    declared = {part.name for part in rest if part.name}
    needed = {
        leaf.name: Node(f"{leaf.name} : {leaf.type}")
        for _, leaf in walk(moved)
        if leaf.role == "variable" and leaf.name in declared
    }
    named = replace(header, parts=(*header.parts, Node("MovedAway")))
    left = replace(material, parts=(named, replace(members, parts=rest)))
    mixin = listed("mixin MovedAway {{\n    {}\n}}", (*needed.values(), moved), "\n    ")
    tree = changed(tree, path, lambda _: left)
    return replace(tree, parts=(*tree.parts, mixin))


def _reads(node: Node) -> bool:
    """True if a texture is read, which a mixin would have to declare."""
    return any(part.role == "read" for _, part in walk(node))


REWRITINGS: Mapping[str, Rewriting] = {
    "swap operands": _swap_operands,
    "mirror a comparison": _mirror_comparison,
    "negate a comparison": _negate_comparison,
    "turn a choice": _turn_choice,
    "add nothing": _add_nothing,
    "choose between alike": _choose_alike,
    "unroll": _unroll,
    "name a value": _name_value,
    "extract a function": _extract_function,
    "inline a function": _inline_function,
    "name the arguments": _name_arguments,
    "rename": _rename,
    "declare more": _declare_more,
    "turn the file": _turn_file,
    "move to a mixin": _move_to_mixin,
}


def rewritten(tree: Node, seed: str, only: str = "") -> Iterator[tuple[str, Node]]:
    """A program for each rewriting that finds a place, with the name of the rewriting."""
    for name, rewriting in REWRITINGS.items():
        if only in ("", name) and (found := rewriting(tree, Random(f"{seed} {name}"))) is not None:
            yield name, found
