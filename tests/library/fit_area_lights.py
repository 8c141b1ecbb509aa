"""``python -m tests.library.fit_area_lights``: find the polynomial of ``std.area_lights``.

A highlight of GGX is nearly a cosine that a matrix has turned and stretched (E. Heitz and others,
"Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", 2016). For many roughnesses
and angles of the eye, this finds the matrix that fits best, and then one polynomial for all of
them. It takes half a minute. ``test_area_lights.py`` has the numbers that it prints, and checks how
good they are.

The inverse of the matrix is, with ``w`` for the squared roughness and ``s`` for the sine to the
eye,

    n² + w A    0    s (n + w B)
       0        1         0
    -s w D      0        w C

where A, B, C and D are polynomials of the roughness and of the cosine ``n``. Without ``w``, this is
the matrix of a mirror, so that smooth surfaces are as exact as rough ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Parts = tuple[Floats, Floats]

STEPS = 32
"""The samples of a highlight to each side of a square."""
ROUGHNESSES = np.linspace(1, 0.06, 24)
FLATNESSES = np.concatenate([np.linspace(0, 0.9, 16), (0.93, 0.96, 0.98, 0.99)])
"""The roots of 1 less the cosine, which are dense at flat angles."""
DEGREES = 4, 3
"""The degrees of the polynomial: of the roughness, and of the cosine."""
RIDGE = 1e-5
"""Keeps the numbers of the polynomial small, so that float32 does not lose any."""


class Highlight:
    """What facets of one width mirror to an eye, as a density of directions."""

    def __init__(self, width: float, cosine: float) -> None:
        self.width, self.cosine = width, cosine
        self.eye = np.array((np.sqrt(1 - cosine**2), 0.0, cosine))
        self.light = self._mirrored()
        self.total = 1.0
        density, chance = self.at(self.light)
        self.total = float((density / chance).mean())
        mean = (self.light * (density / chance)[:, None]).mean(axis=0)
        self.lean = float(np.arctan2(mean[0], mean[2]))
        """The angle from the normal to the mean direction."""

    def _mirrored(self) -> Floats:
        """Directions that facets mirror which the eye sees (Dupuy and Benyoub 2023)."""
        turn, share = _square()
        scale = np.array((self.width, self.width, 1.0))
        stretched = scale * self.eye
        stretched /= np.linalg.norm(stretched)
        height = 1 - share * (1 + stretched[2])
        flat = np.sqrt(np.maximum(1 - height**2, 0))
        cap = np.stack([flat * np.cos(turn), flat * np.sin(turn), height], axis=1)
        facets = _units((cap + stretched) * scale)
        return np.asarray(2 * (facets @ self.eye)[:, None] * facets - self.eye)

    def at(self, light: Floats) -> Parts:
        """The density, which is 1 in all, and how likely the samples above are."""
        up, seen, square = np.maximum(light[:, 2], 0), self.cosine, self.width**2
        half = _units(light + self.eye)[:, 2]
        facets = square / (np.pi * (half**2 * (square - 1) + 1) ** 2)
        to_light = seen * np.sqrt(up**2 + square * (1 - up**2))
        to_eye = np.sqrt(seen**2 + square * (1 - seen**2))
        chance = facets / (2 * (seen + to_eye))
        return facets * up / (2 * (up * to_eye + to_light + 1e-300)) / self.total, chance


def _square() -> Parts:
    """The middles of the cells of a square: an angle, and a share."""
    turn, share = ((each + 0.5) / STEPS for each in np.indices((STEPS, STEPS)).reshape(2, -1))
    return 2 * np.pi * turn, share


def _units(arrows: Floats) -> Floats:
    return np.asarray(arrows / np.linalg.norm(arrows, axis=1, keepdims=True))


def cosine_of(inverse: Floats, light: Floats) -> Floats:
    """The density of the transformed cosine."""
    turned = light @ inverse.T
    lengths = np.linalg.norm(turned, axis=1)
    stretch = abs(np.linalg.det(inverse)) / lengths**3
    return np.asarray(np.maximum(turned[:, 2], 0) / lengths / np.pi * stretch)


def matrix(lean: float, shape: Floats) -> Floats:
    """The matrix of a lobe: how wide it is in both directions, by logarithms, and how skewed."""
    along, across, skew = np.exp(shape[0]), np.exp(shape[1]), shape[2]
    c, s = np.cos(lean), np.sin(lean)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return np.asarray(turn @ np.array([[along, 0, skew], [0, across, 0], [0, 0, 1]]))


def difference(highlight: Highlight, shape: Floats) -> float:
    """The squared difference of both densities, where either of them is."""
    lobe = matrix(highlight.lean, shape)
    inverse = np.linalg.inv(lobe)
    turn, share = _square()
    flat = np.sqrt(share)
    local = np.stack([flat * np.cos(turn), flat * np.sin(turn), np.sqrt(1 - share)], axis=1)
    total = 0.0
    for light in (highlight.light, _units(local @ lobe.T)):
        density, chance = highlight.at(light)
        cosine = cosine_of(np.asarray(inverse, np.float64), light)
        total += float(((density - cosine) ** 2 / (chance + cosine)).mean())
    return total


def least(cost: Callable[[Floats], float], start: Floats, steps: int = 120) -> Floats:
    """The place of a minimum, by the simplex of Nelder and Mead (1965)."""
    corners = [start, *(start + 0.05 * axis for axis in np.eye(len(start)))]
    costs = [cost(corner) for corner in corners]
    for _ in range(steps):
        order = np.argsort(costs)
        corners, costs = [corners[i] for i in order], [costs[i] for i in order]
        middle = np.mean(corners[:-1], axis=0)
        away = middle - corners[-1]
        tried = [(cost(place), place) for place in (middle + away, middle + 2 * away)]
        best = min(tried, key=lambda each: each[0])
        if best[0] >= costs[-2]:
            best = (cost(middle - away / 2), middle - away / 2)
        if best[0] < costs[-1]:
            costs[-1], corners[-1] = best
        else:
            corners = [corners[0], *((corner + corners[0]) / 2 for corner in corners[1:])]
            costs = [costs[0], *map(cost, corners[1:])]
    return corners[int(np.argmin(costs))]


def fitted() -> Iterator[tuple[float, float, Floats]]:
    """The inverse matrices that fit best, whose middle is 1, by roughness and cosine."""
    row = np.zeros(3)
    for roughness in ROUGHNESSES:
        shape = row
        for number, flatness in enumerate(FLATNESSES):
            highlight = Highlight(float(roughness) ** 2, 1 - float(flatness) ** 2)
            if number == 0:  # Straight above, the lobe is round.
                shape = row = _round(least(partial(_of_round, highlight), row[:1]))
            else:
                shape = least(partial(difference, highlight), shape)
            inverse = np.linalg.inv(matrix(highlight.lean, shape))
            yield float(roughness), highlight.cosine, inverse / inverse[1, 1]


def _round(width: Floats) -> Floats:
    """The shape of a lobe that is as wide in all directions."""
    return np.array((width[0], width[0], 0.0))


def _of_round(highlight: Highlight, width: Floats) -> float:
    return difference(highlight, _round(width))


def powers(roughness: Floats, cosine: Floats) -> Floats:
    most, further = DEGREES
    return np.stack(
        [roughness**i * cosine**j for j in range(further + 1) for i in range(most + 1)], axis=-1
    )


def polynomials() -> Floats:
    """The factors of A, B, C and D: by the powers of the cosine, then of the roughness."""
    rows = list(fitted())
    roughness, cosine = (np.array([row[i] for row in rows]) for i in (0, 1))
    inverse = np.array([row[2] for row in rows])
    width, sine = roughness**2, np.sqrt(1 - cosine**2)
    flat = np.where(sine > 0, sine, 1)
    targets = [
        (inverse[:, 0, 0] - cosine**2) / width, (inverse[:, 0, 2] / flat - cosine) / width,
        inverse[:, 2, 2] / width, -inverse[:, 2, 0] / flat / width,
    ]  # fmt: skip
    seen = powers(roughness, cosine)
    weights = 1 + 3 * (1 - cosine) ** 2 * (1 - roughness) ** 2  # for what is hardest to fit
    found = []
    for target, known in zip(targets, (1, sine, 1, sine), strict=True):
        weighted = seen * (weights * (np.asarray(known) > 0))[:, None]
        normal = weighted.T @ weighted + RIDGE * np.eye(weighted.shape[1])
        found.append(np.linalg.solve(normal, weighted.T @ (target * weights)))
    most, further = DEGREES
    return np.round(np.array(found).T.reshape(further + 1, most + 1, 4), 3)


if __name__ == "__main__":
    print(polynomials().tolist())
