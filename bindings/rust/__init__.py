"""Bindings in Rust: a module with structures whose offsets the compiler checks."""
