"""Expressions to typed trees: a module for each kind of expression, and all that can be wrong."""
