"""The words of rules: variables, and operations for which Python has no operator."""

from __future__ import annotations

from .terms import CONSTANT, Data, Several, Variable, function

a, b, x, y, z = (Variable(name) for name in "abxyz")
c, d = Variable("c", CONSTANT), Variable("d", CONSTANT)
"""Constants."""
xs, cs = Several("xs"), Several("cs", every=CONSTANT)
lanes, member_name, mode, loop = map(Data, ("lanes", "name", "mode", "loop"))

abs_, min_, max_, pow_, round_ = map(function, ("abs", "min", "max", "pow", "round"))
floor, sqrt, mix, clamp, saturate = map(function, ("floor", "sqrt", "mix", "clamp", "saturate"))
normalize, transpose = map(function, ("normalize", "transpose"))
not_ = function("not")

splat, vector, swizzle, index, member = map(
    function, (".splat", ".vector", ".swizzle", ".index", ".member")
)
select, cross, fold, iterate = map(function, (".select", ".cross", ".fold", ".iterate"))
