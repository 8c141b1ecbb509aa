"""Bindings in TypeScript: an ES module with classes over the bytes of blocks."""
