"""B06: rigs, lights and terms."""

from __future__ import annotations

from .row import error

OUTSIDE_LIGHT = error(
    "B0601",
    "`{name}` is known only in a `term … per light`",
    "`light` is the light that is summed over, inside of a `term … per light`. A light reads its "
    "own slots by their names alone.",
    of_absence=True,
)
UNKNOWN_LIGHT = error(
    "B0602",
    "`{name}` is not a light",
    "A rig entry names a light type: `sun : MyLight`.",
)
NO_SUCH_RIG = error(
    "B0604",
    "which rig is meant? {known}",
    "If a file has one rig, that is used. If it has several, name one: `--rig Studio`.",
)
TERM_WITHOUT_SURFACE = error(
    "B0605",
    "`{name}` needs a surface to shade",
    "Terms read the slots of the material that uses them, so they are called in materials, lights "
    "and passes, not in functions or constants.",
)
EMPTY_RIG = error(
    "B0606",
    "`{name}` is summed over the lights of a rig that has none",
    "Add a light to the rig, or use a term that is not `per light`.",
)
LIGHT_LACKS_SLOT = error(
    "B0607",
    "light `{light}` has no `{slot}`",
    "A `per light` term is applied to every light of the rig, so it can read only slots that all "
    "of them have.",
)
WITH_NEEDS_TERM = error(
    "B0608",
    "`with` replaces the slots that a term reads",
    "Write it after the call of a term: `name(k) with { normal = coat }`.",
)
NO_ARRAY_OF = error(
    "B0609",
    "there can be no array of `{light}`",
    "The parameters of an array of lights are kept in one uniform array. So the light needs at "
    "least one parameter, and it cannot have textures.",
)
