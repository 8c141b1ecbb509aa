"""The expected values of ``rectangles.burnish``, computed lane by lane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .matrices import V2, V3, V4, Matrix, Vector, combined, of_matrix, of_vector, transposed

SHAPES = tuple((columns, rows) for columns in (2, 3, 4) for rows in (2, 3, 4) if columns != rows)
_VECTORS: Mapping[int, Vector] = {2: V2, 3: V3, 4: V4}
_PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47)


def _of_primes(columns: int, rows: int, first: int) -> list[list[int]]:
    """A matrix of prime numbers in their order."""
    return [
        [_PRIMES[first + column * rows + row] for row in range(rows)] for column in range(columns)
    ]


M = {shape: _of_primes(*shape, 0) for shape in SHAPES}
N = {shape: _of_primes(*shape, 3) for shape in SHAPES}
SEVERAL, WIDE = (N[3, 2], M[3, 2]), (M[4, 3], N[4, 3])
BEND, SHIFT, WEIGHT = N[2, 3], (3, 5), 7

VALUES: Mapping[str, object] = {
    **{f"m{columns}{rows}": M[columns, rows] for columns, rows in SHAPES},
    **{f"n{columns}{rows}": N[columns, rows] for columns, rows in SHAPES},
    "v2": V2, "v3": V3, "v4": V4, "several": SEVERAL, "wide": WIDE,
    "lens": {"weight": WEIGHT, "bend": BEND, "shift": SHIFT},
}  # fmt: skip


def _extended(m: Matrix) -> list[list[float]]:
    """A matrix of four columns and rows, continued by the identity."""
    return [
        [
            m[column][row] if column < len(m) and row < len(m[0]) else float(row == column)
            for row in range(4)
        ]
        for column in range(4)
    ]


def _of_shape(shape: tuple[int, int]) -> Mapping[str, Vector]:
    m, n = M[shape], N[shape]
    across, down = (_VECTORS[size] for size in shape)
    name = f"mat{shape[0]}x{shape[1]}"
    return {
        f"{name} * vec": of_vector(m, across),
        f"transpose({name}) * vec": of_vector(transposed(m), down),
        f"{name} * transpose({name}) * vec": of_vector(of_matrix(m, transposed(n)), down),
        f"first column of {name}": m[0],
        f"last column of {name}": m[-1],
        f"({name} + 2 * {name}) * vec": of_vector(combined(m, 2, n), across),
        f"column of {name} - {name}": combined(m, -1, n)[1],
        f"column of outer product {name}": [lane * across[1] for lane in down],
        f"column of hadamard({name}, {name})": [x * y for x, y in zip(m[0], n[0], strict=True)],
        f"mat4({name}) * vec4": of_vector(_extended(m), V4),
    }


def _bent(m: Matrix) -> Sequence[float]:
    return [x + y for x, y in zip(of_vector(m, V3), m[2], strict=True)]


_M23, _M32, _M24, _M42, _M43 = (M[shape] for shape in ((2, 3), (3, 2), (2, 4), (4, 2), (4, 3)))

_SEVERAL: Mapping[str, Vector] = {
    "mat3x2[2] * vec3": of_vector(SEVERAL[1], V3),
    **{f"mat4x3[2] at {i} * vec4": of_vector(WIDE[i], V4) for i in range(2)},
    "member mat2x3 * vec2": (*of_vector(BEND, SHIFT), WEIGHT),
    "chosen mat3x2 * vec3": of_vector(_M32, V3),
    "argument mat3x2": (*_bent(_M32), *_bent(N[3, 2])),
    "mat2x3 * (mat4x2 * vec4)": of_vector(_M23, of_vector(_M42, V4)),
    "lanes": (_M32[2][1], _M24[1][3], _M42[3][0], _M43[2][1]),
    "mat2x4 of columns * vec2": of_vector((V4, V4[::-1]), V2),
    "sum of columns, and mat2(mat4x3)": (
        *map(sum, zip(*SEVERAL[0], strict=True)),
        *of_vector([column[:2] for column in _M43[:2]], V2),
    ),
}

_FACTORS = (
    ((2, 3), (3, 2)), ((3, 2), (2, 3)), ((2, 3), (4, 2)), ((4, 3), (2, 4)), ((2, 4), (3, 2)),
    ((3, 4), (2, 3)), ((4, 2), (3, 4)), ((3, 4), (4, 3)), ((3, 2), (4, 3)), ((4, 2), (2, 4)),
)  # fmt: skip
"""The shapes of the factors of products of matrices."""

_PRODUCTS: Mapping[str, Vector] = {
    f"mat{left[0]}x{left[1]} * mat{right[0]}x{right[1]} * vec": of_vector(
        of_matrix(M[left], M[right]), _VECTORS[right[0]]
    )
    for left, right in _FACTORS
}

PIXELS: Mapping[str, Vector] = {
    name: tuple([*lanes, 0, 0][:4])
    for tens in (*map(_of_shape, SHAPES), _SEVERAL, _PRODUCTS)
    for name, lanes in tens.items()
}
"""The expected pixels; all numbers are whole, and small enough for a float32."""
