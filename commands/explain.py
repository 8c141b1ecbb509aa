"""``burnish explain``: explains the code of a diagnostic."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import click

from .console import say

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Rule


@click.command()
@click.argument("code")
def explain(code: str) -> None:
    """Explain the diagnostic CODE, and what to do about it.

    \b
    Example:
        burnish explain B0203
    """
    rules = _rules()
    rule = rules.get(code.upper())
    if rule is None:
        from ..compiler.diagnostics.nearest import suggestion

        hint = suggestion(code.upper(), rules) or f"they run from {min(rules)} to {max(rules)}"
        raise click.BadParameter(f"there is no code `{code}`; {hint}", param_hint="CODE")
    message = re.sub(r"\{\w+\}", "…", rule.message)
    say(f"{rule.severity}[{rule.code}]: {message}")
    for line in ("", *click.wrap_text(rule.help, width=80).splitlines()):
        say(line)


def _rules() -> dict[str, Rule]:
    from ..compiler.diagnostics import rules
    from ..compiler.diagnostics.diagnostic import Rule

    return {rule.code: rule for rule in vars(rules).values() if isinstance(rule, Rule)}
