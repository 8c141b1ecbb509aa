"""Bindings in C++17: a header with structures whose offsets the compiler checks."""
