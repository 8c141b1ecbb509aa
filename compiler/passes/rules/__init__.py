"""The simplification rules: rows with a name, a pattern, a condition and a result."""
