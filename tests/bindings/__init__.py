"""Tests of bindings: what hosts set and compute has the runtime's bytes, in every language."""
