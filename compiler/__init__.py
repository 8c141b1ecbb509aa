"""The compiler, from text to a staged program. Nothing in this package knows a target language."""
