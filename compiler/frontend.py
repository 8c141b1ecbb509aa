"""Compiles a file to its shaders: one for each concrete material."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from .diagnostics import rules
from .diagnostics.diagnostic import Report
from .diagnostics.nearest import suggestion
from .diagnostics.source import Span
from .inputs import Inputs
from .ir.shader import Shader
from .library import FOLDER, standard_library
from .opening import Opening
from .semantics.inheritance.flattening import Records, records_of
from .semantics.inheritance.ties import Tie, draws_as, tie_of
from .semantics.names.modules import Module, Symbol
from .semantics.names.standard_library import StandardLibrary
from .semantics.shading.assembly import Parts, Setting, set_up
from .semantics.shading.elaborate import elaborate
from .semantics.shading.known_right import KNOWN_RIGHT, NOTHING_KNOWN
from .semantics.shading.room import has_room
from .semantics.shading.unused import CandidateContexts, UnusedDeclarations
from .syntax import ast
from .watching import is_watched

if TYPE_CHECKING:
    from .ir.frame import Frame
    from .ir.functions import FunctionsAsked, FunctionsShader
    from .semantics.equations.model import Equations


def current_library() -> StandardLibrary:
    """The library as its files are now: the same record for as long as none of them changes."""
    return standard_library(FOLDER)


_NOT_OWN = {
    kind: f"the file declares no {kind}; without `--{kind}` the library's is taken"
    for kind in ("rig", "pass")
}

_LIT_BY = (
    "an engine lights a surface by slots such as `base_color` and `roughness`; of a slot with "
    "another name, say what it is: `--slots base_color=stain`"
)


class Frontend:
    """Reads one file with its imports and elaborates its materials."""

    def __init__(
        self, report: Report, search_path: Sequence[Path] = (), inputs: Inputs | None = None
    ) -> None:
        """``inputs`` has a note of everything that is read, or has it all from an earlier time."""
        self._report = report
        self._records = Records(report)
        self._library = current_library()
        self._opening = Opening(report, self._library, search_path, inputs or Inputs())

    def open_file(self, path: Path) -> Module | None:
        """The module in a file; ``None`` after reporting that it cannot be read, or is too much."""
        return self._opening.open_file(path)

    def open_text(self, text: str, name: str) -> Module | None:
        """The module in a text; its quoted imports are looked up along the search path.

        ``None`` after reporting that the text does not consist of characters, or is too much.
        """
        return self._opening.open_text(text, name)

    @property
    def files(self) -> tuple[Path, ...]:
        """The files imported so far, down to those of the library."""
        return self._opening.files

    def shaders(
        self, module: Module, material: str | None, rig: str | None, pass_: str | None
    ) -> list[Shader]:
        """The shaders of all concrete materials, or of the named one; errors are in the report.

        A named one is compiled alone: only the declarations that it uses are checked. Otherwise all
        declarations of the file are.
        """
        kernels = records_of(module, "kernel", abstract=False)
        if material is not None:
            kernels = [kernel for kernel in kernels if kernel.name == material]
        if kernels and (material is not None or not _materials_of(module)):
            if material is None:
                drawn = [(symbol, self._forward()) for symbol in self._rigs_of(module)]
                self._check_unused(module, drawn, (), set())
            return self._kernels(module, kernels)
        parts = self._parts(module, material, rig, pass_)
        if parts is None:
            return []
        rig_symbol, named, materials = parts
        pass_symbol = named or self._forward()
        reached: set[Symbol] = set()
        found = list(self._elaborated(module, rig_symbol, named, materials, reached))
        settings = [setting for setting, _shader in found]
        if material is None:
            rigs = dict.fromkeys([rig_symbol, *self._rigs_of(module)])
            drawn = list(product(rigs, dict.fromkeys([pass_symbol, self._forward()])))
            self._check_unused(module, drawn, settings, reached)
        drawn_shaders = [shader for _setting, shader in found if shader is not None]
        return [*drawn_shaders, *self._kernels(module, kernels)]

    def equations(
        self, module: Module, material: str | None, rig: str | None, pass_: str | None
    ) -> list[Equations]:
        """The graphs of the own equations of materials, as ``shaders`` chooses among these.

        Errors are in the report.
        """
        from .semantics.equations.building import equations_of

        found = self.assembled(module, material, rig, pass_)
        return [equations_of(setting) for setting, _shader in found]

    def assembled(
        self, module: Module, material: str | None, rig: str | None, pass_: str | None
    ) -> list[tuple[Setting, Shader]]:
        """The materials that ``shaders`` chooses, as they are checked, each with its shader.

        Errors are in the report.
        """
        parts = self._parts(module, material, rig, pass_)
        if parts is None:
            return []
        found = self._elaborated(module, *parts, set())
        return [(setting, shader) for setting, shader in found if shader is not None]

    def functions(
        self, module: Module, material: str | None, rig: str | None, asked: FunctionsAsked
    ) -> list[FunctionsShader]:
        """The slots of the materials of a file as functions, or of the named one.

        Errors are in the report. Without a name of a rig, lights are those of any.
        """
        from .semantics.shading.functions import functions_of, read_slots

        def read(setting: Setting) -> None:
            read_slots(setting, asked)

        materials = self._materials(module, material)
        lights = self._rigs_of(module)[0] if rig is None else self._rig(module, rig)
        if lights is None:
            return []
        made, without = [], []
        for setting, shader in self._elaborated(module, lights, None, materials, set(), read):
            if shader is None:
                continue
            before = setting.ctx.report.count
            found = functions_of(setting, shader, asked)
            self._report.extend(setting.ctx.report.since(before))
            if found is not None:
                made.append(found)
            elif not setting.ctx.report.failed:
                without.append(setting.parts.material)
        rule = rules.LEFT_OUT if made else rules.NO_FUNCTIONS
        hint = _LIT_BY if asked.offers else ""
        for each in () if self._report.failed else without:
            self._report.add(rule, each.declaration.name.span, name=each.name, hint=hint)
        return made

    def _parts(
        self, module: Module, material: str | None, rig: str | None, pass_: str | None
    ) -> tuple[Symbol, Symbol | None, list[Symbol]] | None:
        """The rig, the pass and the materials that are asked for; ``None`` if one is unknown.

        The pass is ``None`` where none is named: then each material has its own.
        """
        materials = self._materials(module, material)
        rig_symbol = self._rig(module, rig)
        pass_symbol = self._pass(module, pass_)
        if rig_symbol is None or pass_symbol is None:
            return None
        return rig_symbol, None if pass_ is None else pass_symbol, materials

    def _elaborated(
        self,
        module: Module,
        rig: Symbol,
        named: Symbol | None,
        materials: Iterable[Symbol],
        reached: set[Symbol],
        first: Callable[[Setting], None] | None = None,
    ) -> Iterator[tuple[Setting, Shader | None]]:
        """Yields materials put together, each with its shader; ``None`` where errors are found.

        ``first`` is called with each before anything of it is checked.

        Without a ``named`` pass, each is drawn by the one that it is tied to, or by the library's.
        """
        for material in materials:
            if not has_room(material, self._records, self._report):
                return
            tie = tie_of(material, self._records, self._report)
            own = self._forward() if tie is None else tie.pass_
            if tie is not None and named is not None and not draws_as(named, tie, self._records):
                self._report.add(
                    rules.OTHER_PASS, tie.name.span,
                    name=material.name, tied=own.name, pass_=named.name,
                )  # fmt: skip
            parts = Parts(material, rig, named or own, module)
            setting = set_up(parts, self._report.apart(), self._records)
            if first is not None:
                first(setting)
            shader = elaborate(setting, reached)
            self._report.extend(setting.ctx.report.since(0))
            yield setting, shader

    def has_frames(self, module: Module, wanted: str | None) -> bool:
        """True if a file is compiled to its frames: it has some, and no material is asked for."""
        return bool(_wanted_frames(module, wanted))

    def frames(self, module: Module, wanted: str | None, rig: str | None) -> list[Frame]:
        """The frames of a file, or the one named; errors are in the report.

        Everything that the file declares is checked, unless a frame is named.
        """
        lights = self._rig(module, rig)
        if lights is None:
            return []
        reached: set[Symbol] = set()
        found = self._frames(module, _wanted_frames(module, wanted), lights, reached)
        if wanted is None:
            self._check_beside(module, lights, reached)
        return found

    def _frames(
        self, module: Module, frames: Sequence[Symbol], lights: Symbol, reached: set[Symbol]
    ) -> list[Frame]:
        """The frames that can be made of some declarations; errors are in the report."""
        if not frames:
            return []
        from .semantics.frames.frames import Surroundings, frame_of

        around = Surroundings(module, lights, self._report, self._records, reached)
        found = [frame_of(symbol, around) for symbol in frames]
        return [frame for frame in found if frame is not None]

    def _check_beside(self, module: Module, rig: Symbol, reached: set[Symbol]) -> None:
        """Checks the declarations of a file that no frame of it uses."""
        rigs = dict.fromkeys([rig, *self._rigs_of(module)])
        drawn = list(product(rigs, [self._forward()]))
        self._check_unused(module, drawn, (), reached)
        kernels = records_of(module, "kernel", abstract=False)
        self._kernels(module, [kernel for kernel in kernels if kernel not in reached])

    def _kernels(self, module: Module, kernels: Sequence[Symbol]) -> list[Shader]:
        """The shaders of kernels."""
        if not kernels:
            return []
        from .semantics.shading.kernels.kernel import kernel_shader

        found: list[Shader] = []
        for kernel in kernels:
            report = self._report.apart()
            shader = kernel_shader(kernel, module, report, self._records)
            self._report.extend(report.since(0))
            found += [] if shader is None else [shader]
        return found

    def declared(self, module: Module, kind: str) -> tuple[str, ...]:
        """The names of a file's declarations of a kind, such as ``frame``; not of abstract ones."""
        found = _rigs(module) if kind == "rig" else records_of(module, kind, abstract=False)
        return tuple(symbol.name for symbol in found)

    def variants(self, module: Module) -> Iterator[tuple[str | None, str | None]]:
        """Names of a rig and a pass under which the module's materials can be drawn.

        Each of its own rigs, with the pass of each material (``None``), and with each of its passes
        that is no material's.
        """
        rigs: list[str | None] = [symbol.name for symbol in _rigs(module)]
        passes = records_of(module, "pass", abstract=False)
        tied = {tie.pass_ for tie in self._ties(module).values()}
        free = (symbol.name for symbol in passes if symbol not in tied)
        yield from product(rigs or (None,), (None, *free))

    def ties(self, module: Module) -> Mapping[str, str]:
        """The names of the passes to which the module's materials are tied."""
        return {name: tie.pass_.name for name, tie in self._ties(module).items()}

    def _ties(self, module: Module) -> Mapping[str, Tie]:
        materials = records_of(module, "material", abstract=False)
        found = ((m.name, tie_of(m, self._records, self._report.apart())) for m in materials)
        return {name: tie for name, tie in found if tie is not None}

    def told_apart_by(self, module: Module, rig: str | None, pass_: str | None) -> tuple[str, ...]:
        """The names of the pass and the rig, each only if it draws because it was named.

        So whatever is drawn under other ones has another list of names. All names must be known.
        """
        chosen = () if pass_ is None or self._pass(module, pass_) == self._forward() else (pass_,)
        own = _rigs(module)
        by_default = None if len(own) > 1 else self._rigs_of(module)[0]
        if rig is None or self._rig(module, rig) == by_default:
            return chosen
        return (*chosen, rig)

    def check(self, module: Module, rig: str | None, pass_: str | None) -> list[Frame]:
        """Reports the errors of a file, which needs no materials: it may be for importing.

        Returns its frames: ``entry_points.py`` reports errors that only their programs show. Its
        materials need not agree with each of its rigs, unless one is named.
        """
        if not module.declared:
            self._materials(module, None)
        rigs = [self._rig(module, rig)] if rig is not None else self._rigs_of(module)
        pass_symbol = self._pass(module, pass_)
        drawn = [(symbol, pass_symbol) for symbol in rigs if symbol and pass_symbol]
        reached: set[Symbol] = set()
        frames: list[Frame] = []
        if rigs and (lights := rigs[0]) is not None:
            frames = self._frames(module, _wanted_frames(module, None), lights, reached)
        if drawn:
            self._check_unused(module, drawn, (), reached, by_ties=pass_ is None)
        self._kernels(module, records_of(module, "kernel", abstract=False))
        return frames

    def _check_unused(
        self,
        module: Module,
        drawn: list[tuple[Symbol, Symbol]],
        settings: Iterable[Setting],
        reached: set[Symbol],
        *,
        by_ties: bool = True,
    ) -> None:
        """Checks declarations that have not been reached, if possible with the pairs in ``drawn``.

        These are rigs and passes. ``by_ties`` is that of ``CandidateContexts``.
        """
        prelude = self._library.prelude
        materials = _materials_of(module)
        rigs = [*(rig for rig, _ in drawn), *self._rigs_of(module)]
        lights = [*rigs, *records_of(module, "light", abstract=False), *_rigs(prelude)]
        around = CandidateContexts(
            materials=tuple(materials or _materials_of(prelude)),
            lights=tuple(dict.fromkeys(filter(_shines, lights))),
            rigs=tuple(dict.fromkeys(rigs)),
            passes=tuple(dict.fromkeys([*(pass_ for _, pass_ in drawn), self._forward()])),
            drawn=tuple(drawn),
            by_ties=by_ties,
        )
        known = NOTHING_KNOWN if is_watched() else KNOWN_RIGHT
        unused = UnusedDeclarations(
            module, around, settings, reached, self._report, self._records, known
        )
        unused.check()

    def _materials(self, module: Module, wanted: str | None) -> list[Symbol]:
        concrete = records_of(module, "material", abstract=False)
        if wanted is None:
            if not concrete and not self._report.failed:
                unfinished = records_of(module, "material", abstract=True)
                hint = (
                    f"`{unfinished[0].name}` is abstract: declare a material that extends it"
                    if unfinished
                    else ""
                )
                path = module.file.source.name
                self._report.add(rules.NO_MATERIAL, _whole(module), path=path, hint=hint)
            return concrete
        named = [symbol for symbol in _materials_of(module) if symbol.name == wanted]
        if not named:
            self._unknown(module, "material", wanted, [symbol.name for symbol in concrete])
        return [symbol for symbol in named if self._is_concrete(symbol)]

    def _rig(self, module: Module, wanted: str | None) -> Symbol | None:
        own = _rigs(module)
        if wanted is not None:
            found = [s for s in module.find(wanted) if isinstance(s.declaration, ast.Rig)]
            if not found:
                self._unknown(module, "rig", wanted, [symbol.name for symbol in own])
            return found[0] if found else None
        if len(own) > 1:
            known = ", ".join(f"`{symbol.name}`" for symbol in own)
            self._report.add(rules.NO_SUCH_RIG, own[1].declaration.name.span, known=known)
            return None
        return self._rigs_of(module)[0]

    def _rigs_of(self, module: Module) -> list[Symbol]:
        """A file's own rigs, or the library's where it has none."""
        return _rigs(module) or _rigs(self._library.prelude)

    def _pass(self, module: Module, wanted: str | None) -> Symbol | None:
        if wanted is None:
            return self._forward()
        found = [
            symbol
            for symbol in module.find(wanted)
            if isinstance(d := symbol.declaration, ast.Record) and d.kind == "pass"
        ]
        if not found:
            known = records_of(module, "pass", abstract=False)
            self._unknown(module, "pass", wanted, [symbol.name for symbol in known])
            return None
        return found[0] if self._is_concrete(found[0]) else None

    def _is_concrete(self, named: Symbol) -> bool:
        """True if a material or pass that was asked for can be drawn; reported if not."""
        declaration = named.declaration
        abstract = isinstance(declaration, ast.Record) and declaration.abstract
        if abstract:
            self._report.add(rules.ABSTRACT_USE, declaration.name.span, name=named.name)
        return not abstract

    def _forward(self) -> Symbol:
        """The library's pass, which draws unless another is named."""
        (forward,) = records_of(self._library.prelude, "pass", abstract=False)
        return forward

    def _unknown(self, module: Module, kind: str, name: str, known: list[str]) -> None:
        """Report a name that was asked for, and that a file does not declare."""
        own = f"there is {', '.join(known)}" if known else _NOT_OWN.get(kind, "")
        hint = suggestion(name, known) or own
        self._report.add(rules.UNKNOWN_NAME, _whole(module), kind=kind, name=name, hint=hint)


def _rigs(module: Module) -> list[Symbol]:
    return [
        symbols[0]
        for symbols in module.declared.values()
        if isinstance(symbols[0].declaration, ast.Rig)
    ]


def _materials_of(module: Module) -> list[Symbol]:
    """All materials that a file declares, concrete ones first."""
    return [
        m for abstract in (False, True) for m in records_of(module, "material", abstract=abstract)
    ]


def _wanted_frames(module: Module, wanted: str | None) -> list[Symbol]:
    """The frames of a file that are compiled."""
    frames = records_of(module, "frame", abstract=False)
    return [frame for frame in frames if wanted is None or frame.name == wanted]


def _shines(symbol: Symbol) -> bool:
    """True if a rig has lights; a light counts as a rig of one."""
    return not isinstance(symbol.declaration, ast.Rig) or bool(symbol.declaration.entries)


def _whole(module: Module) -> Span:
    return Span(module.file.source, 0, 0)
