"""Draws GLSL 3.30 core with OpenGL, off screen, on Mesa's llvmpipe through EGL."""
