"""Draws GLSL of OpenGL and ES with OpenGL 4.5, off screen, through EGL.

It draws on Mesa's llvmpipe, or on any device of the machine.
"""
