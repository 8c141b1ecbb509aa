"""``burnish gallery``: makes pages that show all materials of a folder."""

from .command import gallery

__all__ = ["gallery"]
