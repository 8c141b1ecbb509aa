"""Surfaces whose vertices are made of those of a mesh: expansion and tessellation."""
