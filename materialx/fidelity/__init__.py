"""Draws MaterialX's own GLSL beside Burnish's, in the same setting, and compares the pictures."""
