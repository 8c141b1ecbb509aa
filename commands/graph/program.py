"""Builds the ``Picture`` of the optimised program of a material or a kernel.

``command.py`` calls ``program_picture``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from ...compiler.diagnostics.source import Span
from ...compiler.formula import Formulas
from ...compiler.ir.leaves import Parameter
from ...compiler.ir.node import Formal, Node, formals_of
from ...compiler.ir.operations import CROSS, ITERATE, LOOPS, OUTSIDE
from ...compiler.ir.program import Function, Stage
from ...compiler.ir.shader import Notes, Shader
from ...compiler.ir.stages import VARYING
from ...compiler.ir.statements import Iterate, Region
from ...compiler.ir.types import Struct
from ...compiler.ir.walks import operands_of, visible
from ...compiler.passes.hoist import Derived
from ...compiler.passes.pipeline import Staged
from ...support.frozen import frozen
from .kinds import ArrowKind, Kind
from .model import Arrow, Box, Cluster, Picture

LEAVES = OUTSIDE | {"formal"}
ADDED = "each"
"""The name of the value that each iteration of a fold adds or multiplies."""
_LEAVES = {
    "attribute": Kind.ATTRIBUTE, "input": Kind.INPUT, "texture": Kind.TEXTURE,
    "buffer": Kind.BUFFER, "formal": Kind.ARGUMENT,
}  # fmt: skip
"""The kinds of values from outside by operation; parameters have that of their group."""
_GROUPS = {
    "frame": Kind.FRAME_PARAMETER, "view": Kind.VIEW_PARAMETER, "rig": Kind.RIG_PARAMETER,
    "material": Kind.MATERIAL_PARAMETER, "draw": Kind.DRAW_PARAMETER,
}  # fmt: skip
_COMPUTED = {"fold": Kind.LOOP, "iterate": Kind.LOOP, "apply": Kind.CALL}
"""The kinds of computed values by operation, if they are more than a value."""


def program_picture(
    shader: Shader, staged: Staged, *, everything: bool, parts: Mapping[Span, float] | None = None
) -> Picture:
    """The named values, or with ``everything`` all values, in the place that computes them.

    ``parts`` are the parts of the source's expressions in the error of a pixel.
    """
    return _MaterialBuilder(shader, staged, everything, parts).picture()


class _MaterialBuilder:
    def __init__(
        self,
        shader: Shader,
        staged: Staged,
        everything: bool,
        parts: Mapping[Span, float] | None,
    ) -> None:
        self._shader = shader
        self._parts = parts
        self._staged = staged
        self._everything = everything
        self._notes: Notes = shader.notes
        self._formulas = Formulas(self._notes)
        self._derived = {d.parameter: dict(_values(d)) for d in staged.derived}
        """The host's computations by parameter: a single value, or the members of an element."""
        self._crossings = {
            value: name
            for stage in staged.program.stages
            for value, name in _crossings(stage, self._notes)
        }
        """The name of each varying, by the id of its value in the earlier stage."""
        self._results = {
            stage.name: {o.value.id for o in stage.results if o.kind != VARYING}
            for stage in staged.program.stages
        }
        """The ids of the results of each stage, without varyings."""
        self._guarded = {guard.span for guard in staged.guards if guard.span is not None}
        self._arrows: dict[Arrow, None] = {}

    def picture(self) -> Picture:
        program = self._staged.program
        clusters = [self._host()] if self._derived else []
        for stage in program.stages:
            clusters += self._entry(stage)
        for stage in program.stages:
            for function in stage.functions:
                clusters += self._function(stage, function)
        keys = {box.key: None for cluster in clusters for box in cluster.boxes}
        for source, target in self._between(keys):
            self._arrow(source, target, ArrowKind.CROSSING)
        title = f"{self._shader.name}, pass {self._shader.pass_name}, rig {self._shader.rig_name}"
        return Picture(title, clusters, list(self._arrows))

    def _between(self, keys: Collection[str]) -> Iterator[tuple[str, str]]:
        """The ends of arrows from the host's values to their uses, and from stage to stage."""
        for parameter, values in self._derived.items():
            ending = f".derived.{parameter.name}"
            readers = [key for key in keys if key.endswith(ending)]
            yield from ((f"host.{name}", key) for name in values for key in readers)
        before: list[str] = []
        for stage in self._staged.program.stages:
            for node in visible(stage.roots) if before else ():
                if node.op == "cross" and (key := self._key(stage.name, node)) in keys:
                    # A stage that only hands a value on has no box for it.
                    starts = (self._key(name, node.operands[0]) for name in before)
                    start = next(filter(keys.__contains__, starts), None)
                    if start is not None:
                        yield start, key
            before.insert(0, stage.name)

    def _arrow(self, source: str, target: str, kind: ArrowKind = ArrowKind.USE) -> None:
        self._arrows[Arrow(source, target, kind)] = None

    # --- clusters --------------------------------------------------------------------------------

    def _host(self) -> Cluster:
        cluster = Cluster("host, once for each change of a parameter", is_stage=True)
        for parameter, values in self._derived.items():
            for name, expression in values.items():
                box = self._box(f"host.{name}", Kind.DERIVED, name, expression)
                box.formula = self._formulas.computed(expression)
                box.note = f"group {parameter.group}"
                cluster.boxes.append(box)
                self._inputs(cluster, expression, box)
        return cluster

    def _inputs(self, cluster: Cluster, expression: Node, box: Box) -> None:
        """Add the parameters from which the host computes a value."""
        for leaf in visible((expression,)):
            if leaf.op == "parameter":
                inner = self._leaf("host", leaf)
                if all(known.key != inner.key for known in cluster.boxes):
                    cluster.boxes.append(inner)
                self._arrow(inner.key, box.key)

    def _entry(self, stage: Stage) -> Iterator[Cluster]:
        """The clusters of a stage, without those of its functions."""
        roots: list[Node] = []
        results: dict[int, str] = {}
        for output in stage.results:
            if output.kind != VARYING:
                roots.append(output.value)
                results[output.value.id] = output.shown
        crossing = [v for varying in self._staged.program.leaving(stage) for v in varying.values]
        for value in crossing:
            if value.op not in LEAVES:
                results.setdefault(value.id, self._crossing(value))
        title = f"{stage.name} stage"
        yield from self._stage(stage.name, title, stage.region, [*roots, *crossing], results)

    def _function(self, stage: Stage, function: Function) -> Iterator[Cluster]:
        arguments = ", ".join(formal.name for formal, _ in function.parameters)
        title = f"{stage.name} function {function.name}({arguments})"
        prefix = f"{stage.name}.{function.body.id}"
        results = {function.value.id: "return"}
        yield from self._stage(prefix, title, function.region, [function.value], results)

    def _stage(
        self, prefix: str, title: str, region: Region, roots: list[Node], results: dict[int, str]
    ) -> Iterator[Cluster]:
        """The cluster of a body, and one for each loop in it."""
        names = dict(_statements(region))
        order = visible(roots)
        loops = {node: own for node in order if (own := _variables(node))}
        every = frozenset().union(*loops.values()) if loops else frozenset()
        inside = {node.id: node.variables & every for node in order}
        whole = _Part(prefix, title, names, inside, frozenset(), frozenset())
        yield self._cluster(whole, roots, results)
        for loop, own in loops.items():
            count = self._formulas.text(loop.operands[0])
            title = f"each turn of {names.get(loop.id, 'a loop')}, up to {count}"
            around = inside[loop.id] | own
            part = _Part(f"{prefix}.loop.{loop.id}", title, names, inside, own, around)
            results = _turn(loop)
            bodies = [node for node in loop.operands if node.id in results]
            yield self._cluster(part, bodies, results)

    def _cluster(self, part: _Part, roots: list[Node], results: dict[int, str]) -> Cluster:
        cluster = Cluster(part.title, is_stage=part.prefix in self._results)
        for node in part.reached(roots):
            if part.is_outer(node):
                name = part.names.get(node.id) or self._shown_name(node)
                box = self._value(part.prefix, node, name or self._formulas.computed(node))
                if node.op not in LEAVES and node.op != "cross":
                    box.kind, box.note = Kind.ARGUMENT, "computed before the loop"
                cluster.boxes.append(box)
            elif node.id in results or self._has_box(part, node):
                name = part.names.get(node.id) or self._shown_name(node)
                box = self._value(part.prefix, node, results.get(node.id) or name or "")
                if node.id in results and node.op not in LEAVES:
                    delivered = self._results.get(part.prefix)
                    crosses = delivered is not None and node.id not in delivered
                    box.kind = Kind.CROSSING if crosses else Kind.RESULT
                    box.note = "varying" if crosses else Kind.RESULT.words
                cluster.boxes.append(box)
                if node.op not in LEAVES and node.op != "cross":
                    self._inside(part, node, box, results)
        return cluster

    def _has_box(self, part: _Part, node: Node) -> bool:
        if part.is_deeper(node):
            return False
        return node.id in part.names or self._shown_name(node) is not None

    # --- boxes -----------------------------------------------------------------------------------

    def _crossing(self, value: Node) -> str:
        """The name of a value that goes to the next stage."""
        return self._formulas.name(value) or self._crossings.get(value.id, "crossing")

    def _shown_name(self, node: Node) -> str | None:
        """The name of a value that gets a box; ``None`` if the value is part of its user's
        formula."""
        if node.op == "cross":
            return self._crossing(node.operands[0])
        if node.op in LEAVES:
            return self._formulas.name(node) or str(node.data)
        if node.op == "constant":
            return None
        name = self._notes.names.get(node.id)
        if name is None and self._everything:
            return self._formulas.computed(node)
        return name

    def _value(self, prefix: str, node: Node, name: str) -> Box:
        if node.op in LEAVES:
            return self._leaf(prefix, node)
        if node.op == "cross":
            box = self._box(self._key(prefix, node), Kind.CROSSING, name, node)
            flat = CROSS.data(node).mode == "flat"
            box.note = "varying, flat" if flat else "varying, interpolated"
            box.part = self._part([self._notes.spans.get(node.id)])
            return box
        return self._box(self._key(prefix, node), _COMPUTED.get(node.op, Kind.VALUE), name, node)

    def _leaf(self, prefix: str, node: Node) -> Box:
        name = self._formulas.name(node) or str(node.data)
        kind = _LEAVES.get(node.op, Kind.OTHER_PARAMETER)
        if isinstance(node.data, Parameter):
            derived = node.data.derived
            kind = Kind.DERIVED if derived else _GROUPS.get(node.data.group, kind)
        return self._box(self._key(prefix, node), kind, name, node)

    def _box(self, key: str, kind: Kind, name: str, node: Node) -> Box:
        place, part = self._place(node), self._part(())
        return Box(key, kind, name, str(node.type), place=place, part=part)

    def _part(self, spans: Iterable[Span | None]) -> float | None:
        """The sum of the parts of these expressions in the error of a pixel."""
        if self._parts is None:
            return None
        return sum(self._parts.get(span, 0.0) for span in spans if span is not None)

    def _key(self, prefix: str, node: Node) -> str:
        if isinstance(node.data, Parameter) and node.op == "parameter":
            word = "derived" if node.data.derived else "parameter"
            return f"{prefix}.{word}.{node.data.name}"
        return f"{prefix}.{node.id}"

    def _place(self, node: Node) -> str:
        span = self._notes.spans.get(node.id)
        return "" if span is None else str(span)

    def _formula(self, root: Node, names: Mapping[int, str]) -> str:
        def name(node: Node) -> str | None:
            if root.op == "fold" and node is root.operands[2]:
                return ADDED
            if node.op == "cross":
                return self._shown_name(node)
            return None if node is root else names.get(node.id) or self._formulas.name(node)

        return self._formulas.computed(root, name)

    def _inside(self, part: _Part, root: Node, box: Box, results: Collection[int]) -> None:
        """The parts of a formula: other boxes, with arrows, and values without names."""
        box.formula = self._formula(root, part.names)
        spans: set[Span | None] = {self._notes.spans.get(root.id)}
        pending = list(operands_of(root))
        seen: set[int] = set()
        while pending:
            node = pending.pop()
            if node.id in seen or node.op == "constant":
                continue
            seen.add(node.id)
            if part.is_outer(node) or node.id in results or self._has_box(part, node):
                self._arrow(self._key(part.prefix, node), box.key)
                continue
            spans.add(self._notes.spans.get(node.id))
            pending += operands_of(node)
        box.guarded = not self._guarded.isdisjoint(spans)
        box.part = self._part(spans)


@frozen
class _Part:
    """The content of one cluster: a body, or one iteration of a loop."""

    prefix: str
    title: str
    names: Mapping[int, str]
    """The names that statements of the whole body bind."""
    inside: Mapping[int, frozenset[Formal]]
    """The variables of loops on which each value depends."""
    own: frozenset[Formal]
    """The variables that the loop binds: its index and its states."""
    around: frozenset[Formal]
    """The variables of this loop and of the loops around it."""

    def is_outer(self, node: Node) -> bool:
        """True if a value is computed before the loop."""
        return bool(self.own) and self.own.isdisjoint(self.inside[node.id])

    def is_deeper(self, node: Node) -> bool:
        """True if a value belongs to an inner loop."""
        return not self.inside[node.id] <= self.around

    def reached(self, roots: Iterable[Node]) -> list[Node]:
        """The values of this part, and the outer values that it uses, operands first."""
        seen: dict[int, Node] = {}
        pending = list(roots)
        while pending:
            node = pending.pop()
            if node.id not in seen and node.op != "constant":
                seen[node.id] = node
                if not self.is_outer(node):
                    pending += operands_of(node)
        return [seen[id_] for id_ in sorted(seen)]


def _variables(node: Node) -> frozenset[Formal]:
    """The variables that a loop binds: its index and its states; empty for any other value."""
    return frozenset(formals_of(node)) if node.op in LOOPS else frozenset()


def _turn(loop: Node) -> dict[int, str]:
    """The results of an iteration, by the ids of the values: an added value, or the next states."""
    if loop.op == "fold":
        return {loop.operands[2].id: ADDED}
    going, *following = loop.operands[1 + ITERATE.data(loop).states :]
    names = [formal.name for formal in formals_of(loop)[1:]]
    named = {node.id: f"next {name}" for node, name in zip(following, names, strict=True)}
    return named if going.op == "constant" else {going.id: "while", **named}


def _values(derived: Derived) -> Iterator[tuple[str, Node]]:
    """The host's computations by name; for a table, those for element ``i``."""
    name, expression = derived.parameter.name, derived.expression
    if isinstance(expression.type, Struct):
        for (member, _), value in zip(expression.type.members, expression.operands, strict=True):
            yield f"{name}[i].{member}", value
    else:
        yield name, expression


def _crossings(stage: Stage, notes: Notes) -> Iterator[tuple[int, str]]:
    """The varyings, each with the name of the value that it is a part of."""
    users: dict[int, str] = {}
    for node in reversed(visible(stage.roots, into_bodies=True)):
        within = notes.names.get(node.id) or users.get(node.id)
        if within is None:
            continue
        if node.op == "cross":
            own = notes.names.get(node.id)
            yield node.operands[0].id, own or f"{within}_crossing"
        for operand in node.operands:
            users.setdefault(operand.id, within)


def _statements(region: Region) -> Iterator[tuple[int, str]]:
    """The names that statements bind, including those inside loops and branches."""
    pending = [region]
    while pending:
        for statement in pending.pop().statements:
            if not isinstance(statement, Iterate):
                yield statement.node.id, statement.name
            elif len(statement.states) == 1:
                yield statement.node.id, statement.states[0].name
            pending += statement.regions
