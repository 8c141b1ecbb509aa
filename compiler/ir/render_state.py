"""The state of the pipeline that a pass asks for, beside what its shaders compute.

Semantics reads it from the passes' members, and the reflection hands it on to hosts. The reference
draws by it.
"""

from __future__ import annotations

from typing import Literal

from ...frozen import frozen

Cull = Literal["none", "back", "front"]
"""Which faces are not drawn; the front is counter-clockwise."""
Compare = Literal[
    "never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"
]
"""How the depth of a fragment, on the left, has to compare with the one that is there."""


@frozen
class DepthState:
    """Which fragments the depth test lets through, and whether their depths are kept."""

    compare: Compare = "less"
    write: bool = True
    clear: float = 1.0
    """What depths are before anything is drawn."""

    @property
    def is_used(self) -> bool:
        """Whether a pass has to do with depths at all: frames give it an attachment for them."""
        return self.write or self.compare != "always"

    @property
    def keeps_nearest(self) -> bool:
        """Whether of several fragments at a place only the nearest one is left."""
        return self.write and self.compare == "less"


@frozen
class RenderState:
    """What a host sets for all that is drawn with a pass. The defaults hold for what no pass says
    anything of."""

    cull: Cull = "none"
    depth: DepthState = DepthState()
