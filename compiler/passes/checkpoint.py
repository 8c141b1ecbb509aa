"""Looks at every graph between two passes: verifies it, or prints it.

``pipeline.stage`` calls ``verified`` after each pass. The tests always verify; users do not,
because that takes as long as a pass. ``BURNISH_SHOW=guard burnish compile …`` prints the graphs
after the pass of this name, for those who change passes.
"""

from __future__ import annotations

import os
import sys
from functools import cache
from typing import TYPE_CHECKING, Literal, get_args

from ..ir.node import Roots
from ..watching import SHOWN, VARIABLE

if TYPE_CHECKING:
    from ..ir.operations import Form
    from ..ir.shader import Result, Shader

Checkpoint = Literal[
    "semantics", "open_binders", "replace_aggregates", "simplify", "fuse", "inline", "skip_loops",
    "expand_builtins", "guard", "move_to_vertices", "hoist", "move_to_corners", "lift_lambdas",
    "lower_reads", "rename_variables", "legalise",
]  # fmt: skip
"""The origin of a graph: a pass, the checks of semantics, or what a profile decides."""


def verified(name: Checkpoint, form: Form, roots: Roots) -> Roots:
    """``roots`` as pass ``name`` made them, verified and printed where that is wanted."""
    if os.environ.get(VARIABLE) == "1":
        from ..ir.verify import InvalidGraphError, verify

        try:
            verify(roots, stage=form)
        except InvalidGraphError as error:
            error.add_note(f"after {name}")
            raise
    if shown := os.environ.get(SHOWN):
        _show(name, roots, _wanted(shown))
    return roots


def announce(shader: Shader) -> None:
    """Print the name of the shader whose graphs come next, where graphs are printed."""
    if shown := os.environ.get(SHOWN):
        _wanted(shown)  # Before all graphs, it tells of names that no pass has.
        print(f"shader {shader.name}:", file=sys.stderr)


def verified_results(shader: Shader) -> tuple[Result, ...]:
    """The results of a shader; where it is wanted, they are verified to fit the shader's stages."""
    if os.environ.get(VARIABLE) == "1":
        from ..ir.verify import verify_levels, verify_results

        verify_results(shader.results, shader.chain)
        verify_levels(shader)
    return shader.results


@cache
def _wanted(shown: str) -> frozenset[str]:
    """The names in the variable's text; of those that no pass has, people are told once."""
    known = get_args(Checkpoint)
    names = [name.strip() for name in shown.split(",")]
    for name in names:
        if name not in {*known, "all"}:
            there = ", ".join(known)
            print(
                f"{SHOWN}: no pass is called `{name}`; there are {there}, and all", file=sys.stderr
            )
    return frozenset(names)


def _show(name: Checkpoint, roots: Roots, wanted: frozenset[str]) -> None:
    """Print a graph to the error output, operands before users, if it is ``wanted``."""
    if name in wanted or "all" in wanted:
        lines = [f"after {name}:", *(f"  {node}" for node in roots.nodes)]
        lines.append(f"  delivers {', '.join(f'%{root.id}' for root in roots)}")
        print("\n".join(lines), file=sys.stderr)
