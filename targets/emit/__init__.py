"""Prints programs in any language, from the language's description in `targets/description`."""
