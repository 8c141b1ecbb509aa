"""The record that describes an engine: ``Engine``.

To add an engine, make a folder beside the others in ``engines`` with an ``engine.py`` that defines
``ENGINE``. Nothing else has to change, since the registry finds the folder.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.documents.functions import Functions
from ..compiler.documents.reflection import Reflection
from ..support.frozen import frozen
from ..targets.description.profile import Profile
from ..targets.description.shading_language import Language
from ..targets.emit.functions import FunctionEmission

Emissions = Mapping[str, FunctionEmission]
"""The texts of functions by profile (``glsl:es300``)."""
Texts = Mapping[str, str]
"""The texts of a material by their stage (``vertex``)."""
Dialect = tuple[Language, Profile]
"""A language that is no target, as only engines take functions in it."""


def _no_functions(_functions: Functions, _emissions: Emissions, _report: Report) -> Texts:
    """The files of an engine that takes no functions: none."""
    return {}


@frozen
class Engine:
    """An engine, and what it takes."""

    name: str
    title: str
    """The engine's name in prose."""
    targets: tuple[str, ...]
    """The profiles in which it takes functions; empty if it has a dialect of its own."""
    write: Callable[[Functions, Emissions, Report], Mapping[str, str]] = _no_functions
    """Makes the engine's own files of the functions of one material: texts by the files' names.

    What the engine cannot do is reported.
    """
    taken: frozenset[str] = frozenset()
    """The values of ``slot_table.py`` that it takes; what a material gives beside is told."""
    write_shaders: Callable[[Reflection, Texts, Report], Mapping[str, str]] | None = None
    """Makes the files of the whole shaders of one material, for an engine that takes these."""
    by_hand: bool = False
    """True if a user puts the functions into a graph, so that files say nothing of others."""
    unproven: str = ""
    """The reason why nobody should rely on the files yet: "never compiled by …"."""
    dialect: Callable[[], Dialect] | None = None
    """Makes the language of its own in which it takes functions, or whole shaders."""
    is_offered: bool = False
    """True if it gets the slots that it takes, where nobody says which; else all of a material's
    own."""
