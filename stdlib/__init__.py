"""The standard library: ``.burnish`` files, and the one table of builtin functions.

``semantics/shading/slot_checks.py`` warns of records that override a slot of ``COMPANIONS`` alone.
"""

from __future__ import annotations

from collections.abc import Mapping

COMPANIONS: Mapping[str, tuple[str, str]] = {
    "object_normal": (
        "object_tangent",
        "extend `object_place = moved_by(…, inherited.object_place)` of `std.motion` where a whole "
        "mesh moves, or override `object_tangent`, too",
    ),
}
"""For a slot that turns with a mesh, another one that has to turn with it, and advice."""
