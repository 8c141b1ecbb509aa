"""Prints programs in any language, from what `targets/description` says about the language."""
