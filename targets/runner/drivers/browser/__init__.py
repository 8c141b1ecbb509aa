"""Draws WGSL by WebGPU and GLSL ES 3.00 by WebGL 2, in one headless Chromium for many jobs."""
