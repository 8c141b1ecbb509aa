"""Runs the passes on the slots of a material, from a shader to functions that an engine calls.

``compiling_functions.py`` calls ``stage_functions`` as it calls ``pipeline.stage`` for whole
shaders. Values are simplified and guarded as they are there. Then the graph is cut: a varying, a
parameter, a vertex input and a value of the pipeline become arguments. Nothing is moved to the
vertices or to the host, as nobody knows what an engine computes there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from itertools import count

from ...support.frozen import changed, frozen
from ..ir.functions import FunctionsShader, SlotInfo, SurfaceInfo
from ..ir.leaves import Argument, Attribute, Parameter
from ..ir.node import Graph, Node, Roots
from ..ir.operations import CROSS, INPUT, MEMBER
from ..ir.program import Program
from ..ir.rewrite import rewrite
from ..ir.shader import ArgumentInfo, ArgumentSource, Result, Shader
from ..ir.stages import SURFACE, VALUE, VERTEX, InterpolationMode
from ..ir.types import Struct, Type
from ..ir.walks import visible
from ..layout import suggested_name
from .checkpoint import verified
from .guard import Guard
from .lift_lambdas import lift_lambdas
from .pack_varyings import name_of, users_of
from .pipeline import Options, Undecided, guarded
from .rename_variables import rename_variables
from .split_functions import split_functions

_CUT = frozenset({"cross", "parameter", "member", "attribute", "input"})


@frozen
class StagedFunctions:
    """A program of functions, with further results of the passes."""

    program: Program
    slots: tuple[SlotInfo, ...]
    """What each result is, in order: those asked for, and values that are interpolated for them."""
    guards: tuple[Guard, ...]
    undecided: Undecided | None = None
    """The calls in the program that each profile decides about."""


def stage_functions(made: FunctionsShader, options: Options) -> StagedFunctions:
    """The functions of a material's slots: optimised, guarded and scheduled."""
    shader = made.shader
    found = guarded(shader, options)
    results = [changed(r, value=v) for r, v in zip(shader.results, found.roots, strict=True)]
    known = [result.value for result in results if result.kind == SURFACE]
    cutting = _Cutting(shader, dict(zip(known, made.surface, strict=True)))
    wanted = cutting.cut([result for result in results if result.kind == VALUE])
    notes = shader.notes
    roots = Roots([result.value for result in wanted])
    roots = verified("lift_lambdas", "guarded", lift_lambdas(shader.graph, roots, notes))
    roots = rename_variables(shader.graph, roots, notes.follow)
    roots = verified("rename_variables", "stored", roots)
    wanted = [changed(r, value=v) for r, v in zip(wanted, roots, strict=True)]
    cut = changed(shader, results=tuple(wanted), arguments=cutting.arguments())
    undecided = Undecided((), found.ranges) if found.decisions.undecided else None
    guards = tuple(found.decisions.kept.values())
    slots = (*made.slots, *cutting.varyings())
    return StagedFunctions(split_functions(cut), slots, guards, undecided)


class _Cutting:
    """Replaces what functions cannot read by arguments."""

    def __init__(self, shader: Shader, surface: dict[Node, SurfaceInfo]) -> None:
        self._shader, self._graph, self._notes = shader, shader.graph, shader.notes
        self._surface = surface
        self._parameters = {info.leaf: info for info in shader.parameters}
        self._attributes = {info.leaf: info for info in shader.attributes}
        self._infos: dict[tuple[ArgumentSource, str], ArgumentInfo] = {}
        self._names = {info.leaf.name for info in shader.textures}
        self._varyings: dict[Node, Result] = {}
        """The functions for vertices whose results are interpolated, by the value."""
        self._users: Mapping[int, str] = {}
        self._functions = {result.function for result in shader.results if result.kind == VALUE}

    def cut(self, results: list[Result]) -> list[Result]:
        """The results of functions without crossings and globals but textures.

        Behind them are those of functions that compute values to interpolate.
        """
        made = self._rewritten(results)
        return [*made, *self._rewritten(list(self._varyings.values()))]

    def arguments(self) -> tuple[ArgumentInfo, ...]:
        """All arguments: those of the surface, then parameters in order of declaration."""
        order = {info.leaf.name: number for number, info in enumerate(self._shader.parameters)}
        sources = ("surface", "attribute", "varying", "pipeline", "parameter")

        def place(info: ArgumentInfo) -> tuple[int, int]:
            name = info.name_there.partition(".")[0]
            return sources.index(info.source), order.get(info.name_there, order.get(name, 0))

        return tuple(sorted(self._infos.values(), key=place))

    def varyings(self) -> Iterable[SlotInfo]:
        """What is known of the values that are interpolated for others."""
        for result in self._varyings.values():
            yield SlotInfo(result.name, result.function, str(result.value.type), result.doc)

    def _rewritten(self, results: list[Result]) -> list[Result]:
        roots = [result.value for result in results]
        nodes = visible(roots, into_bodies=True)
        self._users = users_of(nodes, self._notes)
        values = rewrite(self._graph, roots, self._rule, self._notes.follow, _CUT, nodes)
        return [changed(r, value=value) for r, value in zip(results, values, strict=True)]

    def _rule(self, graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        if node.op == "member" and (isinstance(node.type, Struct) or _owner(node) is None):
            return None  # A part of what is no argument, or of which parts are.
        found = self._argument(node)
        key = found.source, found.name_there
        info = self._infos.get(key)
        if info is None:
            name = _apart(found.leaf.name, self._names)
            self._names.add(name)
            info = self._infos[key] = changed(found, leaf=changed(found.leaf, name=name))
        return graph.node("argument", info.leaf.type, (), info.leaf)

    def _argument(self, node: Node) -> ArgumentInfo:
        """The argument that a node becomes, with the name that it would like to have."""
        owner = _owner(node)
        if owner is not None:
            return self._of_member(node, owner)
        if isinstance(node.data, Parameter):
            return self._of_parameter(node.data)
        if isinstance(node.data, Attribute):
            return self._of_attribute(node.data)
        if node.op == "input":
            name = INPUT.data(node).name
            return _undeclared(name, node.type, "pipeline", name)
        return self._of_crossing(node)

    def _of_parameter(self, leaf: Parameter) -> ArgumentInfo:
        info = self._parameters[leaf]
        argument = Argument(
            suggested_name(leaf), leaf.type, fact=leaf.fact, member_facts=leaf.member_facts
        )
        return ArgumentInfo(
            argument, info.declared_type, info.comment, "parameter", leaf.name, parameter=info
        )

    def _of_member(self, node: Node, owner: Parameter) -> ArgumentInfo:
        """A member of a structure, which is an argument by itself."""
        info, path = self._parameters[owner], list(_path(node))
        default = info.default
        for name in path:
            names = [each.leaf.short_name for each in info.members]
            if isinstance(default, tuple):
                default = default[names.index(name)]
            info = info.members[names.index(name)]
        name = "_".join((suggested_name(owner), *path))
        argument = Argument(name, node.type, fact=info.leaf.fact)
        whole = changed(info, default=default, leaf=changed(info.leaf, group=owner.group))
        given = ".".join((owner.name, *path))
        return ArgumentInfo(
            argument, info.declared_type, info.comment, "parameter", given, parameter=whole
        )

    def _of_attribute(self, leaf: Attribute) -> ArgumentInfo:
        info = self._attributes[leaf]
        argument = Argument(leaf.name.replace(".", "_"), leaf.type)
        return ArgumentInfo(
            argument, info.declared_type, info.doc, "attribute", leaf.name, attribute=info
        )

    def _of_crossing(self, node: Node) -> ArgumentInfo:
        value, mode = node.operands[0], CROSS.data(node).mode
        known = self._surface.get(node)
        if known is not None:
            argument, type_ = Argument(known.name, node.type), known.declared_type
            return ArgumentInfo(argument, type_, known.doc, "surface", known.word, mode)
        if isinstance(value.data, Attribute):
            return changed(self._of_attribute(value.data), mode=mode)
        result = self._varyings.get(value)
        if result is None:
            result = self._varyings[value] = self._varying(node)
        return _undeclared(result.name, node.type, "varying", result.function, mode)

    def _varying(self, crossing: Node) -> Result:
        """The function that computes a value which is interpolated."""
        wanted = name_of(crossing, self._notes, self._users)
        name = _apart(wanted, self._functions)
        self._functions.add(name)
        return Result(VALUE, VERTEX, crossing.operands[0], name, function=name)


def _owner(node: Node) -> Parameter | None:
    """The parameter of which a node is a member, or a member of a member; ``None`` for others."""
    whole = node
    while whole.op == "member":
        whole = whole.operands[0]
    return whole.data if whole is not node and isinstance(whole.data, Parameter) else None


def _path(node: Node) -> Iterator[str]:
    """The members on the way from a parameter to a node, the outermost first."""
    if node.op == "member":
        yield from _path(node.operands[0])
        yield MEMBER.data(node)


def _apart(name: str, taken: Set[str]) -> str:
    """The name itself, or with the first number that tells it from the others."""
    numbered = (f"{name}_{number}" for number in count(2))
    return name if name not in taken else next(n for n in numbered if n not in taken)


def _undeclared(
    name: str,
    type_: Type,
    source: ArgumentSource,
    name_there: str,
    mode: InterpolationMode = "perspective",
) -> ArgumentInfo:
    """An argument that no declaration describes."""
    return ArgumentInfo(Argument(name, type_), str(type_), "", source, name_there, mode)
