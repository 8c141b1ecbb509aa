"""three.js's ``WebGLRenderer``: a material of whole shaders, which brings lights of its own."""
