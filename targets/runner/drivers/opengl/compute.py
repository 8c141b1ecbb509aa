"""Runs the dispatches of a kernel, and reads back what they have written."""

from __future__ import annotations

import moderngl

from ..checks import check_groups
from ..device import DriverError
from ..kernel_job import Dispatch, KernelJob, Written
from .bindings import all_bound
from .context import Functions
from .program import link_kernel
from .written_images import texels, written_images

MOST_GROUPS = "GL_MAX_COMPUTE_WORK_GROUP_COUNT"


def compute_job(context: moderngl.Context, functions: Functions, job: KernelJob) -> list[Written]:
    """What each dispatch writes. Raises ``DriverError``."""
    check_groups(job, context.info[MOST_GROUPS])
    program = link_kernel(context, functions, job.pipeline)
    try:
        return [_run(context, functions, program, job, dispatch) for dispatch in job.dispatches]
    except moderngl.Error as error:
        raise DriverError(f"OpenGL: {error}") from None
    finally:
        program.release()


def _run(
    context: moderngl.Context,
    functions: Functions,
    program: moderngl.ComputeShader,
    job: KernelJob,
    dispatch: Dispatch,
) -> Written:
    slots = job.pipeline.images
    with (
        all_bound(context, functions, job.pipeline, dispatch) as storage,
        written_images(context, slots, dispatch.extent) as images,
    ):
        if all(groups := job.groups(dispatch)):
            program.run(*groups)
        context.memory_barrier()
        pairs = zip(job.pipeline.buffers, storage, strict=True)
        written = Written(
            tuple(buffer.read() for slot, buffer in pairs if slot.written),
            tuple(texels(slot, image) for slot, image in zip(slots, images, strict=True)),
        )
    if (error := context.error) != "GL_NO_ERROR":
        raise DriverError(f"OpenGL reports {error}")
    return written
