"""Outlines and meshes, and how far points are from them: for the truths about distances."""

from __future__ import annotations

import numpy as np

from .kit import Floats


def from_segment(a: Floats, b: Floats, points: Floats) -> Floats:
    """The distances of points from a straight line between two others."""
    way = b - a
    length = float(way @ way)
    share = np.clip((points - a) @ way / length, 0, 1) if length > 0 else np.zeros(len(points))
    return np.asarray(np.linalg.norm(points - a - share[:, None] * way, axis=1))


def from_outline(corners: Floats, points: Floats, is_closed: bool = True) -> Floats:
    """The distances of points of the plane from a polygon, negative inside (by the winding)."""
    ends = np.roll(corners, -1, axis=0)
    pairs = list(zip(corners, ends, strict=True))[: None if is_closed else -1]
    nearest = np.min([from_segment(a, b, points) for a, b in pairs], axis=0)
    to = corners[:, None] - points
    turns = np.arctan2(to[..., 1], to[..., 0])
    steps = np.diff(turns, axis=0, append=turns[:1])
    winding = ((steps + np.pi) % (2 * np.pi) - np.pi).sum(axis=0)
    return np.asarray(np.where(np.abs(winding) > 1, -nearest, nearest))


def from_mesh(faces: Floats, normals: Floats, points: Floats) -> Floats:
    """The distances of points from a convex mesh of triangles, negative inside."""
    heights = np.array(
        [(points - face[0]) @ normal for face, normal in zip(faces, normals, strict=True)]
    )
    nearest = np.full(len(points), np.inf)
    for face, normal, height in zip(faces, normals, heights, strict=True):
        edges = list(zip(face, np.roll(face, -1, axis=0), strict=True))
        for a, b in edges:
            nearest = np.minimum(nearest, from_segment(a, b, points))
        sides = np.array([(points - a) @ np.cross(normal, b - a) for a, b in edges])
        over = (sides > 0).all(axis=0) | (sides < 0).all(axis=0)
        nearest = np.where(over, np.minimum(nearest, np.abs(height)), nearest)
    return np.where((heights < 0).all(axis=0), -nearest, nearest)


def slices(corners: Floats, half_height: float) -> tuple[Floats, Floats]:
    """The triangles and normals of a convex polygon, counter-clockwise, extended along z."""
    count = len(corners)
    low, high = (np.column_stack([corners, np.full(count, z)]) for z in (-half_height, half_height))
    faces, normals = [], []
    for i in range(count):
        j = (i + 1) % count
        faces += [[low[i], low[j], high[j]], [low[i], high[j], high[i]]]
        side = corners[j] - corners[i]
        outward = np.array([side[1], -side[0], 0]) / np.hypot(*side)
        normals += [outward, outward]
        if 0 < i < count - 1:
            faces += [[low[0], low[i], low[j]], [high[0], high[i], high[j]]]
            normals += [np.array([0.0, 0, -1]), np.array([0.0, 0, 1])]
    return np.array(faces), np.array(normals)


def regular(count: int, turn: float = 0) -> Floats:
    """The corners of a polygon of radius one, the first on +y or ``turn`` corners behind it."""
    angles = 2 * np.pi * (np.arange(count) + turn) / count
    return np.stack([np.sin(angles), np.cos(angles)], axis=1)


def along_arc(start: float, end: float) -> Floats:
    """Many points of a circle of radius one, by the angle from +y to +x."""
    angles = np.linspace(start, end, 1500)
    return np.stack([np.sin(angles), np.cos(angles)], axis=1)


def revolved(points: Floats) -> Floats:
    """Points of space by how far away from the y axis and how high they are."""
    return np.stack([np.hypot(points[:, 0], points[:, 2]), points[:, 1]], axis=1)
