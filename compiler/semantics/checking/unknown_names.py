"""Names that nothing declares, and hints at the names that may have been meant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import chain
from types import MappingProxyType

from ...diagnostics import rules
from ...diagnostics.fixes import FixIt, Hint
from ...diagnostics.nearest import nearest_in
from ...diagnostics.source import Span
from ...ir.stages import PATCH_INDEX, PRIMITIVE_INDEX
from ...syntax import ast
from ...syntax.rewriting import called_here
from ..declarations import enumerations
from ..hints import advice
from ..names.modules import Module
from ..state.context import Context
from ..state.crossings import INPUTS, KERNEL_INPUTS
from ..state.scope import Scope

_COUNTERS = (PRIMITIVE_INDEX.name, PATCH_INDEX.name)
"""The inputs that count the primitives of a mesh, or its patches."""


def unknown_name(ctx: Context, name: str, span: Span, scope: Scope) -> None:
    if name == "light":
        in_term = scope.surface is not None and scope.instance is None
        hint = "sum over the lights: write `per light` in front of the term's `=`"
        ctx.report.add(rules.OUTSIDE_LIGHT, span, name=name, hint=hint if in_term else "")
        return
    parts = () if scope.parts is None else scope.parts.declared
    known = chain(scope.locals, parts, scope.module.visible(), INPUTS)
    for instance in (scope.instance, scope.surface):
        if instance is not None and instance.record.baseless:
            return
        if instance is not None:
            known = chain(known, instance.record.definitions)
    if member := enumerations.qualified(scope.module, name, span):
        ctx.report.add(rules.UNKNOWN_NAME, span, kind="name", name=name, hint=member)
        return
    lit = advice.of_a_light(name, ctx.rig)
    elsewhere = _of_other_languages(name, span) or lit or advice.of_a_record(name, scope)
    elsewhere = elsewhere or _other_kernels(ctx, name) or _other_vertices(scope, name)
    if elsewhere:
        ctx.report.add(rules.UNKNOWN_NAME, span, kind="name", name=name, hint=elsewhere)
        return
    if hint := _of_stages(name, scope) or _of_pipeline(name):
        ctx.report.add(rules.UNKNOWN_NAME, span, kind="name", name=name, hint=hint)
        return
    if hint := advice.uncalled(name):
        ctx.report.add(rules.NOT_A_VALUE, span, hint=hint)
        return
    unknown_here(ctx, "name", name, span, known, scope.module)


def _of_other_languages(name: str, span: Span) -> Hint:
    """The hint for a value, or a word, of another language."""
    from ....stdlib.builtins.elsewhere import KEYWORDS, VALUES
    from ....stdlib.builtins.foreign_words import HOSTED

    if name in HOSTED:
        parameter, _, declared = HOSTED[name].partition(" ")
        return f"the host sets it: `{parameter}`, declared by `param {parameter} {declared}`"
    if name not in VALUES:
        return KEYWORDS.get(name, "") or _of_nodes(name)
    here = called_here(name, span, VALUES[name])
    if VALUES[name].startswith("light.") and isinstance(here, FixIt):
        return FixIt(f"{here.text}, in a `term … per light`", here.fixes)
    return here


def _of_nodes(name: str) -> str:
    """The hint for a name that is no value here, such as the time since the last frame."""
    from ....stdlib.other_names import NODES_BY_FOLDED, folded

    node = NODES_BY_FOLDED.get(folded(name))
    return "" if node is None or node.written else node.hint


def _other_kernels(ctx: Context, name: str) -> str:
    """A hint about a kernel's own input, for an input of kernels over something else."""
    if ctx.extent is None or name not in KERNEL_INPUTS:
        return ""
    own = next(row.name for row in KERNEL_INPUTS.values() if row.type == ctx.extent.type)
    return f"this kernel has `{own}`, of type {ctx.extent.type}"


_WHERE_MADE: Mapping[str, str] = MappingProxyType(
    {
        "corner": "`corner[k].slot` is read in the groups of an `expand` and in a `tessellate`",
        "end": "`end[0].slot` and `end[1].slot` are read in a level of edges, behind `by`",
        PRIMITIVE_INDEX.name: "it counts primitives where an `expand` says what they turn into",
        PATCH_INDEX.name: "it counts patches where a `tessellate` divides them",
    }
)
"""Hints for names that exist only where vertices are made of others, and where that is."""


def _of_stages(name: str, scope: Scope) -> str:
    """About a name that a stage has elsewhere, or that a kernel writes and nothing reads."""
    written = () if scope.instance is None else scope.instance.record.every(ast.Result)
    if any(member.name.text == name for member, _, _ in written):
        return "a result is written and not read: name its value by an equation, and read that"
    if name == "corner" and "end" in scope.locals:
        return "the level of an edge reads its two ends, `end[0].slot` and `end[1].slot`"
    return _WHERE_MADE.get(name, "")


def _of_pipeline(name: str) -> str:
    """About what the pipeline supplies, where nothing is drawn: in functions and kernels."""
    if name not in INPUTS:
        return ""
    return (
        "it exists where something is drawn: in equations of materials, lights and passes, and in "
        "terms; a function takes it as an argument"
    )


def _other_vertices(scope: Scope, name: str) -> str:
    """A hint about the number that counts this surface's primitives, for another such number."""
    made = None if scope.surface is None else scope.surface.made
    if made is None or name not in _COUNTERS:
        return ""
    own = next((counter for counter in made.inputs if counter in _COUNTERS), None)
    return f"what is counted here is `{own}`" if own else ""


def is_known(scope: Scope, name: str) -> bool:
    """True if a name means something in an expression."""
    seen = scope.surface is not None and scope.surface.has(name)
    return name in scope.locals or seen or is_declared(scope, name)


def is_declared(scope: Scope, name: str) -> bool:
    """True if the record or the file gives a name to something, called or not."""
    own = scope.instance is not None and scope.instance.has(name)
    return own or bool(scope.module.find(name))


def unknown(
    ctx: Context, kind: str, name: str, span: Span, known: Iterable[str], declared_as: str = ""
) -> None:
    """Reports a name that nothing declares, with the nearest declared one.

    If no name is near, it says how such a thing is declared.
    """
    hint = advice.nearest_or_all(name, span, known) or advice.undeclared(declared_as, name, span)
    ctx.report.add(rules.UNKNOWN_NAME, span, kind=kind, name=name, hint=hint)


def unknown_here(
    ctx: Context, kind: str, name: str, span: Span, known: Iterable[str], module: Module
) -> None:
    """Reports an unknown name that an import could bring, or should have brought."""
    if name not in module.missing:
        if module.incomplete:
            known = list(known)
            if nearest_in(span.source, name, known) is None:
                return  # The file that could not be imported may declare it.
        kinds = ("fn", "term") if kind == "function" else ()
        hint = module.hint(ast.Name(name, span), known, kinds)
        if kind == "name":
            hint = hint or enumerations.nearly_qualified(module, name, span)
        hint = hint or advice.undeclared(kind, name, span)
        ctx.report.add(rules.UNKNOWN_NAME, span, kind=kind, name=name, hint=hint)
