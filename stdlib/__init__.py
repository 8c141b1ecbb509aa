"""The standard library: ``.burnish`` files, and the one table of builtin functions."""
