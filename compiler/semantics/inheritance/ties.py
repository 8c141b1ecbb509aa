"""The pass that a material names behind ``by``, or inherits: it draws the material unless another
one is asked for.

``Frontend`` asks for it where no pass is named, and to tell where another one is; ``frames.py``
asks whether a frame draws each material by its pass.
"""

from __future__ import annotations

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...syntax import ast
from ..names.modules import Symbol
from .flattening import Records


@frozen
class Tie:
    """A material's pass, with where it is named."""

    pass_: Symbol
    name: ast.Name


def tie_of(material: Symbol, records: Records, report: Report) -> Tie | None:
    """The tie of a material, or of the nearest material that it extends; ``None`` without one.

    It is also ``None`` after reporting that there is no such pass, or that it cannot draw.
    """
    for symbol in records.chain(material):
        declaration = symbol.declaration
        if isinstance(declaration, ast.Record) and declaration.by is not None:
            found = _pass(symbol, declaration.by, report)
            return None if found is None else Tie(found, declaration.by)
    return None


def draws_as(pass_: Symbol, tie: Tie, records: Records) -> bool:
    """True if a pass is the one of a tie, or extends it."""
    return tie.pass_ in records.chain(pass_)


def _pass(owner: Symbol, name: ast.Name, report: Report) -> Symbol | None:
    """The pass of a name in the file of ``owner``; ``None`` after reporting what is wrong."""
    module = owner.module
    found = module.find(name.text)
    if not found:
        if name.text not in module.missing:
            hint = module.hint(name, module.visible(), ("pass",))
            report.add(rules.UNKNOWN_NAME, name.span, kind="pass", name=name.text, hint=hint)
        return None
    declaration = found[0].declaration
    labels = [Label(declaration.name.span, "declared here")]
    if not isinstance(declaration, ast.Record) or declaration.kind != "pass":
        report.add(rules.NOT_A_PASS, name.span, name=name.text, labels=labels)
        return None
    if declaration.abstract:
        report.add(rules.ABSTRACT_USE, name.span, name=name.text, labels=labels)
        return None
    return found[0]
