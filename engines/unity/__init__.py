"""Unity: a material as functions for Custom Function nodes of its Shader Graph."""
