"""Checks declarations of a file that its shaders do not use, so that a library is checked, too.

A declaration that reads slots of a surface or of a light can be right or wrong only together with
one. It is right if it is right with any of those that the file declares; otherwise the errors of
the setting with the fewest errors are reported.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import chain, islice, product

from ....support.frozen import cached_property, changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Span
from ...syntax import ast
from ..inheritance.flattening import Records
from ..inheritance.ties import tie_of
from ..names.modules import Module, Symbol
from ..types.generics import examples, of_unknown_family, uninferable
from .assembly import (
    Parts,
    Setting,
    set_up,
)
from .keys import Keys
from .known_right import KnownRight, Outcome
from .room import has_room
from .trials import (
    Attempt,
    Check,
    CheckOfFunction,
    Trial,
    check_block,
    check_constant,
    check_defaults,
    check_enumeration,
    check_function,
    check_light,
    check_mixin,
    check_rig_entries,
    check_structure,
)

MOST_EXAMPLES = 256
"""The number of ways to fill in type parameters that are tried."""
MOST_SETTINGS = 16
"""The number of materials and lights with which a wrong declaration is tried.

It is wrong if it is wrong with all of them.
"""
MOST_OPERATIONS = 100
"""The largest number of operations for constants of a declaration that is remembered as right.

Those of all declarations together are limited (``work.py``), and such few do not count.
"""
MOST_TRIED = 1_000_000
"""The number of characters of declarations that are tried in a compile, in about five seconds.

Each declaration counts as often as it is tried. The records that it extends are tried with it, down
to those of the library.
"""


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
    by_ties: bool = True
    """True if materials that are tied to a pass have to agree with that one instead."""

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
        known: KnownRight,
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
        self._trials = {setting.parts: Trial(setting) for setting in settings}
        self._known = known
        self._keys = Keys(module, around.every, around.drawn)
        self._right: list[tuple[Hashable, Outcome]] = []
        """The outcomes for declarations that were right."""
        self._skipped: dict[Symbol, Outcome] = {}
        """The records that were not tried, as they are known to be right."""
        self._named: set[str] = set()
        """The names of all declarations that these may reach."""

    def check(self) -> None:
        """Reports the errors in declarations; those that records use count as checked with them."""
        with suppress(_TooMuchError):
            self._check(ast.Record)
            self._check(ast.Rig, ast.Mixin)
            self._check(ast.Function, ast.Constant, ast.StructDeclaration)
            self._check(ast.Enumeration, ast.ExternBlock)
            self._check_defaults()
        if not self._report.failed:
            self._known.keep(self._right, self._module.prelude)

    def _check(self, *kinds: type) -> None:
        for symbol in self._declared:
            if isinstance(symbol.declaration, kinds) and symbol not in self._reached:
                if not has_room(symbol, self._records, self._report):
                    raise _TooMuchError
                if self._is_known_right(symbol):
                    continue
                self._try_readers(symbol)
                if symbol not in self._reached:
                    self._try(symbol)

    def _check_defaults(self) -> None:
        """Report errors in the defaults of functions that are used: calls may give all arguments.

        Where a call has found one in a default, those of the function are known.
        """
        failed = [found.span for found in self._report.diagnostics if found.severity == "error"]
        for symbol in self._declared:
            function = symbol.declaration
            if not isinstance(function, ast.Function) or symbol not in self._reached:
                continue
            written = [each.default.span for each in function.arguments if each.default is not None]
            if written and not any(span is not None and _is_in(span, written) for span in failed):
                best = self._best(self._of_function(symbol, function, check_defaults))
                self._report.extend(() if best is None else best.found)

    def _is_known_right(self, symbol: Symbol) -> bool:
        """True if a declaration was right before; then all is as if it had been checked now."""
        outcome = self._known.find(self._keys.of(symbol), self._module.prelude)
        if outcome is None or self._tried_length + outcome.length > MOST_TRIED:
            return False
        self._records.work.nodes += outcome.nodes
        self._tried_length += outcome.length
        self._reached.update(self._module.declared[name][at] for name, at in outcome.reached)
        if isinstance(symbol.declaration, ast.Record):
            self._skipped[symbol] = outcome
            self._keys.add_named(symbol.name, self._named)
        return True

    def _try_readers(self, symbol: Symbol) -> None:
        """Try the records after all that were skipped and may reach this declaration.

        What one of them reached is only known as far as no other had reached it before.
        """
        readers = self._keys.readers(symbol.name) if symbol.name in self._named else set()
        for each in [known for known in self._skipped if known.name in readers]:
            outcome = self._skipped.pop(each)
            self._records.work.nodes -= outcome.nodes
            self._tried_length -= outcome.length
            self._try(each)

    def _try(self, symbol: Symbol) -> None:
        """Report what is wrong with a declaration."""
        work, length = self._records.work, self._tried_length
        nodes, left = work.nodes, work.left
        best = self._best(self._counted(symbol))
        if best is None:
            return
        self._report.extend(best.found)
        self._reached.update(best.reached)
        if best.is_clean and left - work.left <= MOST_OPERATIONS:
            own = [each for each in best.reached if each.module is self._module]
            places = frozenset((s.name, self._module.declared[s.name].index(s)) for s in own)
            outcome = Outcome(places, work.nodes - nodes, self._tried_length - length)
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
                length = sum(map(_written, self._chain(symbol)))
                return length + self._material if kind == "pass" else length
            case ast.Rig():
                return _written(symbol) + self._material
            case ast.Mixin():
                return sum(_written(each) for each in self._records.alone(symbol).chain)
            case _:
                return _written(symbol)

    def _chain(self, symbol: Symbol) -> tuple[Symbol, ...]:
        """A record and all that it extends.

        The members of one that is known to be right, which are made late, stay unmade.
        """
        records = self._records
        return records.chain(symbol) if symbol in self._skipped else records.of(symbol).chain

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

    def _best(self, attempts: Iterable[Attempt]) -> Attempt | None:
        """The first right attempt, or that with the fewest errors, with findings that are new.

        Only errors count that have not been reported before, of other declarations. A wrong attempt
        without such errors is ignored; its cause has been reported elsewhere.
        """
        best: Attempt | None = None
        for tried in attempts:
            attempt = changed(
                tried, found=self._report.lacks(tried.found), is_clean=not tried.found
            )
            if attempt.right:
                return attempt
            if attempt.errors and (best is None or attempt.errors < best.errors):
                best = attempt
        return best

    def _attempts(self, symbol: Symbol) -> Iterator[Attempt]:
        """Tries a declaration in one setting after the other."""
        around = self._around
        match symbol.declaration:
            case ast.Record(kind="material", abstract=abstract):
                pairs = product(around.rigs, around.passes) if abstract else around.drawn
                tie = tie_of(symbol, self._records, self._report)
                own = tie.pass_ if tie is not None and around.by_ties else None
                for rig, pass_ in dict.fromkeys((rig, own or pass_) for rig, pass_ in pairs):
                    yield self._drawn(symbol, rig, pass_)
            case ast.Record(kind="pass"):
                for material, rig in product(around.materials, around.rigs):
                    yield self._drawn(material, rig, symbol)
            case ast.Record(kind="light"):
                yield from self._tried(partial(check_light, symbol))
            case ast.Rig():
                for material in around.materials:
                    trial = self._trial(material, symbol)
                    yield trial.attempt(check_rig_entries, whole=True)
            case ast.Mixin() as mixin if symbol not in self._chained:
                yield from self._tried(partial(check_mixin, symbol, mixin))
            case ast.Function() as function if not (
                of_unknown_family(function) or uninferable(function)
            ):
                yield from self._of_function(symbol, function, check_function)
            case declaration if (alone := _CHECKED_ALONE.get(type(declaration))) is not None:
                yield from islice(self._tried(partial(alone, symbol)), 1)

    def _drawn(self, material: Symbol, rig: Symbol, pass_: Symbol) -> Attempt:
        trial = self._trial(self._around.materials[0], rig)
        return trial.beside(Parts(material, rig, pass_, self._module))

    @cached_property
    def _chained(self) -> frozenset[Symbol]:
        """The mixins and bases of the file's records, which have been checked with these."""
        records = (s for s in self._declared if isinstance(s.declaration, ast.Record))
        return frozenset(chain.from_iterable(map(self._chain, records)))

    def _of_function(
        self, symbol: Symbol, function: ast.Function, checks: CheckOfFunction
    ) -> Iterator[Attempt]:
        """A plain function is right or wrong whatever is shaded, a term only with a surface."""
        filled = examples(function)
        for variables in islice(filled, MOST_EXAMPLES):
            check = partial(checks, symbol, function, variables)
            yield from islice(self._tried(check), None if function.kind == "term" else 1)
        if next(filled, None) is not None:  # One of those that were not tried may be right.
            yield Attempt((), right=True)

    def _tried(self, check: Check) -> Iterator[Attempt]:
        settings = product(self._around.materials, self._around.lights)
        for material, lights in islice(settings, MOST_SETTINGS):
            yield self._trial(material, lights).attempt(check)

    def _trial(self, material: Symbol, lights: Symbol) -> Trial:
        parts = Parts(material, lights, self._around.passes[0], self._module)
        if parts not in self._trials:
            setting = set_up(parts, self._report.apart(), self._records)
            self._trials[parts] = Trial(setting)
        return self._trials[parts]


_CHECKED_ALONE: Mapping[type, Callable[[Symbol, Setting], bool]] = {
    ast.Constant: check_constant,
    ast.StructDeclaration: check_structure,
    ast.Enumeration: check_enumeration,
    ast.ExternBlock: check_block,
}
"""The checks of declarations for which it does not matter what is drawn."""


def _is_in(span: Span, places: Sequence[Span]) -> bool:
    """True if a span is part of one of some places of the same text."""
    return any(
        span.source is place.source and place.start <= span.start and span.end <= place.end
        for place in places
    )


def _written(symbol: Symbol) -> int:
    """The number of characters of its declaration."""
    return symbol.declaration.span.end - symbol.declaration.span.start


def _is_material(symbol: Symbol) -> bool:
    declaration = symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.kind == "material"
