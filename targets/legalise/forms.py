"""Chooses the form of a program that a profile can have, if there are several.

``compiling.py`` asks before anything is legalised: a kernel over images is a compute shader
where the profile can write these images, and a full-screen pass elsewhere, if vertices have numbers
there.
"""

from __future__ import annotations

from ...compiler.ir.stages import COMPUTE
from ...compiler.passes.pipeline import Form, Staged
from ..description.capabilities import VERTEX_NUMBERS
from ..description.profile import Profile


def form_for(staged: Staged, profile: Profile) -> Form:
    """The form of a program for a profile."""
    images = staged.program.images
    is_written = (
        COMPUTE in profile.stages
        and len(images) <= profile.most_images
        and all(image.format in profile.image_formats for image in images)
    )
    if is_written or staged.full_screen is None or not VERTEX_NUMBERS.is_met(profile):
        return staged.own
    return staged.full_screen
