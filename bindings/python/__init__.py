"""Bindings in Python: blocks are classes whose attributes write to their bytes."""
