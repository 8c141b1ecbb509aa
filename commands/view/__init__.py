"""``burnish view``: shows a file in a web page, which draws again whenever the file is saved."""

from .command import view

__all__ = ["view"]
