"""``burnish graph``: what a material computes, where, and why it is safe."""

from .command import graph

__all__ = ["graph"]
