"""The step between the passes and emission: makes a program legal in one profile.

The passes know no language: they leave operations with Burnish's meaning, globals that any function
reads, and blocks, textures and samplers without bindings. A difference of a profile is a row in its
``Profile``, and each step here reads some of these rows. ``emit`` prints the result.
``compiling.py`` calls this once for every profile that a material is compiled for. A step that
has nothing to do in a profile or a program returns its input.
"""

from __future__ import annotations

from ...compiler.ir.program import Program, Stage
from ...compiler.ir.stages import FRAGMENT
from ...compiler.ir.statements import Region
from ...compiler.passes.pipeline import Undecided
from ...support.frozen import changed
from ..description.profile import Profile
from ..description.shading_language import Language
from .bindings import assign_bindings
from .definitions import with_definitions
from .guards import with_guards
from .legal import Legal
from .places import counted_places
from .resource_arguments import resource_arguments


def legalise(
    program: Program, language: Language, profile: Profile, undecided: Undecided | None = None
) -> Legal:
    """``program`` as ``profile`` prints it; ``undecided`` if it has calls to decide about."""
    if undecided is not None:
        program = with_guards(program, undecided, profile)
    if not profile.links_without_fragments:
        program = _with_fragments(program)
    program, definitions = with_definitions(program, profile)
    return Legal(
        program,
        language.under(profile),
        profile,
        definitions,
        assign_bindings(program, profile),
        resource_arguments(program, language),
        frozenset() if profile.computed_indices else counted_places(program),
    )


def _with_fragments(program: Program) -> Program:
    """A program that draws, with a fragment stage that does nothing if it has none."""
    draws = program.shader.chain[-1] == FRAGMENT and not program.shader.has_functions
    if not draws or program.stages[-1].row == FRAGMENT:
        return program
    nothing = Stage(FRAGMENT, (), (), (), (), Region(()), ())
    return changed(program, stages=(*program.stages, nothing))
