"""Kernels as shaders: the results of each element, of each group, and of each image."""
