"""Makes a program legal in one profile, so that `emit` only has to print it."""
