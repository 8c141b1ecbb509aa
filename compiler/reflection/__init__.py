"""The reflection: what a host reads beside the shaders' text."""

from .reflect import reflect
from .tables import BackendTable, BindingPoint, EmittedFile, FieldName

__all__ = ["BackendTable", "BindingPoint", "EmittedFile", "FieldName", "reflect"]
