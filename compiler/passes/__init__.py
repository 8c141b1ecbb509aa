"""The passes, which turn the graph of a shader into a program for backends; see ``pipeline``."""
