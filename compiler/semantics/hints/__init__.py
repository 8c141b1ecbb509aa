"""The way out of mistakes, as messages tell it."""
