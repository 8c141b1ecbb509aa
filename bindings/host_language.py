"""The record that describes a language of hosts: ``HostLanguage``.

To add one, make a folder beside the others in ``bindings`` with a ``language.py`` that defines
``LANGUAGE``, and with the skeleton that it names, a template of Jinja2 for the whole text. Nothing
else has to change: ``registry`` finds the folder. ``printer.Printer`` says what the code of derived
values needs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ..support.frozen import frozen
from .folding import Style
from .model import Binding
from .printer import Printer
from .spelling import Manner, Spelling


@frozen(eq=False, kw_only=True)
class HostLanguage:
    """One language of hosts."""

    name: str
    title: str
    """The language's name in prose."""
    extension: str
    skeleton: Path
    printer: Callable[[], Printer]
    """Makes the printer of code."""
    texts: Callable[[Binding, Spelling], Mapping[str, Any]]
    """Makes what the skeleton reads besides the binding: functions and texts by name."""
    style: Style
    """How long lines are broken."""
    manner: Manner
    """How names are spelled."""
    has_namespace: bool = False
    """True if all names stand in a namespace, or begin with one, which a user may choose."""
