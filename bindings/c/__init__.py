"""Bindings in C11: a header with structures whose offsets the compiler checks."""
