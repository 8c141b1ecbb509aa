"""What all surfaces have in common whose vertices are made of those of a mesh.

``expanding.py`` and ``tessellating.py`` make them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ....frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...syntax import ast
from ..checking.unknown_names import unknown
from ..state.context import Context
from ..state.scope import Instance


def slots_set(ctx: Context, base: Instance, equations: Sequence[ast.Slot]) -> Iterator[str]:
    """The slots that equations set; reported where a surface has none of that name."""
    record = base.record
    seen: dict[str, Span] = {}
    for equation in equations:
        name, span = equation.name.text, equation.name.span
        if name in seen:
            label = Label(seen[name], "first defined here")
            ctx.report.add(rules.DUPLICATE_NAME, span, name=name, labels=[label])
        elif not base.has(name):
            unknown(ctx, f"slot of `{record.name}`", name, span, record.definitions)
        else:
            yield name
        seen.setdefault(name, span)


def apart(surface: Instance, passing: Instance) -> Instance:
    """The surface with a pass of its own, so that what the pass overrides reads this surface."""
    replaced = dict(surface.replaced)
    base = changed(surface, replaced=replaced)
    own = changed(passing, surface=base, values=dict(passing.values))
    for name, given in surface.replaced.items():
        if given.within is passing:
            replaced[name] = changed(given, within=own)
    return base
