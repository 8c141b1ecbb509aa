"""``burnish graph``: shows what a material computes, where, and why that is safe."""

from .command import graph

__all__ = ["graph"]
