"""Draws WGSL with WebGPU and GLSL ES 3.00 with WebGL 2, in a headless Chromium.

One browser draws many jobs.
"""
