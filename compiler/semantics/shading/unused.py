"""Checks declarations of a file that its shaders do not use, so that a library is checked, too.

A declaration that reads slots of a surface or of a light can be right or wrong only together with
one. It is right if it is right with any of those that the file declares; otherwise the errors of
the setting with the fewest errors are reported.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import suppress
from functools import partial
from itertools import chain, islice, product

from ....support.frozen import cached_property, changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Diagnostic, Report
from ...ir.node import Node
from ...syntax import ast
from ..checking import lookup
from ..checking.applications import apply_body
from ..checking.lights import light_instance, per_light
from ..declarations.externs import read_externs
from ..declarations.parameters import leaves_of
from ..declarations.written_types import struct_of
from ..inheritance.flattening import Records
from ..names.modules import Module, Symbol
from ..state.scope import Scope
from ..types.generics import examples, of_unknown_family, uninferable
from ..types.typenames import Variables
from .assembly import (
    Parts,
    Setting,
    at_mesh,
    is_declared_abstract,
    set_up,
    set_up_beside,
    with_made_vertices,
)
from .elaborate import delivers_vertices, results_of, written_results
from .instances import instance_of
from .known_right import Keys, KnownRight, Outcome
from .placeholders import some, stand_in
from .rigs import light_entry
from .room import has_room
from .slot_checks import check_instance, check_rig
from .vertices.expansion import expanded, expands

MOST_EXAMPLES = 256
"""The number of ways to fill in type parameters that are tried."""
MOST_SETTINGS = 16
"""The number of materials and lights with which a wrong declaration is tried.

It is wrong if it is wrong with all of them.
"""
MOST_TRIED = 1_000_000
"""The number of characters of declarations that are tried in a compile, in about five seconds.

Each declaration counts as often as it is tried. The records that it extends are tried with it, down
to those of the library.
"""

Check = Callable[[Setting], bool]
"""A check that reports its findings, and says whether it came to values."""


@frozen
class Attempt:
    """The outcome of one try of checking a declaration."""

    found: tuple[Diagnostic, ...]
    right: bool
    reached: frozenset[Symbol] = frozenset()
    """Other declarations that were checked by it."""

    @property
    def errors(self) -> int:
        """The number of errors that it found."""
        return sum(diagnostic.severity == "error" for diagnostic in self.found)


@frozen
class CandidateContexts:
    """The contexts in which a file's declarations can be checked, the likeliest first.

    No field is empty.
    """

    materials: tuple[Symbol, ...]
    lights: tuple[Symbol, ...]
    """Rigs, and lights that stand for one."""
    rigs: tuple[Symbol, ...]
    passes: tuple[Symbol, ...]
    drawn: tuple[tuple[Symbol, Symbol], ...]
    """Rigs and passes with one of which a concrete material has to agree."""

    @property
    def every(self) -> Iterator[Symbol]:
        """All declarations of these contexts."""
        return chain(self.materials, self.lights, self.rigs, self.passes)


class _TooMuchError(Exception):
    """More would be tried than may be, which has been reported."""


class UnusedDeclarations:
    """The declarations of a file that its shaders have not ``reached``."""

    def __init__(
        self,
        module: Module,
        around: CandidateContexts,
        settings: Iterable[Setting],
        reached: set[Symbol],
        report: Report,
        records: Records,
        known: KnownRight | None,
    ) -> None:
        """Declarations that have been checked in ``settings`` already are not checked once more.

        Neither are those that ``known`` remembers as right, and it learns of others.
        """
        self._module = module
        self._around = around
        self._reached = reached
        self._report = report
        self._records = records
        self._tried_length = 0
        self._trials = {setting.parts: _Trial(setting) for setting in settings}
        self._known = known
        self._keys = Keys(module, around.every, around.drawn)
        self._right: list[tuple[Hashable, Outcome]] = []
        """The outcomes for declarations that were tried, if nothing else is found at all."""

    def check(self) -> None:
        """Reports the errors in declarations; those that records use count as checked with them."""
        with suppress(_TooMuchError):
            self._check(ast.Record)
            self._check(ast.Rig, ast.Mixin)
            self._check(ast.Function, ast.Constant, ast.StructDeclaration, ast.ExternBlock)
        if self._known is not None and not self._report.count:
            self._known.keep(self._right, self._module.prelude)

    def _check(self, *kinds: type) -> None:
        for symbol in self._declared:
            if isinstance(symbol.declaration, kinds) and symbol not in self._reached:
                if not has_room(symbol, self._records, self._report):
                    raise _TooMuchError
                if not self._is_known_right(symbol):
                    self._try(symbol)

    def _is_known_right(self, symbol: Symbol) -> bool:
        """True if a declaration was right before; then all is as if it had been checked now."""
        if self._known is None:
            return False
        outcome = self._known.find(self._keys.of(symbol), self._module.prelude)
        if outcome is None:
            return False
        self._records.work.nodes += outcome.nodes
        self._tried_length += outcome.length
        self._reached.update(self._module.declared[name][at] for name, at in outcome.reached)
        return True

    def _try(self, symbol: Symbol) -> None:
        """Report what is wrong with a declaration."""
        nodes, length = self._records.work.nodes, self._tried_length
        reached = self._tell(self._counted(symbol))
        if self._known is not None:
            own = [each for each in reached if each.module is self._module]
            outcome = Outcome(
                frozenset((s.name, self._module.declared[s.name].index(s)) for s in own),
                self._records.work.nodes - nodes,
                self._tried_length - length,
            )
            self._right.append((self._keys.of(symbol), outcome))

    def _counted(self, symbol: Symbol) -> Iterator[Attempt]:
        """The attempts for a declaration, as long as not too much has been tried.

        The first one is not counted for a material that can be drawn, of which there are few, nor
        for a function or constant, which takes as long as its text is.
        """
        match symbol.declaration:
            case ast.Record(kind="material", abstract=False):
                from_first = False
            case declaration:
                from_first = isinstance(declaration, ast.Record | ast.Mixin | ast.Rig)
        length = self._length(symbol)
        for number, attempt in enumerate(self._attempts(symbol)):
            self._tried_length += length if from_first or number else 0
            if self._tried_length > MOST_TRIED:
                self._report.add(
                    rules.TOO_MUCH_UNUSED, symbol.declaration.name.span,
                    path=self._module.file.source.name, name=symbol.name, most=f"{MOST_TRIED:,}",
                )  # fmt: skip
                raise _TooMuchError
            yield attempt

    def _length(self, symbol: Symbol) -> int:
        """The number of characters that are read to try a declaration once."""
        match symbol.declaration:
            case ast.Record(kind=kind):
                length = sum(_written(each) for each in self._records.of(symbol).chain)
                return length + self._material if kind == "pass" else length
            case ast.Rig():
                return _written(symbol) + self._material
            case ast.Mixin():
                return sum(_written(each) for each in self._records.alone(symbol).chain)
            case _:
                return _written(symbol)

    @cached_property
    def _material(self) -> int:
        """The length of the longest material with which passes and rigs are tried."""
        return max(map(self._length, self._around.materials))

    @cached_property
    def _declared(self) -> list[Symbol]:
        """All declarations of the file, materials first.

        What is wrong with a light, found while others are tried with it, would not be found again.
        """
        found = [symbol for symbols in self._module.declared.values() for symbol in symbols]
        return sorted(found, key=lambda symbol: not _is_material(symbol))

    def _tell(self, attempts: Iterable[Attempt]) -> frozenset[Symbol]:
        """Takes over the findings of the first right attempt, or of that with the fewest errors.

        Returns the declarations that it has reached.

        Only errors count that have not been reported before, of other declarations. A wrong attempt
        without such errors is ignored; its cause has been reported elsewhere.
        """
        best: Attempt | None = None
        for tried in attempts:
            attempt = changed(tried, found=self._report.lacks(tried.found))
            if attempt.right:
                best = attempt
                break
            if attempt.errors and (best is None or attempt.errors < best.errors):
                best = attempt
        if best is None:
            return frozenset()
        self._report.extend(best.found)
        self._reached.update(best.reached)
        return best.reached

    def _attempts(self, symbol: Symbol) -> Iterator[Attempt]:
        """Tries a declaration in one setting after the other."""
        around = self._around
        match symbol.declaration:
            case ast.Record(kind="material", abstract=abstract):
                offered = product(around.rigs, around.passes)
                for rig, pass_ in offered if abstract else around.drawn:
                    yield self._drawn(symbol, rig, pass_)
            case ast.Record(kind="pass"):
                for material, rig in product(around.materials, around.rigs):
                    yield self._drawn(material, rig, symbol)
            case ast.Record(kind="light"):
                yield from self._tried(partial(_check_light, symbol))
            case ast.Rig():
                for material in around.materials:
                    trial = self._trial(material, symbol)
                    yield trial.attempt(_check_rig, whole=True)
            case ast.Mixin() as mixin if symbol not in self._chained:
                yield from self._tried(partial(_check_mixin, symbol, mixin))
            case ast.Function() as function if not (
                of_unknown_family(function) or uninferable(function)
            ):
                yield from self._of_function(symbol, function)
            case ast.Constant():
                yield from islice(self._tried(partial(_check_constant, symbol)), 1)
            case ast.StructDeclaration():
                yield from islice(self._tried(partial(_check_structure, symbol)), 1)
            case ast.ExternBlock():
                yield from islice(self._tried(partial(_check_block, symbol)), 1)

    def _drawn(self, material: Symbol, rig: Symbol, pass_: Symbol) -> Attempt:
        trial = self._trial(self._around.materials[0], rig)
        return trial.beside(Parts(material, rig, pass_, self._module))

    @cached_property
    def _chained(self) -> frozenset[Symbol]:
        """The mixins and bases of the file's records, which have been checked with these."""
        records = (s for s in self._declared if isinstance(s.declaration, ast.Record))
        return frozenset(chain.from_iterable(self._records.of(s).chain for s in records))

    def _of_function(self, symbol: Symbol, function: ast.Function) -> Iterator[Attempt]:
        """A plain function is right or wrong whatever is shaded, a term only with a surface."""
        filled = examples(function)
        for variables in islice(filled, MOST_EXAMPLES):
            check = partial(_check_function, symbol, function, variables)
            yield from islice(self._tried(check), None if function.kind == "term" else 1)
        if next(filled, None) is not None:  # One of those that were not tried may be right.
            yield Attempt((), right=True)

    def _tried(self, check: Check) -> Iterator[Attempt]:
        settings = product(self._around.materials, self._around.lights)
        for material, lights in islice(settings, MOST_SETTINGS):
            yield self._trial(material, lights).attempt(check)

    def _trial(self, material: Symbol, lights: Symbol) -> _Trial:
        parts = Parts(material, lights, self._around.passes[0], self._module)
        if parts not in self._trials:
            setting = set_up(parts, self._report.apart(), self._records)
            self._trials[parts] = _Trial(setting)
        return self._trials[parts]


def _written(symbol: Symbol) -> int:
    """The number of characters of its declaration."""
    return symbol.declaration.span.end - symbol.declaration.span.start


def _is_material(symbol: Symbol) -> bool:
    declaration = symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.kind == "material"


class _Trial:
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
        check = partial(_check_parts, parts)
        attempt = self.attempt(check, whole=parts == self._setting.parts)
        found = (parts.material, parts.pass_, *self._setting.ctx.reached())
        return changed(attempt, reached=frozenset(found) - known)


def _check_parts(parts: Parts, setting: Setting) -> bool:
    other = set_up_beside(setting, parts)
    delivered = delivers_vertices(results_of(other))
    return delivered or is_declared_abstract(other.passing.record)


def _check_constant(symbol: Symbol, setting: Setting) -> bool:
    span = symbol.declaration.name.span
    value = lookup.value(setting.ctx, symbol.name, span, Scope(symbol.module))
    return isinstance(value, Node)


def _check_structure(symbol: Symbol, setting: Setting) -> bool:
    return struct_of(setting.ctx, symbol) is not None


def _check_block(symbol: Symbol, setting: Setting) -> bool:
    read_externs(setting.ctx, symbol.module)
    return True


def _check_rig(setting: Setting) -> bool:
    check_rig(setting.ctx, setting.surface)
    return True


def _check_light(symbol: Symbol, setting: Setting) -> bool:
    ctx = setting.ctx
    record = ctx.records.of(symbol)
    entry = light_entry(ctx, record)
    if entry is None:
        return False
    instance = light_instance(ctx, entry[0], setting.surface)[0]
    if is_declared_abstract(record):
        stand_in(ctx, instance)
    check_instance(ctx, instance)
    return True


def _check_mixin(symbol: Symbol, mixin: ast.Mixin, setting: Setting) -> bool:
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
    return True


def _check_function(
    symbol: Symbol, function: ast.Function, variables: Variables, setting: Setting
) -> bool:
    """Check a body for arguments of the declared types."""
    ctx, span = setting.ctx, function.name.span
    found = [
        some(ctx, argument.name, argument.type, symbol.module, variables)
        for argument in function.arguments
    ]
    arguments = tuple(argument for argument in found if isinstance(argument, Node))
    if len(arguments) < len(found):
        return False
    if function.per is not None:
        scope = Scope(symbol.module, surface=setting.surface)
        return isinstance(per_light(ctx, symbol, arguments, span, scope), Node)
    within = setting.surface if function.kind == "term" else None
    value = apply_body(ctx, symbol, arguments, span, within, "for example")
    return isinstance(value, Node)
