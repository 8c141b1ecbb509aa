"""Lowers checked trees to the graph: equal values become one node, and functions share bodies."""
