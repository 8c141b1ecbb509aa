"""Makes the rows of diagnostics in this package: errors and warnings."""

from __future__ import annotations

from ..diagnostic import Rule


def error(code: str, message: str, help: str, *, of_absence: bool = False) -> Rule:
    """The row of an error; ``Rule`` explains the columns."""
    return Rule(code, "error", message, help, of_absence)


def warning(
    code: str, message: str, help: str, *, of_absence: bool = False, of_the_whole: bool = False
) -> Rule:
    """The row of a warning."""
    return Rule(code, "warning", message, help, of_absence, of_the_whole)
