"""The Metal Shading Language, which Apple's compiler has never seen from here: see `target.py`."""
