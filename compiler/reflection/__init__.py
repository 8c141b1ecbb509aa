"""The reflection: what a host reads beside the shaders' text."""

from .reflect import reflect
from .tables import BackendTable, BindingPoint, EmittedFile, VertexInputName

__all__ = ["BackendTable", "BindingPoint", "EmittedFile", "VertexInputName", "reflect"]
