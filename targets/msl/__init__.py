"""The Metal Shading Language, never compiled by Apple's compiler: see `language.py`."""
