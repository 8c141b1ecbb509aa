"""Draws GLSL of OpenGL and ES with OpenGL 4.5, off screen, on Mesa's llvmpipe through EGL."""
