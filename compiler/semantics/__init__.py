"""Semantics, from syntax to one typed graph: names, types, inheritance, rigs, passes."""
