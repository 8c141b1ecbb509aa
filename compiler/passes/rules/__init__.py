"""The rules by which values are simplified: rows with a name, a pattern, a condition, a result."""
