"""Written types, overloads, generics, coercion, and meanings with their rules."""
