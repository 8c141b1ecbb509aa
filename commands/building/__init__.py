"""Builds many files: the list of all compiles, each with its inputs, and what is done with it."""
