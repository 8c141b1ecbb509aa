"""The form in which one profile prints a program."""

from __future__ import annotations

from ...compiler.ir.node import Node
from ...compiler.ir.program import Program
from ...support.frozen import frozen
from ..description.profile import Profile
from ..description.shading_language import Language
from .bindings import Bindings
from .definitions import Definitions
from .resource_arguments import ResourceArguments


@frozen
class Legal:
    """A program that ``emit`` only has to print, with all decisions for the profile."""

    program: Program
    language: Language
    profile: Profile
    definitions: Definitions
    """The function that replaces each builtin whose meaning the profile lacks."""
    bindings: Bindings
    passed: ResourceArguments
    """The blocks and textures that functions get as arguments."""
    in_place: frozenset[Node] = frozenset()
    """Values that get no names, since they are parts of indices that have to be constant."""
