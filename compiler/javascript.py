"""The functions of JavaScript's ``Math`` that operations of ``tracing`` are.

The table of builtins of web pages (``targets/web_host/serving``) and the bindings in TypeScript
(``bindings/typescript``) call them.
"""

from __future__ import annotations

from collections.abc import Mapping

MATH: Mapping[str, str] = {
    "mul_int": "Math.imul",
    "abs": "Math.abs",
    "minimum": "Math.min",
    "maximum": "Math.max",
    "floor": "Math.floor",
    "ceil": "Math.ceil",
    "trunc": "Math.trunc",
    "sqrt": "Math.sqrt",
    "power": "Math.pow",
    "exp": "Math.exp",
    "log": "Math.log",
    "log2": "Math.log2",
    "sin": "Math.sin",
    "cos": "Math.cos",
    "tan": "Math.tan",
    "arcsin": "Math.asin",
    "arccos": "Math.acos",
    "arctan": "Math.atan",
    "arctan2": "Math.atan2",
    "sinh": "Math.sinh",
    "cosh": "Math.cosh",
    "tanh": "Math.tanh",
    "arcsinh": "Math.asinh",
    "arccosh": "Math.acosh",
    "arctanh": "Math.atanh",
}
"""The name of each function by its operation."""
