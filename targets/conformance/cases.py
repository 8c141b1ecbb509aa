"""The cases in which ``conform`` draws a material or runs a kernel: common ones, and those that
break shaders.

Together they have default and random values, all lights and none, lights inside the mesh,
non-uniform scale, back faces, triangles that cross the near and the far plane, and a picture for
every texture.
"""

from __future__ import annotations

import math
import random
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...compiler.documents.reflection import Reflection
from ...compiler.documents.steps import ParameterStep
from ..runner.binding import shows_less
from ..runner.cameras import looking
from ..runner.instances.instance import Instance
from ..runner.kernels import (
    elements_state,
    full_screen_state,
    has_images,
    is_drawn,
    is_over_buffers,
)
from ..runner.meshes import Mesh, cube, plane, sphere, torus
from ..runner.scene import Scene, with_inputs
from ..runner.scene_state import Color, SceneState, set_up
from .sample import BUFFER_SIZES, sample_buffers, sample_textures, sample_values

Size = tuple[int, int]
"""Width and height of a picture, in pixels."""

SIZE: Size = (72, 56)
"""Not square, so that an exchange of x and y is visible."""

UNCOVERED: Color = (-8.0, -8.0, -8.0, -8.0)
"""A clear colour that no shader is likely to write, so that it shows which pixels are covered."""

DRAWN_CASES = ("defaults", "stretched", "behind", "inside")
"""The names of the scenes in which every material is drawn."""

IMAGE_CASES = ("first", "second")
"""The names of the pictures of a kernel over images."""

MANY = (64, 70, 200)
ANY = (0, 1, *MANY)
ELEMENT_CASES = {"first": ANY, "second": MANY, "third": ANY}
"""The runs of a kernel over buffers, and the numbers of elements that storage buffers may get: a
whole work group, and parts of one; none or one, but not in all cases."""

BACKDROP: Color = (0.2, 0.3, 0.4, 0.5)
"""The clear colour for blending."""
BLEND_CONSTANT: Color = (0.75, 0.5, 0.25, 0.375)
"""The constant by which targets are blended, if they use one."""

FEW_TRIANGLES = 1
"""The number of triangles of one patch above which meshes get fewer patches."""
FINEST_USUAL = 6.0
"""The number of steps into which edges of patches may be divided before meshes get fewer patches.
So a draw makes 65536 vertices of patches at most: llvmpipe and lavapipe (Mesa 22.3) number those of
one draw by 16 bits, and draw others in wrong places."""
FEW_LINES = 1 / 4
"""The share of cells that a mesh has if its edges are patches of lines."""


@dataclass(frozen=True, eq=False, slots=True)
class Case:
    """One picture of a material, one run of a kernel, or one capture."""

    name: str
    state: SceneState


@dataclass(frozen=True, eq=False, slots=True)
class Series:
    """Cases that one pipeline draws, one after the other."""

    exact: bool
    """True if the targets are float32 without blending and with one sample for each pixel, which
    shows exactly what shaders write. Otherwise they have the formats, the blending and the samples
    that the pass declares."""
    cases: tuple[Case, ...]


def series_of(
    reflection: Reflection,
    seed: int = 0,
    size: Size = SIZE,
    like: Reflection | None = None,
    kept: Collection[str] = (),
) -> Iterator[Series]:
    """All cases of one material or kernel; ``seed`` is the seed of its random values.

    Pictures of a smaller ``size`` have meshes of fewer triangles: random programs are drawn so.
    The images of a kernel have sizes of their own. ``like`` is the reflection of another form of
    the material, whose meshes and textures these cases have: what is drawn with native stages is
    compared with what is drawn without, and a version of a material with the material. The ``kept``
    parameters have their defaults.
    """
    given = _Given(reflection, like or reflection, frozenset(kept))
    if has_images(reflection):
        yield Series(exact=False, cases=tuple(
            Case(name, full_screen_state(_kernel(given, seed + turn, size), UNCOVERED))
            for turn, name in enumerate(IMAGE_CASES)
        ))  # fmt: skip
        return
    if is_over_buffers(reflection):
        yield Series(exact=False, cases=tuple(
            Case(name, elements_state(given.sampled(seed + turn, sizes)))
            for turn, (name, sizes) in enumerate(ELEMENT_CASES.items())
        ))  # fmt: skip
        return
    states = (
        _defaults(given, size),
        _stretched(given, seed, UNCOVERED, size),
        _behind(given, seed + 1, size),
        _inside(given, seed + 2, size),
    )
    cases = tuple(Case(name, state) for name, state in zip(DRAWN_CASES, states, strict=True))
    yield Series(exact=is_drawn(reflection), cases=cases)
    if reflection.targets and shows_less(reflection):
        state = _stretched(given, seed, BACKDROP, size)
        state = replace(state, blend_constant=BLEND_CONSTANT)
        yield Series(exact=False, cases=(Case("declared", state),))


@dataclass(frozen=True, slots=True)
class _Given:
    """The reflection of what is drawn, and what decides about its values."""

    reflection: Reflection
    form: Reflection
    """That of the form whose meshes and textures the cases have."""
    kept: frozenset[str]
    """The parameters that have their defaults in all cases."""

    def sampled(self, seed: int, sizes: Sequence[int] = BUFFER_SIZES) -> Instance:
        """An instance with random values; storage buffers have one of some ``sizes``."""
        return self._sampled(self.reflection, seed, sizes)

    def shaped(self, seed: int) -> Instance:
        """The same of the other form."""
        return self._sampled(self.form, seed, BUFFER_SIZES)

    def _sampled(self, reflection: Reflection, seed: int, sizes: Sequence[int]) -> Instance:
        instance = Instance(reflection)
        sample_values(instance, seed, kept=self.kept)
        sample_buffers(instance, seed, sizes)
        sample_textures(instance, seed, self.form.textures)
        return instance


def _kernel(given: _Given, seed: int, size: Size) -> Instance:
    """A kernel with random values, whose images are about as large as other pictures."""
    reflection, instance = given.reflection, given.sampled(seed)
    counts = {row.count for row in reflection.buffers}
    read = {step.parameter for step in reflection.extent or () if isinstance(step, ParameterStep)}
    for row in reflection.parameters:
        if row.name in read - counts - given.kept and row.representation in ("int", "uint"):
            lo, hi = row.range or (1, max(size))
            number = random.Random(f"{seed} {row.name}").randint(min(size) // 2, max(size))
            instance.set(row.name, int(min(max(number, lo), hi)))
    return instance


def _cells(usual: int, form: Instance, size: Size) -> int:
    """The number of a mesh's cells in one direction; ``usual`` is that of the usual size.

    There are fewer if each patch is drawn with many vertices, or if lines are drawn: where many of
    them cross in one pixel, rounding decides which is seen.
    """
    draw = form.reflection.draw
    patches = draw.tessellation
    triangles = (draw.vertices or 0) / 3 if patches else 0
    share = min(1.0, math.sqrt(FEW_TRIANGLES / triangles)) if triangles else 1.0
    if patches and draw.topology == "line":
        share = FEW_LINES
    share = min(share, _divided_share(form))
    return max(3, round(usual * share * min(1.0, max(size) / max(SIZE))))


def _divided_share(form: Instance) -> float:
    """The share of cells that a mesh may have, for the levels of ``form``'s patches."""
    patches = form.reflection.draw.tessellation
    if patches is None or patches.levels is None:
        return 1.0
    finest = max(1.0, *(level for levels in form.patch_levels() for level in levels))
    return min(1.0, FINEST_USUAL / finest)


def _defaults(given: _Given, size: Size) -> SceneState:
    instance, shaped = Instance(given.reflection), Instance(given.form)
    for each in (instance, shaped):
        sample_values(each, 0, missing=True)
    mesh = sphere(_cells(32, shaped, size), _cells(16, shaped, size))
    return _state(instance, mesh, Scene(light_count=2), size)


def _stretched(given: _Given, seed: int, clear: Color, size: Size) -> SceneState:
    """A mesh that is scaled differently along each axis, with all lights, near it and inside it."""
    scene = Scene(
        looking(eye=(-0.7, 1.1, 2.6)),
        object_to_world=_turned_and_stretched(),
        light_distance=0.35,
        light_count=64,
    )
    shaped = given.shaped(seed)
    mesh = torus(_cells(24, shaped, size), _cells(16, shaped, size))
    return _state(given.sampled(seed), mesh, scene, size, clear)


def _behind(given: _Given, seed: int, size: Size) -> SceneState:
    """Back faces, and as few lights as possible."""
    scene = Scene(looking(eye=(0.9, 0.5, -2.4), look_at=(0.1, 0.0, 0.0)), light_count=0)
    cells = max(3, round(4 * min(1.0, 4 * _divided_share(given.shaped(seed)))))
    return _state(given.sampled(seed), plane(cells), scene, size)


def _inside(given: _Given, seed: int, size: Size) -> SceneState:
    """Walls around the eye, which the near and the far plane cut."""
    camera = looking(
        eye=(0.35, -0.2, 0.4),
        look_at=(-0.5, 0.1, -0.6),
        near=0.8,
        far=1.5,
        fov=math.radians(75),
    )
    return _state(given.sampled(seed), cube(), Scene(camera), size)


def _state(
    instance: Instance, mesh: Mesh, scene: Scene, size: Size, clear: Color = UNCOVERED
) -> SceneState:
    whole = with_inputs(instance.reflection, mesh)
    return set_up(instance, whole, scene, size, clear)


def _turned_and_stretched() -> tuple[tuple[float, ...], ...]:
    """A matrix that rotates, then scales by a different factor along each axis, then moves."""
    turn = math.radians(35)
    rotation = np.array(
        [[math.cos(turn), -math.sin(turn), 0], [math.sin(turn), math.cos(turn), 0], [0, 0, 1]]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = np.diag([1.3, 0.6, 0.9]) @ rotation
    matrix[:3, 3] = [0.1, -0.15, 0.2]
    return tuple(map(tuple, matrix.tolist()))
