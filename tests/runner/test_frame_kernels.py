"""The results of kernels in frame jobs stay on the device, where later steps read them."""

from __future__ import annotations

import numpy as np

from burnish.compiler.documents.plan import BufferState
from burnish.targets.runner.drivers.frame_job import Barrier, BufferBarrier, FrameBuffer, FrameStep

from .frame_kit import (
    SIZE,
    TWICE,
    Driver,
    back,
    buffer_slot,
    dispatched,
    drawn_first,
    image_slot,
    job,
    reading,
    slot,
    step,
    texture,
)


def test_a_step_reads_the_image_that_a_kernel_has_written(driver: Driver) -> None:
    text = """layout(binding = 0, rgba32f) writeonly uniform image2D result;
void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    imageStore(result, texel, vec4(texel, 0.5, 1.0));
}
"""
    kernel = driver.kernel(text, images=(image_slot(),))
    run = FrameStep(
        (Barrier(0, "undefined", "image"),),
        draws=(dispatched(0),),
        images=(0,),
        groups=(SIZE, SIZE, 1),
    )
    written, doubled = driver.draw(
        job(
            [texture(), texture()],
            [kernel, driver.pipeline(TWICE, textures=(slot(),))],
            run,
            step(1, reading(1, 0), barriers=(Barrier(0, "image", "sampled"), *drawn_first(1))),
            back(0, before="sampled"),
            back(1),
        )
    )
    expected = np.array([[(x, y, 0.5, 1.0) for x in range(SIZE)] for y in range(SIZE)], np.float32)
    np.testing.assert_array_equal(written[0], expected)
    np.testing.assert_array_equal(doubled[0], 2 * expected)


def test_buffers_stay_on_the_device_from_kernel_to_kernel_to_draw(driver: Driver) -> None:
    """A kernel writes a square for each element; a second one adds 1; a draw paints them."""
    squares = """layout(std430, binding = 0) writeonly buffer buffer_0 { float result[]; };
void main() { uint i = gl_GlobalInvocationID.x; result[i] = float(i * i); }
"""
    more = """layout(std430, binding = 0) readonly buffer buffer_0 { float before[]; };
layout(std430, binding = 1) writeonly buffer buffer_1 { float result[]; };
void main() { uint i = gl_GlobalInvocationID.x; result[i] = before[i] + 1.0; }
"""
    paint = """layout(std430, binding = 0) readonly buffer buffer_0 { float before[]; };
layout(location = 0) out vec4 target;
void main() { target = vec4(before[int(gl_FragCoord.x)]); }
"""
    written = buffer_slot(0, written=True), buffer_slot(1, written=True)
    (found,) = driver.draw(
        job(
            [texture()],
            [
                driver.kernel(squares, buffers=written[:1]),
                driver.kernel(more, buffers=(buffer_slot(0), written[1])),
                driver.pipeline(paint, buffers=(buffer_slot(0),)),
            ],
            FrameStep(
                draws=(dispatched(0, buffers=[0]),),
                groups=(SIZE, 1, 1),
                buffer_barriers=(BufferBarrier(0, "undefined", "written"),),
            ),
            FrameStep(
                draws=(dispatched(1, buffers=[0, 1]),),
                groups=(SIZE - 1, 1, 1),
                buffer_barriers=(
                    BufferBarrier(0, "written", "read"),
                    BufferBarrier(1, "undefined", "written"),
                ),
            ),
            FrameStep(buffer_barriers=(BufferBarrier(1, "written", "read"),)),
            step(0, reading(2, buffers=[1]), barriers=drawn_first(0)),
            back(0),
            buffers=[FrameBuffer(SIZE), FrameBuffer(SIZE, initial=0x42C80000)],
        )
    )
    # The last element is what the buffer held at first.
    np.testing.assert_array_equal(found[0, :, :, 0], [[1.0, 2.0, 5.0, 100.0]] * SIZE)


def test_two_buffers_take_turns(driver: Driver) -> None:
    """One kernel runs again and again, each time over what it wrote before."""
    rounds = 5
    more = """layout(std430, binding = 0) readonly buffer buffer_0 { float before[]; };
layout(std430, binding = 1) writeonly buffer buffer_1 { float result[]; };
void main() { uint i = gl_GlobalInvocationID.x; result[i] = 2.0 * before[i] + 1.0; }
"""
    paint = """layout(std430, binding = 0) readonly buffer buffer_0 { float before[]; };
layout(location = 0) out vec4 target;
void main() { target = vec4(before[int(gl_FragCoord.x)]); }
"""
    uses: list[BufferState] = ["undefined", "undefined"]

    def waiting(number: int, use: BufferState) -> BufferBarrier:
        before, uses[number] = uses[number], use
        return BufferBarrier(number, before, use)

    runs = [
        FrameStep(
            draws=(dispatched(0, buffers=[number % 2, 1 - number % 2]),),
            groups=(SIZE, 1, 1),
            buffer_barriers=(waiting(number % 2, "read"), waiting(1 - number % 2, "written")),
        )
        for number in range(rounds)
    ]
    (found,) = driver.draw(
        job(
            [texture()],
            [
                driver.kernel(more, buffers=(buffer_slot(0), buffer_slot(1, written=True))),
                driver.pipeline(paint, buffers=(buffer_slot(0),)),
            ],
            *runs,
            FrameStep(buffer_barriers=(waiting(rounds % 2, "read"),)),
            step(0, reading(1, buffers=[rounds % 2]), barriers=drawn_first(0)),
            back(0),
            buffers=[FrameBuffer(SIZE), FrameBuffer(SIZE)],
        )
    )
    np.testing.assert_array_equal(found[0], np.full((SIZE, SIZE, 4), 2.0**rounds - 1))
