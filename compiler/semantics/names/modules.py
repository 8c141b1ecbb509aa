"""Files, imports and the names that each file can see.

A module sees its own declarations, what it imports, and everything the library's prelude declares.
Import paths are looked up beside the importing file (quoted ones) and in the search path, and never
lead out of the folder they start from.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Protocol

from ....frozen import fresh, frozen, record
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import nearest, respelling
from ...diagnostics.source import Source, Span
from ...syntax import ast
from ...syntax.rewriting import inserted_on_top
from ..types.generics import FAMILIES, of_unknown_family, uninferable
from ..types.typenames import described
from .duplicates import check_once

Named = (
    ast.Record | ast.Mixin | ast.Function | ast.Rig | ast.StructDeclaration
    | ast.ExternBlock | ast.ExternMember | ast.Space | ast.Constant
)  # fmt: skip


@frozen(eq=False)
class Symbol:
    """A declaration and the module whose names it sees; compared by identity."""

    declaration: Named
    module: Module

    @property
    def name(self) -> str:
        """The declared name."""
        return self.declaration.name.text


@record
class Module:
    """One file with everything it can name; functions may share a name (overloads)."""

    file: ast.File
    path: Path | None
    declared: dict[str, tuple[Symbol, ...]] = fresh(factory=dict)
    imported: dict[str, tuple[Symbol, ...]] = fresh(factory=dict)
    chosen: set[tuple[Path | None, str]] = fresh(factory=set)
    """Names that were imported one by one, with their files."""
    missing: set[str] = fresh(factory=set)
    """Names whose import failed, about which enough has been said."""
    incomplete: bool = False
    """Whether a file that was to be imported whole could not be, and its names are not known."""
    doubtful: dict[str, Callable[[], None]] = fresh(factory=dict)
    """Names that several imported files declare, with what reports them once they are used."""
    prelude: Module | None = None
    offered: Callable[[str], str] = lambda _name: ""
    """The library file that declares a name, as an import path; empty if none does."""

    def find(self, name: str) -> tuple[Symbol, ...]:
        """The declarations that ``name`` stands for here; empty if there are none."""
        if name in self.doubtful:
            self.doubtful.pop(name)()
        return self.known(name)

    def known(self, name: str) -> tuple[Symbol, ...]:
        """The same where nothing is made of it, so that no doubt about it has to be told."""
        found = self.declared.get(name) or self.imported.get(name)
        if not found and self.prelude is not None:
            found = self.prelude.declared.get(name)
        return found or ()

    def hint(self, name: ast.Name, known: Iterable[str]) -> Hint:
        """What to do about an unknown name: import it, or write the nearest known one."""
        path = self.offered(name.text)
        if not path:
            return respelling(name.text, name.span, known)
        declaration = f"import {path}.{{{name.text}}}"
        return inserted_on_top(f"add `{declaration}`", name.span.source, declaration)

    def visible(self) -> Iterator[str]:
        """All names that ``find`` knows."""
        yield from self.declared
        yield from self.imported
        if self.prelude is not None:
            yield from self.prelude.declared


_NOT_IMPORTED = frozenset({"prelude", "meaning", "spaces"})
"""Library files that every file sees, or none."""

Read = Callable[[Path, Report, str], Source | None]
"""Reads a file; the text is what messages call it."""

Parse = Callable[[Source, Report], ast.File]


class Looked(Protocol):
    """Is told of each place where an imported file was looked for."""

    def __call__(self, root: Path, path: Path, /, *, found: bool) -> None:
        """``path`` below ``root`` was looked at; ``found`` says whether a file is there."""


@record
class _Linking:
    """A module whose imports are being read."""

    module: Module
    imports: list[ast.Import]
    """Those that are left, the last one first."""
    path: Path | None = None
    """Where it was read from, if another module imports it."""
    wanted: ast.Import | None = None
    """By what that module does."""


class Loader:
    """Reads and links modules; each file once."""

    def __init__(
        self,
        report: Report,
        library: Path,
        search_path: Sequence[Path],
        parse: Parse,
        parse_library: Parse,
        read: Read,
        looked: Looked,
    ) -> None:
        self._report = report
        self._library = library
        self._search_path = tuple(search_path)
        self._parse = parse
        self._parse_library = parse_library
        self._read = read
        self._looked = looked
        self._modules: dict[Path, Module] = {}
        self._loading: list[tuple[Path, Span]] = []
        self._prelude: Module | None = None
        self._offers: dict[str, str] | None = None
        self._real: dict[Path, Path] = {}
        """Folders without links, as far as anybody has asked: the system goes through all of a path
        each time."""

    @property
    def files(self) -> tuple[Path, ...]:
        """The imported files that were read."""
        return tuple(self._modules)

    def prelude(self) -> Module:
        """The library module whose names every other module sees."""
        if self._prelude is None:
            path = self._library / "prelude.burnish"
            source = self._read(path, self._report, _library_name(path))
            assert source is not None, "the library has no prelude"
            # Known before it is linked: the library files that it imports see it as well.
            self._prelude = Module(self._parse_library(source, self._report), path)
            self._link(self._prelude)
        return self._prelude

    def main(self, source: Source, path: Path | None) -> Module:
        """The module that a user compiles."""
        prelude = self.prelude()
        if path is not None:
            self._loading.append((path.resolve(), Span(source, 0, 0)))
        module = Module(
            self._parse(source, self._report), path, prelude=prelude, offered=self._offering
        )
        self._link(module)
        return module

    def _link(self, module: Module) -> None:
        """Give a module its names, and those that it imports, file after file.

        Files import each other without limit, so those whose imports are not all known yet wait in
        a list.
        """
        pending = [_Linking(module, self._declared(module))]
        while pending:
            top = pending[-1]
            if top.imports:
                wanted = top.imports.pop()
                found = self._resolve(top.module, wanted)
                if isinstance(found, _Linking):
                    pending.append(found)
                else:
                    self._import(top.module, wanted, found)
                continue
            pending.pop()
            if top.path is not None:
                assert top.wanted is not None
                self._loading.pop()
                self._modules[top.path] = top.module
                self._import(pending[-1].module, top.wanted, top.module)

    def _declared(self, module: Module) -> list[ast.Import]:
        """Give a module its own names; its imports, the last one first."""
        imports: list[ast.Import] = []
        for declaration in module.file.declarations:
            if isinstance(declaration, ast.Import):
                imports.append(declaration)
            else:
                self._declare(module, declaration)
        # Names that are asked for come first: they decide between files that are imported whole.
        return sorted(imports, key=lambda wanted: wanted.names is None)[::-1]

    def _declare(self, module: Module, declaration: Named) -> None:
        _check_readable(self._report, declaration)
        _check_inside(self._report, declaration)
        name = declaration.name
        others = module.declared.get(name.text, ())
        overload = isinstance(declaration, ast.Function) and all(
            isinstance(other.declaration, ast.Function) for other in others
        )
        if others and not overload:
            first = others[0].declaration.name.span
            self._report.add(
                rules.DUPLICATE_NAME, name.span, name=name.text,
                labels=[Label(first, "first declared here")],
            )  # fmt: skip
            return
        if isinstance(declaration, ast.Function):
            self._check_function(declaration, others)
        module.declared[name.text] = (*others, Symbol(declaration, module))
        if isinstance(declaration, ast.ExternBlock):
            for member in declaration.members:
                self._declare(module, member)

    def _check_function(self, function: ast.Function, others: tuple[Symbol, ...]) -> None:
        """What is wrong with a function's head, whatever its types stand for."""
        if function.per is not None and function.per.text != "light":
            self._report.add(
                rules.UNKNOWN_NAME, function.per.span, kind="summation", name=function.per.text,
                hint=fix_it("terms are summed `per light`", (function.per.span, "light")),
            )  # fmt: skip
        for parameter in of_unknown_family(function):
            listed = ", ".join(f"`{family}`" for family in FAMILIES)
            self._report.add(
                rules.UNKNOWN_NAME, parameter.family.span, kind="family of types",
                name=parameter.family.text,
                hint=respelling(parameter.family.text, parameter.family.span, FAMILIES)
                or f"one of {listed}",
            )  # fmt: skip
        for parameter in uninferable(function):
            self._report.add(
                rules.UNINFERABLE_PARAMETER, parameter.span, name=parameter.name.text,
                function=function.name.text,
            )  # fmt: skip
        for other in others:
            if _argument_types(other.declaration) == _argument_types(function):
                self._report.add(
                    rules.DUPLICATE_NAME, function.name.span, name=function.name.text,
                    labels=[Label(other.declaration.name.span, "with the same arguments here")],
                )  # fmt: skip

    def _import(self, module: Module, wanted: ast.Import, found: Module | None) -> None:
        """Give a module the names that it imports from one that was ``found``."""
        names = wanted.names
        if found is None:
            module.missing.update(name.text for name in names or ())
            module.incomplete |= names is None
            return
        if names is None:
            self._import_whole(module, found, wanted.span)
            return
        for name in names:
            symbols = found.declared.get(name.text)
            if symbols is None:
                hint = respelling(name.text, name.span, found.declared)
                meant = "" if isinstance(hint, str) else hint.fixes[0].edits[0].text
                module.missing.update((name.text, meant or name.text))
                self._report.add(
                    rules.UNKNOWN_EXPORT, name.span, name=name.text, path=found.file.source.name,
                    hint=hint,
                )  # fmt: skip
            else:
                known = module.imported.setdefault(name.text, symbols)
                if known is not symbols:
                    self._tell_ambiguous(known[0], name.span)
                module.chosen.add((found.path, name.text))

    def _import_whole(self, module: Module, found: Module, span: Span) -> None:
        """Everything a file declares; of two files with the same name, one has to be chosen."""
        for name, symbols in found.declared.items():
            known = module.imported.setdefault(name, symbols)
            other = known[0].module
            if other is found or name in module.declared or (other.path, name) in module.chosen:
                continue
            module.doubtful[name] = partial(self._tell_ambiguous, known[0], span)

    def _tell_ambiguous(self, other: Symbol, span: Span) -> None:
        labels = [Label(other.declaration.name.span, "the other one")]
        self._report.add(
            rules.AMBIGUOUS_NAME, span, name=other.name, labels=labels,
            hint=f"ask for the one that is meant: `import ….{{{other.name}}}`",
        )  # fmt: skip

    def _resolve(self, module: Module, wanted: ast.Import) -> Module | _Linking | None:
        """The module that an import is about, if need be before it is linked."""
        relative = wanted.path[0] if wanted.quoted else "/".join(wanted.path) + ".burnish"
        if PurePosixPath(relative).is_absolute() or ".." in PurePosixPath(relative).parts:
            self._report.add(rules.IMPORT_ESCAPES, wanted.span, path=relative)
            return None
        for root, inside in self._roots(module, wanted, relative):
            found = root / inside
            path = found.resolve()
            if not path.is_relative_to(self._resolved(root)):
                self._report.add(rules.IMPORT_ESCAPES, wanted.span, path=relative)
                return None
            is_file = path.is_file()
            self._looked(root, found, found=is_file)
            if is_file:
                return self._load(found, path, wanted)
        self._report.add(
            rules.MISSING_IMPORT, wanted.span, path=relative, hint=self._suggest(wanted)
        )
        return None

    def _resolved(self, folder: Path) -> Path:
        """A folder that files are looked for in, without links."""
        if folder not in self._real:
            self._real[folder] = folder.resolve()
        return self._real[folder]

    def _roots(
        self, module: Module, wanted: ast.Import, relative: str
    ) -> Iterator[tuple[Path, str]]:
        if not wanted.quoted and wanted.path[0] == "std":
            yield self._library, relative.removeprefix("std/")
            return
        if module.path is not None:
            yield module.path.parent, relative
        for root in self._search_path:
            yield root, relative

    def _offering(self, name: str) -> str:
        """The import path of the library file that declares a name; empty if none does."""
        if self._offers is None:
            self._offers = dict(reversed(list(self._offered())))
        return self._offers.get(name, "")

    def _offered(self) -> Iterator[tuple[str, str]]:
        """The names that library files declare, each with the import path of its file."""
        for path in sorted(self._library.glob("*.burnish")):
            if path.stem in _NOT_IMPORTED:
                continue
            source = self._read(path, self._report, _library_name(path))
            tree = None if source is None else self._parse_library(source, self._report)
            for declaration in () if tree is None else tree.declarations:
                if not isinstance(declaration, ast.Import):
                    yield declaration.name.text, f"std.{path.stem}"

    def _suggest(self, wanted: ast.Import) -> Hint:
        if wanted.quoted:
            path = wanted.path[0]
            whole = path.endswith(".burnish")
            ending = f'"{path}.burnish"'
            return (
                ""
                if whole
                else _instead(f"the ending belongs to the path: `{ending}`", wanted, ending)
            )
        *folder, name = wanted.path
        if folder and self._offering(name) == ".".join(folder):
            declaration = f"{'.'.join(folder)}.{{{name}}}"
            return _instead(f"write `import {declaration}`", wanted, declaration)
        if wanted.path[0] != "std":
            return ""
        stems = {path.stem for path in self._library.glob("*.burnish")} - _NOT_IMPORTED
        modules = (f"std.{stem}" for stem in stems)
        near = nearest(".".join(wanted.path), sorted(modules))
        return "" if near is None else _instead(f"did you mean `{near}`?", wanted, near)

    def _load(self, found: Path, path: Path, wanted: ast.Import) -> Module | _Linking | None:
        if path in self._modules:
            return self._modules[path]
        pending = [loading for loading, _ in self._loading]
        if path in pending:
            cycle = [*pending[pending.index(path) :], path]
            self._report.add(
                rules.IMPORT_CYCLE, wanted.span, cycle=" → ".join(step.name for step in cycle)
            )
            return None
        library = path.is_relative_to(self._resolved(self._library))
        shown = _library_name(path) if library else str(found)
        source = self._read(path, self._report, shown)
        if source is None:
            return None
        self._loading.append((path, wanted.span))
        parse = self._parse_library if library else self._parse
        module = Module(parse(source, self._report), path, prelude=self.prelude())
        return _Linking(module, self._declared(module), path, wanted)


def _instead(said: str, wanted: ast.Import, path: str) -> Hint:
    """A hint to import ``path``; the names that are wanted of it stay."""
    span = wanted.span
    written = re.match(r"import\s+(\"[^\"\n]*\"|[\w.]*\w)", span.text)
    if written is None:
        return said
    place = Span(span.source, span.start + written.start(1), span.start + written.end(1))
    return fix_it(said, (place, path))


_MEANT_OTHERWISE: Mapping[str, str] = {
    "material": "`material.name` is a slot of the material that is drawn",
    "inherited": "`inherited.name` is what a base says of a slot",
}
"""Names that stand for something wherever records are described."""


def _check_readable(report: Report, declaration: Named) -> None:
    """A declaration, or a member of a record, must not have a name that means something else."""
    names: list[ast.Name] = []
    match declaration:
        case ast.Record(members=members) | ast.Mixin(members=members):
            names = [member.name for member in members if ast.is_read(member)]
        case ast.Function() | ast.Constant() | ast.StructDeclaration() | ast.ExternMember():
            names = [declaration.name]
    for name in names:
        if name.text in _MEANT_OTHERWISE:
            report.add(
                rules.UNREADABLE_NAME, name.span, name=name.text, hint=_MEANT_OTHERWISE[name.text]
            )


def _check_inside(report: Report, declaration: Named) -> None:
    """Names that a declaration gives to its parts, each once."""
    match declaration:
        case ast.StructDeclaration(members=members):
            check_once(report, (member.name for member in members))
        case ast.Function():
            check_once(report, (variable.name for variable in declaration.type_parameters))
            arguments = [argument.name for argument in declaration.arguments]
            check_once(report, [*arguments, *(part.name for part in declaration.parts)])
        case ast.Rig():
            for entry in declaration.entries:
                check_once(report, (override.name for override in entry.overrides))


def _library_name(path: Path) -> str:
    """What messages call a library file, wherever it is installed."""
    return f"std/{path.name}"


def _argument_types(declaration: Named) -> list[str]:
    assert isinstance(declaration, ast.Function)
    return [described(argument.type) for argument in declaration.arguments]
