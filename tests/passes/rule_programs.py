"""A small program for each simplification rule, in whose text the rule shows."""

from __future__ import annotations

from collections.abc import Mapping

MATERIAL = """
struct Two {{ a : float, b : float }}
material M {{
param flag : bool = true
param other : bool = false
param n : int = 3
param near : float in 0..1 = 0.5
param far : float in 2..3 = 2.5
param turn : mat3
param low : int in 0..3 = 1
param high : int in 5..9 = 7
x = uv.x
y = uv.y
v = vec3(uv, 0.5)
{equations}
}}
"""

EQUATIONS: Mapping[str, str] = {
    "constants": "color = vec3(x * sin(0.25))",
    "zero added": "color = vec3(x + 0)",
    "negation added": "color = vec3(x + -y)",
    "common factor": "color = vec3(x * 3 + y * 3)",
    "zero subtracted": "color = vec3(x - 0)",
    "subtracted from zero": "color = vec3(0 - x)",
    "subtracted from itself": "color = vec3(x * (y - y))",
    "times zero": "color = vec3(x * 0)",
    "times one": "color = vec3(x * 1)",
    "times minus one": "color = vec3(x * -1)",
    "magnitude squared": "color = vec3(abs(x) * abs(x))",
    "divided by one": "color = vec3(x / 1)",
    "rounded quotient": "color = vec3(floor(x / 2))",
    "quotient of whole numbers": "color = vec3(floor(floor(9 * x) / 3))",
    "zero divided": "color = vec3(0 / x)",
    "equal lanes": "color = vec3(x) + vec3(y)",
    "scalar operand": "color = v * vec3(y)",
    "negated twice": "color = vec3(- -x)",
    "to the power of one": "color = vec3(pow(x, 1.0))",
    "to the power of zero": "color = vec3(pow(x, 0.0))",
    "squared": "color = vec3(pow(x, 2.0))",
    "root as a power": "color = vec3(pow(x, 0.5))",
    "root of a square": "color = vec3(sqrt(x * x))",
    "one to a power": "color = vec3(pow(1.0, x))",
    "mixed with weight zero": "color = mix(v, vec3(normal), 0)",
    "mixed with weight one": "color = mix(v, vec3(normal), 1)",
    "mixed with itself": "color = mix(v, v, near)",
    "mixed from zero to one": "color = vec3(mix(0.0, 1.0, x))",
    "product of zeros": "color = cross(v, vec3(0))",
    "zero moved": "color = turn * (v * 0) + x",
    "constants added": "color = vec3(x + 0.25 + 0.5)",
    "constants subtracted": "color = vec3(x + 0.25 - 0.5)",
    "sum subtracted": "color = vec3(1 - (1 - x))",
    "constant factors": "color = vec3(x * 3 * 5)",
    "constant divisors": "color = vec3(x * 3 / 5)",
    "difference of what is steady": "color = vec3(ddx(near) + x)",
    "constant lanes": "color = vec3(x * (v + 1).z)",
    "constants one by one": "color = vec3(x, vec2(0.5))",
    "loop of constants": "color = vec3(x * (iterate s from 0.0 for i in 0..9 : s * 0.5 + 1))",
    "identity moves": "color = mat3(1.0) * v",
    "transposed twice": "color = transpose(transpose(turn)) * v",
    "transposed around a factor": "color = transpose(transpose(turn) * x) * v",
    "least is left": "color = vec3(x * min(near, far))",
    "least is right": "color = vec3(x * min(far, near))",
    "greatest is left": "color = vec3(x * max(far, near))",
    "greatest is right": "color = vec3(x * max(near, far))",
    "within limits": "color = vec3(x * clamp(near, 0, far))",
    "limits of zero and one": "color = vec3(clamp(x, 0, 1))",
    "saturated already": "color = vec3(saturate(near * near))",
    "not negative": "color = vec3(abs(far) * x)",
    "of length one": "color = normalize(normalize(v))",
    "lt holds": "color = vec3(if near < far then x else y)",
    "lt fails": "color = vec3(if far < near then x else y)",
    "ge holds": "color = vec3(if far >= near then x else y)",
    "ge fails": "color = vec3(if near >= far then x else y)",
    "le holds": "color = vec3(if near <= far then x else y)",
    "le fails": "color = vec3(if far <= near then x else y)",
    "gt holds": "color = vec3(if far > near then x else y)",
    "gt fails": "color = vec3(if near > far then x else y)",
    "eq a bool": "color = vec3(if flag == true then x else y)",
    "eq the other bool": "color = vec3(if flag == false then x else y)",
    "eq itself": "color = vec3(if n == n then x else y)",
    "eq apart": "color = vec3(if low == high then x else y)",
    "ne a bool": "color = vec3(if flag != false then x else y)",
    "ne the other bool": "color = vec3(if flag != true then x else y)",
    "ne itself": "color = vec3(if n != n then x else y)",
    "ne apart": "color = vec3(if low != high then x else y)",
    "not twice": "b = not not flag\ncolor = vec3(if b or other then x else y)",
    "comparison negated": "color = vec3(if not (x < y) or flag then x else y)",
    "and decided": "color = vec3(if flag and near > far then x else y)",
    "and undecided": "color = vec3(if flag and near < far then x else y)",
    "and itself": "color = vec3(if flag and flag then x else y)",
    "or decided": "color = vec3(if flag or near < far then x else y)",
    "or undecided": "color = vec3(if flag or near > far then x else y)",
    "or itself": "color = vec3(if flag or flag then x else y)",
    "no bits kept": "color = vec3(x * float(n & 0))",
    "all bits kept": "color = vec3(x * float(n & -1))",
    "bit_and itself": "color = vec3(x * float(n & n))",
    "no bits added": "color = vec3(x * float(n | 0))",
    "all bits added": "color = vec3(x * float(n | -1))",
    "bit_or itself": "color = vec3(x * float(n | n))",
    "no bits changed": "color = vec3(x * float(n ^ 0))",
    "all bits changed": "color = vec3(x * float(n ^ -1))",
    "bit_xor itself": "color = vec3(x * float(n ^ n))",
    "bit_not twice": "color = vec3(x * float(~~n))",
    "reverse_bits twice": "color = vec3(x * float(reverse_bits(reverse_bits(n))))",
    "zero shifted": "color = vec3(x * float(0 << n))",
    "shifted by nothing": "color = vec3(x * float(n << 32))",
    "shifted by less": "color = vec3(x * float(n << 5))",
    "lanes of a constant": "c = vec3(1, 2, 3)\ncolor = vec3(x * c.y)",
    "lanes of lanes": "color = v.zyx.zxy",
    "lanes of one scalar": "s = vec3(sin(x))\ncolor = vec3(s.yz, y)",
    "lanes of a part": "w = vec4(v.zyx, sin(y))\ncolor = w.zxy",
    "all lanes in order": "w = sin(v)\ncolor = w.zyx.zyx",
    "constants joined": "color = x * vec3(0.25, 0.5, 1)",
    "one scalar joined": "s = sin(x)\ncolor = vec3(s, s, s)",
    "joined again": "w = sin(v)\ncolor = vec3(w.z, w.y, w.x) * x",
    "constant filled in": "color = vec3(near * 0)",
    "element of equal ones": "a = [x, x, x]\ncolor = vec3(a[n])",
    "lane by number": "color = vec3(v[1])",
    "part by number": "m = mat2(uv, uv.yx)\ncolor = vec3(sum i in 0..2 : sin(m[i]), 0)",
    "member of a structure": "s = iterate s from Two(x, y) up to low * 0 while s.a < y :"
    " Two(s.b, s.a)\ncolor = vec3(s.a)",
    "chosen already": "color = vec3(if true then x else y)",
    "refused already": "color = vec3(if false then x else y)",
    "equal sides": "color = vec3(if flag then x else x)",
    "chosen by an opposite": "color = vec3(if not flag then x else y)",
    "computing side first": "color = vec3(if x > 0.5 then 0 else sin(y))",
    "bool chosen": "both = if flag then true else false\n"
    "color = vec3(if both or other then x else y)",
    "constant crossing": "c = @vertex (sin(x) - sin(x))\ncolor = vec3(x + c)",
    "fold of nothing": "nested = sum i in 0..low * 0 : sum j in 0..9 : sin(x * float(i * j))\n"
    "color = vec3(x + nested)",
    "fold of neutral terms": "color = vec3(x + (sum i in 0..low : 0.0))",
    "fold of constants": "color = vec3(x * (sum i in 0..9 : sin(float(i))))",
    "fold written out": "color = vec3(sum i in 0..2 : sin(x * float(i)))",
    "loop of no turns": "color = vec3(iterate s from x up to low * 0 while s < y : sin(s))",
    "loop that stops at once": "color = vec3(iterate s from x up to 9 while near > far : sin(s))",
    "loop that changes nothing": "color = vec3(iterate s from x up to 9 while s < y : s + 0 * y)",
    "loop written out": "color = vec3(iterate s from x up to 2 : sin(s))",
}
"""Equations of a material, by the name of the rule."""


def program(rule: str) -> str:
    """The text of a rule's program."""
    return MATERIAL.format(equations=EQUATIONS[rule])
