"""Tries of single declarations: each checks one in a setting, and says what it found.

``unused.py`` tries declarations that no shader of a file uses, in one setting after the other.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import chain

from ....support.frozen import changed, frozen
from ...diagnostics.diagnostic import Diagnostic
from ...ir.node import Node
from ...syntax import ast
from ..checking import lookup
from ..checking.applications import apply_body
from ..checking.lights import light_instance, per_light
from ..declarations.enumerations import enumeration_of
from ..declarations.externs import read_externs
from ..declarations.parameters import leaves_of
from ..declarations.written_types import struct_of
from ..inheritance.flattening import root_of
from ..names.modules import Symbol
from ..state.scope import Scope
from ..types.typenames import Variables
from .assembly import (
    Parts,
    Setting,
    at_mesh,
    is_declared_abstract,
    set_up_beside,
    with_made_vertices,
)
from .elaborate import delivers_vertices, results_of, written_results
from .instances import instance_of
from .placeholders import some, stand_in
from .rigs import light_entry
from .slot_checks import check_instance, check_rig
from .unread_slots import NamedIn, warn_of_unread
from .vertices.expansion import expanded, expands

Check = Callable[[Setting], bool]
"""A check that reports its findings, and says whether it came to values."""

CheckOfFunction = Callable[[Symbol, ast.Function, Variables, Setting], bool]
"""Such a check of a function, for values of its type parameters."""


@frozen
class Attempt:
    """The outcome of one try of checking a declaration."""

    found: tuple[Diagnostic, ...]
    right: bool
    reached: frozenset[Symbol] = frozenset()
    """Other declarations that were checked by it."""
    is_clean: bool = False
    """True if it is right, and found nothing at all, reported before or not."""

    @property
    def errors(self) -> int:
        """The number of errors that it found."""
        return sum(diagnostic.severity == "error" for diagnostic in self.found)


class Trial:
    """A setting with a report of its own."""

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self._report = setting.ctx.report
        setting.ctx.deferred.report()
        self._from_start = self._report.since(0)

    def attempt(self, check: Check, whole: bool = False) -> Attempt:
        """The findings of a check.

        If it is of the ``whole`` setting, the errors that this had from the start belong to it.
        """
        before = self._report.count
        self._setting.ctx.passing = self._setting.passing
        came_to_values = check(self._setting)
        self._setting.ctx.deferred.report()
        found = self._report.since(before)
        self._report.forget(before)  # Another declaration may have the same mistake.
        if whole:
            found = (*self._from_start, *found)
        attempt = Attempt(found, came_to_values)
        return attempt if came_to_values and not attempt.errors else changed(attempt, right=False)

    def beside(self, parts: Parts) -> Attempt:
        """The findings of a check of other parts under the same lights."""
        known = set(self._setting.ctx.reached())
        check = partial(check_parts, parts)
        attempt = self.attempt(check, whole=parts == self._setting.parts)
        found = (parts.material, parts.pass_, *self._setting.ctx.reached())
        return changed(attempt, reached=frozenset(found) - known)


def check_parts(parts: Parts, setting: Setting) -> bool:
    """Check a material, a pass and a rig that are put together."""
    other = set_up_beside(setting, parts)
    delivered = delivers_vertices(results_of(other))
    return delivered or is_declared_abstract(other.passing.record)


def check_constant(symbol: Symbol, setting: Setting) -> bool:
    """Check the value of a constant of the file."""
    span = symbol.declaration.name.span
    value = lookup.value(setting.ctx, symbol.name, span, Scope(symbol.module))
    return isinstance(value, Node)


def check_structure(symbol: Symbol, setting: Setting) -> bool:
    """Check the types of a structure's members."""
    return struct_of(setting.ctx, symbol) is not None


def check_enumeration(symbol: Symbol, setting: Setting) -> bool:
    """Check that an enumeration has members."""
    return enumeration_of(setting.ctx, symbol) is not None


def check_block(symbol: Symbol, setting: Setting) -> bool:
    """Check a block of the host, with the others of its file."""
    read_externs(setting.ctx, symbol.module)
    return True


def check_rig_entries(setting: Setting) -> bool:
    """Check the lights of the setting's rig."""
    check_rig(setting.ctx, setting.surface)
    return True


def check_light(symbol: Symbol, setting: Setting) -> bool:
    """Check a light, with placeholders for what it lacks if it is abstract."""
    ctx = setting.ctx
    record = ctx.records.of(symbol)
    entry = light_entry(ctx, record)
    if entry is None:
        return False
    instance = light_instance(ctx, entry[0], setting.surface)[0]
    if is_declared_abstract(record):
        stand_in(ctx, instance)
    check_instance(ctx, instance)
    warn_of_unread(ctx, record, beside=NamedIn(symbol.module))
    return True


def check_mixin(symbol: Symbol, mixin: ast.Mixin, setting: Setting) -> bool:
    """Checks a mixin, with placeholders for the slots that it needs of its records."""
    ctx, surface = setting.ctx, setting.surface
    record = ctx.records.alone(symbol)
    if mixin.kind == "light":
        entry = light_entry(ctx, record)
        if entry is None:
            return False
        instance = light_instance(ctx, entry[0], surface)[0]
    else:
        instance = instance_of(ctx, record, leaves_of(ctx, record))
        instance.surface = surface if mixin.kind == "pass" else None
    stand_in(ctx, instance)
    if instance.surface is None:
        check_instance(ctx, with_made_vertices(ctx, instance, None))
    elif expands(instance):
        expanded(ctx, at_mesh(surface), instance)
        check_instance(ctx, at_mesh(instance))
    check_instance(ctx, instance)
    written_results(ctx, instance)
    # A pass may have its own form of any slot of the surface.
    kinds = ("pass", "material") if mixin.kind == "pass" else (mixin.kind,)
    roots = [root_of(symbol.module, kind) for kind in kinds]
    also = chain.from_iterable(ctx.records.of(root).definitions for root in roots if root)
    warn_of_unread(ctx, record, beside=NamedIn(symbol.module), also=frozenset(also))
    return True


def check_function(
    symbol: Symbol, function: ast.Function, variables: Variables, setting: Setting
) -> bool:
    """Check defaults, and a body for arguments of the declared types."""
    ctx, span = setting.ctx, function.name.span
    arguments = _placeholders(symbol, function, variables, setting)
    if arguments is None or not _check_defaults(symbol, function, variables, arguments, setting):
        return False
    if function.per is not None:
        scope = Scope(symbol.module, surface=setting.surface)
        return isinstance(per_light(ctx, symbol, arguments, span, scope), Node)
    within = setting.surface if function.kind == "term" else None
    value = apply_body(ctx, symbol, arguments, span, within, "for example")
    return isinstance(value, Node)


def check_defaults(
    symbol: Symbol, function: ast.Function, variables: Variables, setting: Setting
) -> bool:
    """Check the defaults of a function whose body has been checked with other arguments."""
    arguments = _placeholders(symbol, function, variables, setting)
    return arguments is not None and _check_defaults(
        symbol, function, variables, arguments, setting
    )


def _placeholders(
    symbol: Symbol, function: ast.Function, variables: Variables, setting: Setting
) -> tuple[Node, ...] | None:
    """Values for the arguments of a function; ``None`` if one has no proper type."""
    found = [
        some(setting.ctx, argument.name, argument.type, symbol.module, variables)
        for argument in function.arguments
    ]
    arguments = tuple(argument for argument in found if isinstance(argument, Node))
    return arguments if len(arguments) == len(found) else None


def _check_defaults(
    symbol: Symbol,
    function: ast.Function,
    variables: Variables,
    arguments: tuple[Node, ...],
    setting: Setting,
) -> bool:
    """Check each default with placeholders for the arguments before it."""
    if all(formal.default is None for formal in function.arguments):
        return True
    from ..checking.defaults import default_of

    surface = setting.surface if function.kind == "term" else None
    earlier: dict[str, Node] = {}
    right = True
    for formal, argument in zip(function.arguments, arguments, strict=True):
        if formal.default is not None:
            span = function.name.span
            value = default_of(setting.ctx, symbol, formal, earlier, variables, surface, span)
            right = right and isinstance(value, Node)
        earlier[formal.name.text] = argument
    return right
