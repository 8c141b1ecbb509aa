"""Wrong frame jobs, each of which is right but for one mistake: no driver gets to see them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_checks import check_frame
from burnish.targets.runner.drivers.frame_job import (
    Attachment,
    Barrier,
    BufferBarrier,
    FrameBuffer,
    FrameJob,
    FrameStep,
)
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.render_state import RenderTarget

from .frame_kit import (
    PAINT_SLOT,
    RED,
    SIZE,
    Driver,
    back,
    buffer_slot,
    dispatched,
    drawn_first,
    image_slot,
    job,
    painted,
    reading,
    slot,
    step,
    texture,
)
from .textual_kit import Asker

Change = Callable[[FrameJob], FrameJob]

PAINTING = Pipeline({}, (), (PAINT_SLOT,), (), (RenderTarget("rgba32float"),))
READING = Pipeline({}, (), (), (slot(),), (RenderTarget("rgba32float"),))
WRITING = Pipeline({}, (), (), (), (), images=(image_slot(),))
SUMMING = Pipeline({}, (), (), (), (), buffers=(buffer_slot(0, written=True),))

DRAWN, READ, COPIED, DEPTHS, IMAGE = range(5)
"""The numbers of the textures, by what happens to them."""
DRAW, RUN, SUM, LOOK, COPY, BACK = range(6)
"""The numbers of the steps."""


def right() -> FrameJob:
    """A job with steps of all kinds."""
    draw = painted(RED)
    assert draw.draw is not None
    look = reading(1, DRAWN)
    assert look.draw is not None
    return job(
        [texture(), texture(), texture(), texture(format="depth32float"), texture()],
        [PAINTING, READING, WRITING, SUMMING],
        FrameStep(
            (*drawn_first(DRAWN), Barrier(DEPTHS, "undefined", "depth")),
            (Attachment(DRAWN),),
            Attachment(DEPTHS, clear=(1.0, 0.0, 0.0, 0.0), stores=False),
            (replace(draw, draw=replace(draw.draw, vertices=())),),
        ),
        FrameStep((Barrier(IMAGE, "undefined", "image"),), draws=(dispatched(2),), images=(IMAGE,)),
        FrameStep(
            draws=(dispatched(3, buffers=[0]),),
            groups=(SIZE, 1, 1),
            buffer_barriers=(BufferBarrier(0, "undefined", "written"),),
        ),
        step(
            READ,
            replace(look, draw=replace(look.draw, vertices=())),
            barriers=(Barrier(DRAWN, "target", "sampled"), *drawn_first(READ)),
        ),
        FrameStep(
            (Barrier(READ, "target", "copied_from"), Barrier(COPIED, "undefined", "copied_to")),
            copied=(READ, COPIED),
        ),
        back(COPIED, before="copied_to"),
        buffers=[FrameBuffer(SIZE)],
    )


def with_step(number: int, **changes: Any) -> Change:
    """The change of a job in which a step is another one."""

    def changed(made: FrameJob) -> FrameJob:
        steps = list(made.steps)
        steps[number] = replace(steps[number], **changes)
        return replace(made, steps=tuple(steps))

    return changed


def with_texture(number: int, **changes: Any) -> Change:
    """The change of a job in which a texture is another one."""

    def changed(made: FrameJob) -> FrameJob:
        textures = list(made.textures)
        textures[number] = replace(textures[number], **changes)
        return replace(made, textures=tuple(textures))

    return changed


def with_draw(number: int, **changes: Any) -> Change:
    """The change of a job in which the only draw of a step is another one."""

    def changed(made: FrameJob) -> FrameJob:
        (drawn,) = made.steps[number].draws
        return with_step(number, draws=(replace(drawn, **changes),))(made)

    return changed


def without_block(made: FrameJob) -> FrameJob:
    """A draw that sets no colour."""
    (drawn,) = made.steps[DRAW].draws
    assert drawn.draw is not None
    return with_draw(DRAW, draw=replace(drawn.draw, blocks=()))(made)


def without_step(number: int) -> Change:
    """The change of a job in which a step does nothing but wait."""
    return with_step(number, targets=(), depth=None, draws=(), images=(), copied=())


def twice(number: int, *, loads: bool = False) -> Change:
    """The change of a job in which a step comes twice, and its barriers only once."""

    def changed(made: FrameJob) -> FrameJob:
        again = replace(made.steps[number], barriers=(), buffer_barriers=())
        targets = tuple(replace(each, loads=loads) for each in again.targets)
        again = replace(again, targets=targets, depth=None)
        steps = (*made.steps[: number + 1], again, *made.steps[number + 1 :])
        return replace(made, steps=steps)

    return changed


NUMBERS: list[tuple[Change, str]] = [
    (with_draw(LOOK, textures=(9,)), "step 3: there is no texture 9; the job has 5"),
    (with_draw(LOOK, pipeline=4), "step 3: there is no pipeline 4; the job has 4"),
    (with_draw(SUM, buffers=(-2,)), "step 2: there is no buffer -2; the job has 1"),
    (
        with_step(SUM, buffer_barriers=(BufferBarrier(1, "undefined", "written"),)),
        "step 2: there is no buffer 1; the job has 1",
    ),
    (with_step(BACK, read=(5,)), "step 5: there is no texture 5; the job has 5"),
]
FITTING: list[tuple[Change, str]] = [
    (
        with_draw(LOOK, textures=(DEPTHS,)),
        "step 3: texture 'before' is given texture 3, which is 2d of depth32float, and is 2d of "
        "float",
    ),
    (
        with_texture(DRAWN, dimension="cube", layers=6),
        "step 3: texture 'before' is given texture 0, which is cube of rgba32float, and is 2d of "
        "float",
    ),
    (with_draw(LOOK, textures=()), "step 3: 0 textures are named, and the pipeline has 1"),
    (with_draw(SUM, buffers=()), "step 2: 0 storage buffers are named, and the pipeline has 1"),
    (
        with_draw(LOOK, textures=(-1,)),
        "step 3: 0 textures are given, and the pipeline has 1",
    ),
    (without_block, "step 0: 0 uniform blocks are given, and the pipeline has 1"),
    (
        with_texture(DRAWN, format="rgba8unorm"),
        "step 0: target formats are rgba8unorm, and the pipeline has rgba32float",
    ),
    (
        with_step(RUN, images=()),
        "step 1: image formats are none, and the pipeline has rgba32float",
    ),
    (
        with_step(DRAW, targets=(Attachment(DEPTHS),)),
        "step 0: texture 3 of depth32float cannot be drawn to as a target",
    ),
    (
        with_step(DRAW, depth=Attachment(READ)),
        "step 0: texture 1 of rgba32float cannot be drawn to as depths",
    ),
    (
        with_texture(DEPTHS, width=2),
        "step 0: its targets have different sizes: 2 x 4 and 4 x 4",
    ),
    (
        with_step(LOOK, targets=(Attachment(READ, level=1),)),
        "step 3: texture 1 has no layer 0, level 1",
    ),
    (
        with_step(LOOK, targets=(Attachment(READ, layer=2),)),
        "step 3: texture 1 has no layer 2, level 0",
    ),
    (
        with_texture(COPIED, height=2),
        "step 4: texture 1 cannot be copied to 2, which is of another kind",
    ),
]
ORDER: list[tuple[Change, str]] = [
    (
        with_step(LOOK, barriers=drawn_first(READ)),
        "step 3: texture 0 is used as 'sampled', but its use is 'target'",
    ),
    (
        with_step(LOOK, barriers=(Barrier(DRAWN, "image", "sampled"), *drawn_first(READ))),
        "step 3: a barrier takes texture 0 from 'image', but its use is 'target'",
    ),
    (
        with_step(RUN, barriers=()),
        "step 1: texture 4 is used as 'image', but its use is 'undefined'",
    ),
    (
        twice(DRAW, loads=True),
        "step 1: no barrier waits for what is written to texture 0, layer 0, level 0, and it is "
        "written again",
    ),
    (
        twice(RUN),
        "step 2: no barrier waits for what is written to texture 4, layer 0, level 0, and it is "
        "written again",
    ),
    (
        with_step(SUM, buffer_barriers=()),
        "step 2: buffer 0 is used as 'written', but its use is 'undefined'",
    ),
    (
        with_step(SUM, buffer_barriers=(BufferBarrier(0, "read", "written"),)),
        "step 2: a barrier takes buffer 0 from 'read', but its use is 'undefined'",
    ),
    (
        twice(SUM),
        "step 3: no barrier waits for what is written to buffer 0, and it is written again",
    ),
    (
        with_step(DRAW, targets=(Attachment(DRAWN, loads=True),)),
        "step 0: texture 0 is read, but nothing has drawn its layer 0, level 0",
    ),
    (
        with_step(DRAW, targets=(Attachment(DRAWN, stores=False),)),
        "step 3: texture 0 is read, but nothing has drawn its layer 0, level 0",
    ),
    (
        with_texture(DRAWN, levels=2),
        "step 3: texture 0 is read, but nothing has drawn its layer 0, level 1",
    ),
    (without_step(COPY), "step 5: texture 2 is read, but nothing has drawn its layer 0, level 0"),
    (
        with_draw(LOOK, textures=(READ,)),
        "step 3: texture 1 is used as 'sampled', but its use is 'target'",
    ),
]


def test_the_right_job_is_right() -> None:
    check_frame(right())


@pytest.mark.parametrize(("change", "message"), [*NUMBERS, *FITTING, *ORDER])
def test_a_wrong_job_is_refused(change: Change, message: str) -> None:
    with pytest.raises(DriverError) as error:
        check_frame(change(right()))
    assert str(error.value) == message


def test_a_black_texture_can_be_read_at_once() -> None:
    made = with_texture(IMAGE, is_black=True)(right())
    waits = (Barrier(IMAGE, "sampled", "image"),)
    check_frame(with_step(RUN, barriers=waits)(made))
    check_frame(replace(made, steps=(back(IMAGE, before="sampled"),)))


def test_the_worker_checks_a_job_before_it_draws() -> None:
    asker = Asker("opengl")
    try:
        with pytest.raises(DriverError, match=r"^step 3: texture 0 is used as 'sampled'"):
            Driver("opengl", asker).draw(with_step(LOOK, barriers=drawn_first(READ))(right()))
    finally:
        asker.close()
