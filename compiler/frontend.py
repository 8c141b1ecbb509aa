"""From a file to the shaders it stands for: one for each concrete material."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path

from .diagnostics import rules
from .diagnostics.diagnostic import Report
from .diagnostics.nearest import suggestion
from .diagnostics.source import Source, Span
from .library import FOLDER, parse_library
from .semantics.elaborate import Parts, elaborate
from .semantics.modules import Loader, Module, Symbol
from .semantics.records import Records, records_of, sole
from .semantics.shader import Shader
from .syntax import ast
from .syntax.load import load_source
from .syntax.parser import parse

_NOT_OWN = {
    kind: f"the file declares no {kind}; without `--{kind}` the library's is taken"
    for kind in ("rig", "pass")
}


class Frontend:
    """Reads one file with its imports and elaborates its materials."""

    def __init__(self, report: Report, search_path: Sequence[Path] = ()) -> None:
        self._report = report
        self._records = Records(report)
        self._loader = Loader(report, FOLDER, search_path, parse, parse_library, load_source)

    def open_file(self, path: Path) -> Module | None:
        """The module in a file; ``None`` after reporting that it cannot be read."""
        source = load_source(path, self._report)
        return None if source is None else self._loader.main(source, path)

    def open_text(self, text: str, name: str) -> Module:
        """The module in a text; its quoted imports are looked up along the search path."""
        return self._loader.main(Source(name, text), None)

    @property
    def files(self) -> tuple[Path, ...]:
        """The files imported so far, down to those of the library."""
        return self._loader.files

    def shaders(
        self, module: Module, material: str | None, rig: str | None, pass_: str | None
    ) -> list[Shader]:
        """The shaders of all concrete materials, or of the one named; errors are in the report."""
        return self._elaborate(module, self._materials(module, material), rig, pass_)

    def variants(self, module: Module) -> Iterator[tuple[str | None, str | None]]:
        """Names of a rig and a pass under which the module's materials can be drawn.

        Each of its own rigs, with each of its own passes and the library's (``None``).
        """
        rigs: list[str | None] = [symbol.name for symbol in _rigs(module)]
        passes = (symbol.name for symbol in records_of(module, "pass", abstract=False))
        yield from product(rigs or (None,), (None, *passes))

    def check(self, module: Module, rig: str | None, pass_: str | None) -> None:
        """Report what is wrong with a file, which needs no materials: it may be for importing."""
        materials = records_of(module, "material", abstract=False)
        if not materials and module.declared:
            root = sole(self._loader.prelude(), "material", abstract=True)
            materials = [] if root is None else [root]
        elif not materials:
            materials = self._materials(module, None)
        self._elaborate(module, materials, rig, pass_)

    def _elaborate(
        self, module: Module, materials: list[Symbol], rig: str | None, pass_: str | None
    ) -> list[Shader]:
        rig_symbol = self._rig(module, rig)
        pass_symbol = self._pass(module, pass_)
        if rig_symbol is None or pass_symbol is None:
            return []
        found = (
            elaborate(Parts(symbol, rig_symbol, pass_symbol, module), self._report, self._records)
            for symbol in materials
        )
        return [shader for shader in found if shader is not None]

    def _materials(self, module: Module, wanted: str | None) -> list[Symbol]:
        concrete = records_of(module, "material", abstract=False)
        if wanted is None:
            if not concrete and not self._report.failed:
                unfinished = records_of(module, "material", abstract=True)
                hint = f"`{unfinished[0].name}` is abstract: declare an heir" if unfinished else ""
                path = module.file.source.name
                self._report.add(rules.NO_MATERIAL, _whole(module), path=path, hint=hint)
            return concrete
        named = [symbol for symbol in concrete if symbol.name == wanted]
        if not named:
            self._unknown("material", wanted, [symbol.name for symbol in concrete])
        return named

    def _rig(self, module: Module, wanted: str | None) -> Symbol | None:
        own = _rigs(module)
        if wanted is not None:
            found = [s for s in module.find(wanted) if isinstance(s.declaration, ast.Rig)]
            if not found:
                self._unknown("rig", wanted, [symbol.name for symbol in own])
            return found[0] if found else None
        if len(own) > 1:
            known = ", ".join(f"`{symbol.name}`" for symbol in own)
            self._report.add(rules.NO_SUCH_RIG, own[1].declaration.name.span, known=known)
            return None
        (chosen,) = own or _rigs(self._loader.prelude())
        return chosen

    def _pass(self, module: Module, wanted: str | None) -> Symbol | None:
        if wanted is None:
            return sole(self._loader.prelude(), "pass", abstract=False)
        found = [
            symbol
            for symbol in module.find(wanted)
            if isinstance(d := symbol.declaration, ast.Record) and d.kind == "pass"
        ]
        if not found:
            known = records_of(module, "pass", abstract=False)
            self._unknown("pass", wanted, [symbol.name for symbol in known])
            return None
        return found[0]

    def _unknown(self, kind: str, name: str, known: list[str]) -> None:
        own = f"there is {', '.join(known)}" if known else _NOT_OWN.get(kind, "")
        hint = suggestion(name, known) or own
        self._report.add(rules.UNKNOWN_NAME, None, kind=kind, name=name, hint=hint)


def _rigs(module: Module) -> list[Symbol]:
    return [
        symbols[0]
        for symbols in module.declared.values()
        if isinstance(symbols[0].declaration, ast.Rig)
    ]


def _whole(module: Module) -> Span:
    return Span(module.file.source, 0, 0)
