"""Records flattened: bases and mixins in one chain, and what it says of each name."""
