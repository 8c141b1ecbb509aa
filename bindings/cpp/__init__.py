"""Bindings in C++17: a header with a structure for each block, whose offsets the compiler checks."""
