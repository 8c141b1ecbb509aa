"""The expected values of ``matrices.burnish``, computed lane by lane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Vector = Sequence[float]
Matrix = Sequence[Vector]
"""A matrix as its columns."""

A2, B2 = ((2, 3), (5, 7)), ((11, 13), (17, 19))
A3, B3 = ((2, 3, 5), (7, 11, 13), (17, 19, 23)), ((29, 31, 37), (41, 43, 47), (53, 59, 61))
A4 = ((2, 3, 5, 7), (11, 13, 17, 19), (23, 29, 31, 37), (41, 43, 47, 53))
B4 = ((59, 61, 67, 71), (73, 79, 83, 89), (97, 101, 103, 107), (109, 113, 127, 131))
V2, V3, V4 = (3, -2), (1, -2, 4), (1, -2, 4, 3)
SEVERAL = (B3, A3, ((1, 2, 3), (4, 5, 6), (7, 8, 9)))
PAIRS = (B2, A2, ((23, 29), (31, 37)))

VALUES: Mapping[str, object] = {
    "a2": A2, "b2": B2, "a3": A3, "b3": B3, "a4": A4, "b4": B4,
    "v2": V2, "v3": V3, "v4": V4, "several": SEVERAL, "pairs": PAIRS,
}  # fmt: skip


def of_vector(m: Matrix, v: Vector) -> list[float]:
    """``m * v``: the sum of the columns, each multiplied by its lane of the vector."""
    return [sum(column[row] * v[i] for i, column in enumerate(m)) for row in range(len(m[0]))]


def of_matrix(m: Matrix, n: Matrix) -> list[list[float]]:
    """``m * n``: ``m`` times each column of ``n``."""
    return [of_vector(m, column) for column in n]


def transposed(m: Matrix) -> list[list[float]]:
    """The transposed matrix."""
    return [[column[row] for column in m] for row in range(len(m[0]))]


def combined(m: Matrix, factor: float, n: Matrix) -> list[list[float]]:
    """``m + factor * n``."""
    return [
        [x + factor * y for x, y in zip(left, right, strict=True)]
        for left, right in zip(m, n, strict=True)
    ]


def cut(m: Matrix) -> list[Vector]:
    """The upper left part of 3 by 3 lanes."""
    return [column[:3] for column in m[:3]]


TWOS: Mapping[str, Vector] = {
    **{f"column {i} of mat2 * mat2": of_matrix(A2, B2)[i] for i in range(2)},
    **{f"column {i} of transpose(mat2)": transposed(A2)[i] for i in range(2)},
    **{f"mat2[{i}]": A2[i] for i in range(2)},
    "mat2 * vec2": of_vector(A2, V2),
    "mat2 * mat2 * vec2": of_vector(A2, of_vector(B2, V2)),
    "constant mat2 * vec2": of_vector(((1, 2), (3, 5)), V2),
    "lanes of mat2": (A2[1][0], A2[0][1]),
}
THREES: Mapping[str, Vector] = {
    **{f"column {i} of mat3 * mat3": of_matrix(A3, B3)[i] for i in range(3)},
    **{f"column {i} of transpose(mat3)": transposed(A3)[i] for i in range(3)},
    "mat3 * vec3": of_vector(A3, V3),
    "mat3(mat4) * vec3": of_vector(cut(A4), V3),
    "mat3 of columns * vec3": of_vector((V3, B3[0], (7, 8, 9)), V3),
    "lanes of mat3": (A3[2][1], A3[0][2], A3[1][0]),
}
FOURS: Mapping[str, Vector] = {
    **{f"column {i} of mat4 * mat4": of_matrix(A4, B4)[i] for i in range(4)},
    **{f"column {i} of transpose(mat4)": transposed(A4)[i] for i in range(4)},
    "mat4 * mat4 * vec4": of_vector(A4, of_vector(B4, V4)),
    "mat4 * vec4": of_vector(A4, V4),
}
ARRAYS: Mapping[str, Vector] = {
    **{f"mat3[3] at {i} * vec3": of_vector(SEVERAL[i], V3) for i in range(3)},
    **{f"column {i} in mat3[3]": SEVERAL[1][i] for i in range(3)},
    **{f"mat2[3] at {i} * vec2": of_vector(PAIRS[i], V2) for i in range(3)},
    "parts of mat2[3]": (*PAIRS[2][0], PAIRS[1][1][0]),
}
SUMS: Mapping[str, Vector] = {
    **{f"column {i} of mat4 + 2 * mat4": combined(A4, 2, B4)[i] for i in range(4)},
    **{f"column {i} of mat4 - mat4": combined(A4, -1, B4)[i] for i in range(4)},
    "transpose(mat4) * vec4": of_vector(transposed(A4), V4),
    "mat4 * transpose(mat4) * vec4": of_vector(of_matrix(A4, transposed(B4)), V4),
}

PIXELS: Mapping[str, Vector] = {
    name: tuple([*lanes, 0, 0][:4])
    for tens in (TWOS, THREES, FOURS, ARRAYS, SUMS)
    for name, lanes in tens.items()
}
"""The expected pixels; all numbers are whole, and small enough for a float32."""
