"""Quaternions against matrices of rotations, which NumPy multiplies."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from .calls import called, directions, scattered
from .kit import PLACE, Floats, columns, moved, shown
from .truth import truth

ALL = "import std.quaternions"
COUNT = 60


def near(expected: Any, within: float = 1e-9) -> Any:
    return pytest.approx(np.asarray(expected, np.float64), abs=within)


def rotations(count: int, seed: int = 3) -> Floats:
    """Quaternions of length one without a pattern."""
    drawn = np.random.default_rng(seed).normal(size=(count, 4))
    return np.asarray(drawn / np.linalg.norm(drawn, axis=1, keepdims=True))


def matrices(q: Floats) -> Floats:
    """Their matrices, by the exponential of the axis and the angle (Rodrigues)."""
    angle = 2 * np.arctan2(np.linalg.norm(q[:, :3], axis=1), q[:, 3])
    axis = q[:, :3] / np.linalg.norm(q[:, :3], axis=1, keepdims=True)
    return np.array([turning(a, t) for a, t in zip(axis, angle, strict=True)])


def turning(axis: Floats, angle: float) -> Floats:
    """The matrix of a turn around an axis."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k)


Q, P = rotations(COUNT, 3), rotations(COUNT, 4)
V = scattered(COUNT, 3, 2)


def turned(m: Floats, v: Floats) -> Floats:
    return np.asarray(np.einsum("nij,nj->ni", m, v))


def same_rotation(found: Floats, expected: Floats, within: float = 1e-9) -> None:
    """Two quaternions turn alike if they are equal or opposite."""
    sign = np.sign(np.sum(found * expected, axis=1, keepdims=True))
    assert sign * found == near(expected, within)


@truth("std.quaternions.rotate", "std.quaternions.to_matrix", "std.quaternions.from_matrix")
def test_quaternions_turn_as_their_matrices() -> None:
    m = matrices(Q)
    assert called(ALL, "rotate(q, v)", 3, q=Q, v=V) == near(turned(m, V))
    for i in range(3):
        assert called(ALL, f"to_matrix(q)[{i}]", 3, q=Q) == near(m[:, :, i])
    same_rotation(called(ALL, "from_matrix(m)", 4, m=m), Q)


@truth("std.quaternions.nearer", "std.quaternions.side_of")
def test_what_is_as_near_is_left_as_it_is() -> None:
    motion = "DualQuaternion({}, vec4(0))"
    to, q = np.eye(4), np.roll(np.eye(4), 1, axis=1)
    assert called(ALL, "nearer(to, q)", 4, to=to, q=q) == near(q)
    sides = f"side_of({motion.format('to')}, {motion.format('q')})"
    assert called(ALL, sides, 1, to=to, q=q) == near(np.ones(4))
    assert called(ALL, sides, 1, to=to, q=-to) == near(-np.ones(4))


HALF_TURNS = np.array(
    [[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.6, 0.8, 0, 0], [0, 0.6, 0.8, 0]]
)


@truth("std.quaternions.from_matrix")
@pytest.mark.parametrize("lane", range(4))
def test_matrices_are_read_by_the_largest_lane(lane: int) -> None:
    """Where the other lanes are small, a wrong choice would lose them."""
    q = 1e-7 * scattered(20, 4)
    q[:, lane] = 1
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    same_rotation(called(ALL, "from_matrix(m)", 4, m=matrices(q)), q, 1e-13)
    same_rotation(called(ALL, "from_matrix(m)", 4, m=matrices(HALF_TURNS)), HALF_TURNS)


@truth("std.quaternions.from_matrix")
@pytest.mark.parametrize("lane", range(4))
def test_no_lane_that_is_nearly_0_decides(lane: int) -> None:
    """Whatever the other three are, the lane that matrices are read by is a large one."""
    q = np.random.default_rng(lane).normal(size=(300, 4))
    q[:, lane] = 1e-7
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    same_rotation(called(ALL, "from_matrix(m)", 4, m=matrices(q)), q, 1e-13)


@truth("std.quaternions.multiply", "std.quaternions.conjugate", "std.quaternions.identity")
def test_products_turn_one_after_the_other() -> None:
    found = called(ALL, "rotate(multiply(q, p), v)", 3, q=Q, p=P, v=V)
    assert found == near(turned(matrices(Q), turned(matrices(P), V)))
    found = called(ALL, "multiply(conjugate(q), q)", 4, q=Q)
    assert found == near(np.tile([0, 0, 0, 1], (COUNT, 1)))
    assert called(ALL, "multiply(q, identity)", 4, q=Q) == near(Q)
    assert called(ALL, "rotate(conjugate(q), v)", 3, q=Q, v=V) == near(
        turned(np.swapaxes(matrices(Q), 1, 2), V)
    )


@truth("std.quaternions.from_axis_angle")
def test_turns_around_an_axis() -> None:
    axis, angle = directions(COUNT), np.linspace(-3, 6, COUNT)
    expected = np.array([turning(a, t) for a, t in zip(axis, angle, strict=True)])
    found = called(ALL, "rotate(from_axis_angle(a, t * 1rad), v)", 3, a=axis, t=angle, v=V)
    assert found == near(turned(expected, V))


@truth("std.quaternions.from_directions")
def test_turns_from_one_direction_to_another() -> None:
    a, b = directions(COUNT, 1), directions(COUNT, 2)
    q = called(ALL, "from_directions(a, b)", 4, a=a, b=b)
    assert np.linalg.norm(q, axis=1) == near(np.ones(COUNT))
    m = matrices(q)
    assert turned(m, a) == near(b)
    # The shortest way leaves what is at a right angle to both.
    assert turned(m, np.cross(a, b)) == near(np.cross(a, b))
    # Of opposite directions, each way is as short.
    axes = np.concatenate([a, np.eye(3), -np.eye(3), [[0.6, 0, 0.8], [0.8, 0, -0.6]]])
    q = called(ALL, "from_directions(a, b)", 4, a=axes, b=-axes)
    assert np.linalg.norm(q, axis=1) == near(np.ones(len(axes)))
    assert turned(matrices(q), axes) == near(-axes)
    # Nearly opposite ones turn exactly as well.
    b = -axes + 3e-3 * np.roll(axes, 1, axis=1)
    b /= np.linalg.norm(b, axis=1, keepdims=True)
    apart = np.linalg.norm(axes + b, axis=1) > 2e-3
    found = matrices(called(ALL, "from_directions(a, b)", 4, a=axes[apart], b=b[apart]))
    assert turned(found, axes[apart]) == near(b[apart])


@truth("std.quaternions.slerp", "std.quaternions.nlerp", "std.quaternions.nearer")
@pytest.mark.parametrize("share", [0.0, 0.3, 0.5, 1.0])
def test_blends_go_the_shorter_way(share: float) -> None:
    """The turn from one to the other, as its axis and angle, to a part of it."""
    way = np.array([q @ p.T for q, p in zip(matrices(P), matrices(Q), strict=True)])
    angle = np.arccos(np.clip((np.trace(way, axis1=1, axis2=2) - 1) / 2, -1, 1))
    lean = way - np.swapaxes(way, 1, 2)
    axis = np.stack([lean[:, 2, 1], lean[:, 0, 2], lean[:, 1, 0]], axis=1)
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)

    def part_of_way(shares: Floats) -> Floats:
        parts = [turning(a, s * t) for a, t, s in zip(axis, angle, shares, strict=True)]
        return turned(np.array(parts) @ matrices(Q), V)

    found = called(ALL, f"rotate(slerp(q, p, {share}), v)", 3, q=Q, p=P, v=V)
    assert found == near(part_of_way(np.full(COUNT, share)))
    # A chord is divided evenly by nlerp, of which the angles at the middle of the circle follow.
    half = angle / 2
    seen = np.arctan2(share * np.sin(half), 1 - share + share * np.cos(half)) / half
    found = called(ALL, f"rotate(nlerp(q, p, {share}), v)", 3, q=Q, p=P, v=V)
    assert found == near(part_of_way(seen))
    # Where both are almost alike, the chord is the arc.
    close_by = unit_rows(Q + 1e-4 * P)
    found = called(ALL, f"slerp(q, r, {share})", 4, q=Q, r=close_by)
    assert found == near(unit_rows((1 - share) * Q + share * close_by))
    same_rotation(called(ALL, f"slerp(q, r, {share})", 4, q=Q, r=-Q), Q)


def unit_rows(v: Floats) -> Floats:
    return np.asarray(v / np.linalg.norm(v, axis=1, keepdims=True))


# --- dual quaternions ----------------------------------------------------------------------------

W = scattered(COUNT, 3, 2, 8)
U = scattered(COUNT, 3, 2, 9)


@truth(
    "std.quaternions.DualQuaternion", "std.quaternions.rigid", "std.quaternions.offset_of",
    "std.quaternions.rotate", "std.quaternions.multiply", "std.quaternions.to_matrix",
)  # fmt: skip
def test_dual_quaternions_turn_and_move() -> None:
    once = turned(matrices(P), V) + W
    assert called(ALL, "rotate(rigid(p, w), v)", 3, p=P, w=W, v=V) == near(once)
    assert called(ALL, "offset_of(rigid(p, w))", 3, p=P, w=W) == near(W)
    assert called(ALL, "rigid(p, w).real", 4, p=P, w=W) == near(P)
    assert called(ALL, "rigid(p, w).dual", 4, p=P, w=W) == near(0.5 * _dual(P, W))
    twice = "multiply(rigid(q, u), rigid(p, w))"
    expected = turned(matrices(Q), once) + U
    assert called(ALL, f"rotate({twice}, v)", 3, q=Q, p=P, w=W, u=U, v=V) == near(expected)
    found = called(ALL, "to_matrix(rigid(p, w)) * vec4(v, 1)", 4, p=P, w=W, v=V)
    assert found == near(np.column_stack([once, np.ones(COUNT)]))
    found = called(ALL, "to_matrix(rigid(p, w)) * vec4(v, 0)", 4, p=P, w=W, v=V)
    assert found == near(np.column_stack([once - W, np.zeros(COUNT)]))


@truth("std.quaternions.normalized")
def test_dual_quaternions_are_made_as_long_as_one() -> None:
    far = "normalized(DualQuaternion(3 * rigid(p, w).real, 3 * rigid(p, w).dual))"
    assert called(ALL, f"{far}.real", 4, p=P, w=W) == near(P)
    assert called(ALL, f"offset_of({far})", 3, p=P, w=W) == near(W)


def screw(turn: float, lift: float) -> str:
    """A turn around z and a way along it."""
    half = turn / 2
    return f"rigid(vec4(0, 0, {math.sin(half)!r}, {math.cos(half)!r}), vec3(0, 0, {lift}))"


@truth("std.quaternions.blended", "std.quaternions.side_of", "std.quaternions.normalized")
def test_motions_are_blended() -> None:
    """Screws around one axis: half way between two of them is half the angle and half the lift."""
    still = "rigid(identity, vec3(0))"
    first, second = screw(0.4, 1.0), screw(1.6, 3.0)
    for slots in ([0, 1], [0, 2], [0, 3], [1, 2]):
        places, weights = [still] * 4, ["0.0"] * 4
        for slot, motion in zip(slots, (first, second), strict=True):
            places[slot], weights[slot] = motion, "0.5"
        text = f"blended([{', '.join(places)}], vec4({', '.join(weights)}))"
        found = called(ALL, f"rotate({text}, v)", 3, v=V)
        expected = turned(np.array([turning(np.array([0, 0, 1.0]), 1.0)] * COUNT), V)
        assert found == near(np.add(expected, (0, 0, 2.0)))
    # Turned over, a quaternion means the same, whichever of the last three it is.
    over = first.replace("rigid(vec4(0, 0, ", "rigid(-vec4(0, 0, ")
    for slot in (1, 2, 3):
        places = [second, first, first, first]
        places[slot] = over
        found = called(
            ALL, f"rotate(blended([{', '.join(places)}], vec4(0.4, 0.3, 0.2, 0.1)), v)", 3, v=V
        )
        plain = 0.4 * np.exp(0.8j) + 0.6 * np.exp(0.2j)
        angle = 2 * np.angle(plain)
        at_origin = turned(np.array([turning(np.array([0, 0, 1.0]), angle)] * COUNT), V)
        assert found[:, :2] == near(at_origin[:, :2])
    # Weights count each for its own motion.
    lifts = ", ".join(f"rigid(identity, vec3({x}, 0, 0))" for x in (1, 10, 100, 1000))
    found = called(ALL, f"rotate(blended([{lifts}], vec4(0.4, 0.3, 0.2, 0.1)), v)", 3, v=V)
    assert found == near(np.add(V, (0.4 + 3 + 20 + 100, 0, 0)))


@truth("std.quaternions.DualSkinned")
@pytest.mark.parametrize("slot", range(4))
def test_a_vertex_follows_its_bones(slot: int) -> None:
    offsets = scattered(6, 3, 1, 12)
    bones = tuple(
        (tuple(q), tuple(0.5 * dual)) for q, dual in zip(Q[:6], _dual(Q[:6], offsets), strict=True)
    )
    found = shown(
        "import std.quaternions.{DualSkinned}\n"
        "material M : Surface + DualSkinned { color = vec3(object_drawn.position) }",
        vertex_joints=(4, 2, 5, 1), vertex_weights=tuple(np.eye(4)[slot]), rigid_bones=bones,
        object_to_world=columns(np.eye(4)),
    )  # fmt: skip
    bone = (4, 2, 5, 1)[slot]
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = matrices(Q[bone : bone + 1])[0], offsets[bone]
    assert found == near(moved(whole, PLACE))


def _dual(q: Floats, offset: Floats) -> Floats:
    """The product of a pure quaternion and a quaternion, as Hamilton has it."""
    x, y, z = offset.T
    a, b, c, d = q.T
    return np.stack(
        [
            x * d + y * c - z * b,
            y * d + z * a - x * c,
            z * d + x * b - y * a,
            -x * a - y * b - z * c,
        ],
        axis=1,
    )


@pytest.mark.parametrize(
    "expression",
    [
        "slerp(o, o, k)", "nlerp(q, -q, k)", "from_axis_angle(o.xyz, 0deg)", "rotate(o, o.xyz), 0",
        "from_directions(o.xyz, o.xyz)", "from_directions(q.xyz, -q.xyz)", "from_matrix(mat3(k))",
        "normalized(DualQuaternion(o, q)).dual", "to_matrix(o)[0], 0",
    ],
)  # fmt: skip
def test_no_rotation_is_without_a_number(expression: str) -> None:
    given = {"o": np.zeros((1, 4)), "k": np.zeros(1), "q": np.array([[0.6, 0, 0.8, 0]])}
    used = {name: value for name, value in given.items() if name in expression}
    assert np.isfinite(called(ALL, expression, 4, **used)).all()
