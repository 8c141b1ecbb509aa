"""Gives a module the names that its file declares, and reports declarations that cannot be.

``loader.py`` and ``standard_library.py`` call ``declare_all`` for each file that was parsed, before
its imports are looked up.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.fixes import fix_it
from ...diagnostics.nearest import respelling
from ...syntax import ast
from ..types.generics import FAMILIES, of_unknown_family, uninferable
from ..types.typenames import described
from .duplicates import check_once
from .modules import Module, Named, Symbol

_PROGRAMS = ("material", "kernel", "frame")
"""The kinds of records whose names are those of files that the command line writes."""
_Heads = dict[tuple[str, ...], dict[str, ast.Name]]
"""The functions declared so far, by name and types of arguments, each with where it stands."""


def declare_all(module: Module, report: Report) -> list[ast.Import]:
    """Give a module the names that its file declares; returns its imports in the order of work."""
    imports: list[ast.Import] = []
    heads: _Heads = {}
    for declaration in module.file.declarations:
        if isinstance(declaration, ast.Import):
            imports.append(declaration)
        else:
            _declare(module, declaration, heads, report)
    _check_files(module, report)
    # Names that are asked for come first: they decide between files that are imported whole.
    return sorted(imports, key=lambda wanted: wanted.names is None)


def _declare(module: Module, declaration: Named, heads: _Heads, report: Report) -> None:
    _check_readable(report, declaration)
    _check_inside(report, declaration)
    name = declaration.name
    others = module.declared.get(name.text, ())
    overloads = isinstance(declaration, ast.Function)
    if others and not (overloads and isinstance(others[0].declaration, ast.Function)):
        first = others[0].declaration.name.span
        report.add(
            rules.DUPLICATE_NAME, name.span, name=name.text,
            labels=[Label(first, "first declared here")],
            hint="a file has one declaration of a name, whatever it declares: give one of the two "
            "another name",
        )  # fmt: skip
        return
    if isinstance(declaration, ast.Function):
        _check_function(declaration, report)
        _check_overload(declaration, heads, report)
    module.declared[name.text] = (*others, Symbol(declaration, module))
    if isinstance(declaration, ast.ExternBlock):
        for member in declaration.members:
            _declare(module, member, heads, report)


def _check_files(module: Module, report: Report) -> None:
    """Warns of programs of which some systems cannot tell the files apart."""
    programs: dict[str, ast.Name] = {}
    for name, (symbol, *_) in module.declared.items():
        declaration = symbol.declaration
        if not isinstance(declaration, ast.Record) or declaration.abstract:
            continue
        if declaration.kind in _PROGRAMS:
            first = programs.setdefault(name.casefold(), declaration.name)
            if first is not declaration.name:
                report.add(
                    rules.CASE_OF_NAMES, declaration.name.span, name=name, first=first.text,
                    labels=[Label(first.span, "this one")],
                )  # fmt: skip


def _check_function(function: ast.Function, report: Report) -> None:
    """Reports errors in a function's head, whatever its types stand for."""
    if function.per is not None and function.per.text != "light":
        report.add(
            rules.UNKNOWN_NAME, function.per.span, kind="summation", name=function.per.text,
            hint=fix_it("terms are summed `per light`", (function.per.span, "light")),
        )  # fmt: skip
    for parameter in of_unknown_family(function):
        listed = ", ".join(f"`{family}`" for family in FAMILIES)
        report.add(
            rules.UNKNOWN_NAME, parameter.family.span, kind="family of types",
            name=parameter.family.text,
            hint=respelling(parameter.family.text, parameter.family.span, FAMILIES)
            or f"one of {listed}",
        )  # fmt: skip
    for parameter in uninferable(function):
        report.add(
            rules.UNINFERABLE_PARAMETER, parameter.span, name=parameter.name.text,
            function=function.name.text,
        )  # fmt: skip


def _check_overload(function: ast.Function, heads: _Heads, report: Report) -> None:
    """Functions may share a name if no two have the same arguments and the same result.

    Those of the same arguments are told apart by the types that are written behind ``->``.
    """
    types = (described(argument.type) for argument in function.arguments)
    result = "" if function.result is None else described(function.result)
    known = heads.setdefault((function.name.text, *types), {})
    first = next((name for other, name in known.items() if not (result and other)), None)
    first = first or known.setdefault(result, function.name)
    if first is not function.name:
        report.add(
            rules.DUPLICATE_NAME, function.name.span, name=function.name.text,
            labels=[Label(first.span, "with the same arguments here")],
        )  # fmt: skip


_MEANT_OTHERWISE: Mapping[str, str] = {
    "material": "`material.name` is a slot of the material that is drawn",
    "inherited": "`inherited.name` is what a base says of a slot",
}
"""Names that stand for something wherever records are described."""
_ANY_MEANT_OTHERWISE = re.compile(rf"\b(?:{'|'.join(_MEANT_OTHERWISE)})\b")


def _check_readable(report: Report, declaration: Named) -> None:
    """A declaration, or a member of a record, must not have a name that means something else."""
    names: list[ast.Name] = []
    match declaration:
        case ast.Record() | ast.Mixin() if _may_contain_unreadable(declaration):
            names = [member.name for member in declaration.members if ast.is_read(member)]
        case (
            ast.Function()
            | ast.Constant()
            | ast.StructDeclaration()
            | ast.Enumeration()
            | ast.ExternMember()
        ):
            names = [declaration.name]
    for name in names:
        if name.text in _MEANT_OTHERWISE:
            report.add(
                rules.UNREADABLE_NAME, name.span, name=name.text, hint=_MEANT_OTHERWISE[name.text]
            )


def _may_contain_unreadable(record: ast.Record | ast.Mixin) -> bool:
    """False if no member can have such a name; then members, which are made late, stay unmade."""
    text, behind_header = record.span.source.text, record.name.span.end
    return _ANY_MEANT_OTHERWISE.search(text, behind_header, record.span.end) is not None


def _check_inside(report: Report, declaration: Named) -> None:
    """Names that a declaration gives to its parts, each once."""
    match declaration:
        case ast.StructDeclaration(members=members):
            check_once(report, (member.name for member in members))
        case ast.Enumeration(members=members):
            check_once(
                report, (member.name for member in members),
                "each member has a name of its own: leave one of the two out",
            )  # fmt: skip
        case ast.Function():
            check_once(report, (variable.name for variable in declaration.type_parameters))
            arguments = [argument.name for argument in declaration.arguments]
            check_once(report, [*arguments, *(part.name for part in declaration.parts)])
        case ast.Rig():
            for entry in declaration.entries:
                check_once(report, (override.name for override in entry.overrides))
