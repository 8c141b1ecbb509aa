"""Burnish: a declarative shader-graph compiler."""
