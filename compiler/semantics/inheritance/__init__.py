"""Records flattened: bases and mixins in one chain, and its definitions of each name."""
