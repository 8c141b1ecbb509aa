"""Judges pictures of frames: every output has to lie within the reference's bounds.

The reference draws the whole frame with a device's rounding, step by step, so an error of a first
step counts in all later steps that read it. It does not trust the plan that drivers execute: it
draws the checked frame, with a texture for every result. Several outputs, and frames one after the
other, are cases.
"""

from __future__ import annotations

import pickle
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Expected, RasterRules
from ..runner.drivers.device import Device
from ..runner.frames.checking import PlanError
from ..runner.frames.helped import Given, HelpedFrames, Helpers
from ..runner.frames.host import FrameHost
from ..runner.frames.pixel_origins import FollowedFrames, Origin
from ..runner.frames.reference_textures import DEPTHS
from ..runner.frames.subjects import FrameSubject, PlannedFrame
from ..runner.kernels import is_drawn
from ..runner.reference import Program
from ..runner.routes import Route
from ..runner.runner import Runner
from ..runner.store import Store
from ..toolchain import Toolchain
from ..web_host.drawing import draw_frames
from .bounds import Bounds, bounds_of, precise, promised
from .cases import Size
from .compare import Level
from .contents import as_drawn
from .costs import help_pays
from .frame_pictures import FramePictures, OutputPicture, ingredients_of, remembered
from .judged_frames import Meant, frames_of, host_of
from .judging import Answer, CasePictures, Compared, Floats, all_covered
from .known_values import Known
from .trials import Trial


@dataclass(frozen=True, slots=True)
class _Sized:
    """The size of a picture, for the rules of a device."""

    width: int
    height: int


def _turned_over(bounds: Bounds) -> Bounds:
    """The bounds of a device whose rows count from below.

    Texts of frames draw the first row of a picture to its first row, which is the top one; so the
    device's upper side is the lower one in the picture.
    """
    rules = replace(bounds.rules, bottom_up=False, owns_bottom=not bounds.rules.owns_bottom)
    return replace(bounds, rules=rules)


class FrameTrial(Trial):
    """The outputs of one frame, drawn several times if one frame reads what the last one left."""

    def __init__(
        self,
        label: str,
        subject: FrameSubject,
        size: Size,
        store: Store | None = None,
        helpers: Helpers | None = None,
    ) -> None:
        """``size`` is that of the outputs, as far as the frame does not say another one. ``store``
        keeps the reference's pictures, and ``helpers`` may draw parts of these."""
        super().__init__(label, subject.shaders)
        self._subject = subject
        self._meant = meant = Meant(subject)
        self._size = size
        self._store, self._helpers = store, helpers
        self._count = frames_of(meant.plan)
        self._names = [row.name for row in meant.plan.outputs if row.texture is not None]
        self._expected: Known[FramePictures] = Known()
        self._programs: Known[list[Program]] = Known()

    def answers(
        self, route: Route, device: Device, runner: Runner, toolchain: Toolchain
    ) -> Iterator[Answer]:
        """The outputs of each frame. Raises ``CodeError``, ``DriverError`` and ``PlanError``."""
        got = draw_frames(self._host(self._subject), route, runner, toolchain, self._count)
        questions = self._questions(route, device)
        for case, (number, name) in self.cases().items():
            layers = got[number][name]
            yield Answer(case, questions, partial(self._within, case, layers, route.profile))

    def cases(self) -> dict[str, tuple[int, str]]:
        """The number of the frame and the output, by the name of the case."""
        return {
            name if self._count == 1 else f"{name}, frame {number + 1}": (number, name)
            for number in range(self._count)
            for name in self._names
        }

    def made(
        self, case: str, route: Route, device: Device, level: Level, pixel: tuple[int, int]
    ) -> Origin | None:
        """The origin of a pixel of a case, by the bounds of this level.

        ``None`` if no step has made the pixel. Layers of an output stand one below the other.
        """
        number, name = self.cases()[case]
        bounds = next(one for one in self._questions(route, device) if one.level == level)
        programs = self._programs_for(route.profile)
        host = self._host(self._meant)
        texture = next(row.texture for row in host.plan.outputs if row.name == name)
        assert texture is not None, "it is a picture"
        _, height = host.size_of(texture)
        drawing = FollowedFrames(
            host, bounds.rules, bounds.errors, lambda shader: programs[shader].shader,
            texture=texture, layer=pixel[1] // height, pixel=(pixel[0], pixel[1] % height),
        )  # fmt: skip
        for _ in range(number + 1):
            drawing.draw()
        return drawing.found

    def promised(self, case: str, route: Route) -> Iterator[Bounds]:  # noqa: ARG002 - alike for all
        """The bounds of a frame for all devices that keep the promises of a route's API."""
        for bounds in promised(_Sized(*self._size), route):
            yield _turned_over(bounds) if route.bottom_up else bounds

    def text_of(self, case: str, profile: str | None) -> Hashable:  # noqa: ARG002 - alike for all
        """The programs of a profile as texts, or those of the source."""
        return tuple(program.text for program in self._programs_for(profile))

    def bounded(self, case: str, profile: str | None, bounds: Bounds) -> CasePictures:
        """An output within some bounds, with its layers one below the other."""
        return self._picture(case, profile, bounds.rules, bounds.errors)

    def meant(self, case: str, bounds: Bounds) -> CasePictures:
        """An output as the source means it."""
        return self._picture(case, None, precise(bounds.rules), None)

    def host(self) -> FrameHost:
        """The frame as hosts draw it, with its scene."""
        return self._host(self._subject)

    def _picture(
        self, case: str, profile: str | None, rules: RasterRules, errors: Errors | None
    ) -> CasePictures:
        number, name = self.cases()[case]
        found = self._drawn(profile, rules, errors)[number][name]
        return CasePictures.of_formats([name], [_colour_format(found)], _expected(found))

    def _questions(self, route: Route, device: Device) -> tuple[Bounds, ...]:
        questions = tuple(bounds_of(_Sized(*self._size), route, device))
        return tuple(map(_turned_over, questions)) if route.bottom_up else questions

    def _within(self, case: str, got: Floats, profile: str, bounds: Bounds) -> Compared:
        """An output beside the reference's. Raises ``PlanError`` for one of another size."""
        number, name = self.cases()[case]

        def wanted(profile: str | None, rules: RasterRules, errors: Errors | None) -> OutputPicture:
            return self._drawn(profile, rules, errors)[number][name]

        meant = wanted(None, precise(bounds.rules), None)
        if got.shape[:3] != meant.undecided.shape:
            raise PlanError(
                f"{case} has {_sides(got.shape)}, and should have {_sides(meant.undecided.shape)}"
            )
        return Compared.of(
            [_rows(got)],
            _expected(wanted(profile, bounds.rules, bounds.errors)),
            _expected(meant),
            [_colour_format(meant)],
            lambda: _expected(wanted(None, bounds.rules, bounds.errors)),
        )

    def _drawn(
        self, profile: str | None, rules: RasterRules, errors: Errors | None
    ) -> Sequence[Mapping[str, OutputPicture]]:
        """The reference's pictures of a profile's texts, or of the source.

        They have bounds if there are ``errors``, and otherwise the values that are meant.
        """
        programs = self._programs_for(profile)

        def made() -> FramePictures:
            drawing = self._drawing(profile, rules, errors)
            found = []
            for _ in range(self._count):
                drawing.draw()
                found.append({name: OutputPicture.of(drawing.output(name)) for name in self._names})
            return FramePictures(found, drawing.counted)

        def kept() -> FramePictures:
            if self._store is None:
                return made()
            return remembered(self._store, self._ingredients(programs), rules, errors, made)

        asked = tuple(program.text for program in programs), errors
        found = self._expected.shared(
            (*asked, rules.common),
            (*asked, rules),
            kept,
            lambda pictures: rules.agree_with(pictures.counted),
        )
        return found.frames

    def _drawing(
        self, profile: str | None, rules: RasterRules, errors: Errors | None
    ) -> HelpedFrames:
        """Draws a profile's texts, or the source, from the first frame on."""
        programs, host = self._programs_for(profile), self._host(self._meant)
        return HelpedFrames(
            host, rules, errors, lambda number: programs[number].shader, helpers=self._helpers,
            pays=lambda numbers: help_pays(host, numbers),
            common=lambda given: pickle.dumps((profile, rules, errors, given)),
        )  # fmt: skip

    def part(self, common: bytes, number: int) -> bytes:
        """A part of what the trial of the same frame draws in another process, which offers it.

        Raises the exceptions of ``REFUSALS``, and ``MemoryError``.
        """
        profile, rules, errors, data = pickle.loads(common)
        given: Given = pickle.loads(data)
        return pickle.dumps(self._drawing(profile, rules, errors).drawn_for(given, number))

    def _ingredients(self, programs: Sequence[Program]) -> Sequence[str]:
        texts = [program.text for program in programs]
        return ingredients_of(self._meant, texts, self._size, self._count)

    def _programs_for(self, profile: str | None) -> list[Program]:
        return self._programs.value(profile, lambda: self._programs_of(profile))

    def _programs_of(self, profile: str | None) -> list[Program]:
        """The shaders as emitted for a profile, or those of the source."""
        found = []
        for subject in self.shaders:
            made = subject.shader if profile is None else subject.emitted(profile)
            if is_drawn(subject.reflection):
                made = as_drawn(made)
            found.append(Program.of(made))
        return found

    def _host(self, subject: PlannedFrame) -> FrameHost:
        return host_of(subject, self._size)


def _colour_format(drawn: OutputPicture) -> str:
    """The format of an output, or a colour's that holds depths."""
    return "r32f" if drawn.format.startswith(DEPTHS) else drawn.format


def _sides(shape: Sequence[int]) -> str:
    layers, height, width = shape[:3]
    return f"{width} x {height} texels" + (f" in {layers} layers" if layers > 1 else "")


def _rows(layers: Floats) -> Floats:
    """Layers, or faces, as one picture, one below the other."""
    _, _, width, lanes = layers.shape
    return layers.reshape(-1, width, lanes)


def _expected(drawn: OutputPicture) -> Expected:
    value, low, high = ([_rows(_whole(end))] for end in drawn.ends)
    layers = drawn.undecided
    return all_covered(value, low, high, layers.reshape(-1, layers.shape[-1]))


def _whole(texels: Floats) -> Floats:
    """Texels of four lanes; depths have one."""
    if texels.shape[-1] == 4:
        return texels
    missing = np.broadcast_to([0.0, 0.0, 1.0], (*texels.shape[:-1], 3))
    return np.concatenate([texels, missing], axis=-1)
