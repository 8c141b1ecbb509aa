"""The checks of a plan, each of one kind of mistake; ``frames/checking.py`` does them all."""
