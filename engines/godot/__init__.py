"""Godot 4: a material as a shader of the kind ``spatial``."""
