"""The command ``burnish explain``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import click

from ..answering import collector
from ..console import say, say_finding
from ..options import answer_option

if TYPE_CHECKING:
    from ...compiler.diagnostics.diagnostic import Diagnostic, Rule
    from ...compiler.documents.answer import ExplainAnswer
    from .programs import ShownProgram


@click.command()
@click.argument("code")
@answer_option
def explain(code: str) -> None:
    """Explain the diagnostic CODE: what it means, and a wrong and a right program.

    \b
    Example:
        burnish explain B0203
    """
    rules = _rules()
    rule = rules.get(code.upper())
    if rule is None:
        from ...compiler.diagnostics.nearest import suggestion

        hint = suggestion(code.upper(), rules) or f"they run from {min(rules)} to {max(rules)}"
        raise click.BadParameter(f"there is no code `{code}`; {hint}", param_hint="CODE")
    from .programs import shown

    entry = shown(rule.code)
    if (collected := collector()) is not None:
        collected.find(_found(rule, entry))
        return
    message = re.sub(r"\{\w+\}", "…", rule.message)
    say(f"{rule.severity}[{rule.code}]: {message}")
    _say_paragraph(rule.help)
    _say_programs(entry)


def _found(rule: Rule, entry: ShownProgram) -> ExplainAnswer:
    """The same as a record."""
    from ...compiler.documents.answer import ExplainAnswer

    return ExplainAnswer(
        code=rule.code, severity=rule.severity, message=rule.message, help=rule.help,
        wrong=None if entry.reason else entry.wrong, right=None if entry.reason else entry.right,
    )  # fmt: skip


def told(program: str, targets: str) -> tuple[Diagnostic, ...]:
    """All that is said of a program that shows a diagnostic.

    ``burnish check`` says it or, if ``targets`` are named, ``burnish compile``.
    """
    from ...api import entry_points as api
    from ...compiler.diagnostics.diagnostic import CompileError

    if not targets:
        return api.check(program)
    try:
        return api.compile(program, targets).diagnostics
    except CompileError as error:
        return error.diagnostics


def _say_programs(entry: ShownProgram) -> None:
    if entry.reason:
        _say_paragraph(f"No program shows this. {entry.reason}")
        return
    _say_program(f"Wrong{entry.condition}:", entry.wrong)
    for diagnostic in told(entry.wrong, entry.targets):
        say()
        say_finding(diagnostic)
    _say_program("Right:", entry.right)


def _say_program(title: str, program: str) -> None:
    for line in ("", title, ""):
        say(line)
    for line in program.splitlines():
        say(f"    {line}".rstrip())


def _say_paragraph(text: str) -> None:
    for line in ("", *click.wrap_text(text, width=80).splitlines()):
        say(line)


def _rules() -> dict[str, Rule]:
    from ...compiler.diagnostics import rules
    from ...compiler.diagnostics.diagnostic import Rule

    return {rule.code: rule for rule in vars(rules).values() if isinstance(rule, Rule)}
