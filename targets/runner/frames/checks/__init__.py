"""The checks of a plan, each for one kind of mistake; ``frames/checking.py`` runs them all."""
