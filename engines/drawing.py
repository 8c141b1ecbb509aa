"""How an engine draws a material: which faces, and if it is blended. Its writers ask here.

What the pass says to which a material is tied counts. Of a material that is tied to none nobody
says it, so that the engine's own settings hold, unless the material's slots say more.
"""

from __future__ import annotations

from ..compiler.documents.functions import Functions
from ..compiler.ir.render_state import Cull


def culled(document: Functions) -> Cull | None:
    """The faces that are not drawn; ``None`` leaves it to the engine.

    A material that tells its sides apart is drawn from both.
    """
    if document.own_pass is not None:
        return document.own_pass.cull
    tells = any(
        row.source == "pipeline" and row.given == "front_facing" for row in document.arguments
    )
    return "none" if tells else None


def covers(document: Functions) -> bool:
    """True if the alpha says how many samples of a pixel are covered, instead of being blended."""
    return document.own_pass is not None and document.own_pass.covers


def adds(document: Functions) -> bool:
    """True if what is drawn is added to what is there, also where nothing is said of its alpha."""
    return document.own_pass is not None and document.own_pass.blend == "add"


def multiplies(document: Functions) -> bool:
    """True if what is there is multiplied by what is drawn."""
    return document.own_pass is not None and document.own_pass.blend == "multiply"
