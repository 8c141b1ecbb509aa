"""Expressions to nodes: a module for each kind of expression."""
