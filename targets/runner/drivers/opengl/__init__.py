"""Draws GLSL 330 core with an OpenGL driver, off screen, on Mesa's llvmpipe by EGL."""
