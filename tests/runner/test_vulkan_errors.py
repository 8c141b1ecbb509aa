"""A Vulkan worker reports jobs that cannot be drawn, and survives them."""

from __future__ import annotations

import io
import json
import os
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from subprocess import PIPE
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Code, Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import BlockSlot, Place, TextureSlot
from burnish.targets.runner.drivers.texels import Image
from burnish.targets.runner.drivers.vulkan.driver import VulkanDriver
from burnish.targets.runner.runner import frame_request
from burnish.targets.toolchain.limits import WORKERS
from burnish.targets.toolchain.pipe import Packet, receive, send

from ..suite.processes import Background, run, started
from .jobs_kit import draw_job
from .vulkan_kit import (
    PAINT,
    PLACE,
    WHITE,
    WHOLE,
    Asker,
    draw_of,
    flat_pipeline,
    floats,
    glsl,
    painted_pipeline,
    shading,
    spirv,
)

PAINTED = """#version 450
layout(set = 0, binding = 0) uniform Paint { mat3 turn; vec4 paint[2]; float last; };
layout(location = 0) out vec4 target;
void main() { target = paint[0] * turn[2].z + last; }
"""
"""A fragment shader whose block ends at 48 + 32 + 4 bytes."""

SPIN = """#version 450
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Turns { uint count; };
void main() {
    uint value = 1u;
    for (uint i = 0u; i < count; i++) { value = value * 1664525u + 1013904223u; }
    target = vec4(float(value));
}
"""


def refusal(vulkan: Asker, pipeline: Pipeline, **draw: Any) -> str:
    """The error of a job that is not drawn; the worker has to draw the next one all the same."""
    with pytest.raises(DriverError) as error:
        vulkan.one(pipeline, replace(draw_of(WHOLE), **draw))
    assert np.all(vulkan.one(flat_pipeline(), draw_of(WHOLE)) == 1.0)
    return str(error.value)


def block(size: int) -> tuple[BlockSlot, ...]:
    return (BlockSlot(Place("Paint", 0, 0), size),)


def test_a_block_may_be_as_small_as_what_is_read_of_it(vulkan: Asker) -> None:
    data = bytes(4 * (8 + 2)) + floats(1.0) + bytes(4) + floats(*[0.5] * 4) + bytes(16)
    pipeline = flat_pipeline(PAINTED, blocks=block(84))
    draw = draw_of(WHOLE, blocks=[data + floats(0.25)])
    assert vulkan.one(pipeline, draw)[0, 0].tolist() == [0.75] * 4


def test_a_block_that_is_smaller_than_the_shader_reads(vulkan: Asker) -> None:
    said = refusal(vulkan, flat_pipeline(PAINTED, blocks=block(80)), blocks=(bytes(80),))
    assert said == "uniform block 'Paint' has 84 bytes in the shader, but only 80 are bound"


def test_too_few_bytes_for_a_block(vulkan: Asker) -> None:
    said = refusal(vulkan, flat_pipeline(PAINTED, blocks=block(96)), blocks=(bytes(95),))
    assert said == "draw 0: uniform block 'Paint' is given 95 bytes, and takes 96"


def test_a_block_beyond_what_the_device_takes(vulkan: Asker) -> None:
    size = 1 << 20
    said = refusal(vulkan, flat_pipeline(PAINTED, blocks=block(size)), blocks=(bytes(size),))
    assert "takes at most" in said


def test_an_index_beyond_the_vertices(vulkan: Asker) -> None:
    said = refusal(vulkan, flat_pipeline(), indices=bytes([0, 0, 0, 0, 1, 0, 0, 0, 6, 0, 0, 0]))
    assert said == "draw 0: index 6 is beyond the 6 vertices"


def test_a_picture_that_is_too_large(vulkan: Asker) -> None:
    said = refusal(vulkan, flat_pipeline(), width=100_000)
    assert said.startswith("draw 0: the picture is 100000 × 8, and the device takes 1 × 1 to ")


def test_a_picture_of_no_pixels(vulkan: Asker) -> None:
    assert "8 x 0 pixels" in refusal(vulkan, flat_pipeline(), height=0)


def test_too_many_targets(vulkan: Asker) -> None:
    said = refusal(vulkan, flat_pipeline(targets=(RenderTarget("rgba32float"),) * 9))
    assert said == "there are 9 targets, and the device has at most 8"


def test_a_place_without_set_and_binding(vulkan: Asker) -> None:
    blocks = (BlockSlot(Place("Paint", None, None), 96),)
    said = refusal(vulkan, flat_pipeline(PAINTED, blocks=blocks), blocks=(bytes(96),))
    assert said == "'Paint' has no descriptor set and binding"


def test_a_set_beyond_the_last(vulkan: Asker) -> None:
    blocks = (BlockSlot(Place("Paint", 40, 0), 96),)
    said = refusal(vulkan, flat_pipeline(PAINTED, blocks=blocks), blocks=(bytes(96),))
    assert said.startswith("'Paint' is in descriptor set 40, and the device has ")


def test_a_texture_that_is_too_large(vulkan: Asker) -> None:
    combined = """#version 450
    layout(set = 0, binding = 0) uniform sampler2D image;
    layout(location = 0) out vec4 target;
    void main() { target = texture(image, vec2(0.5)); }
    """
    pipeline = flat_pipeline(combined, textures=(TextureSlot(Place("image", 0, 0), None),))
    image = Image("rgba8unorm", 50_000, 1, (bytes(200_000),))
    assert "texture 'image' is 50000 × 1" in refusal(vulkan, pipeline, textures=(image,))


# --- what only the validation layer sees -------------------------------------------------------


def corrupted(words: dict[int, int]) -> Code:
    """A shader with some words of its SPIR-V replaced."""
    code = bytearray(spirv("frag", WHITE))
    for index, word in words.items():
        code[4 * index : 4 * index + 4] = word.to_bytes(4, "little")
    return Code("main", spirv=bytes(code))


@pytest.mark.parametrize(
    ("code", "said"),
    [
        (Code("main", spirv=b"nonsense"), "the fragment shader: not a SPIR-V module"),
        (Code("main"), "the fragment shader: not a SPIR-V module"),
        (Code("main", text=WHITE), "the fragment shader: not a SPIR-V module"),
        (corrupted({3: 1}), "InconsistentSpirv"),  # too low a bound of ids
        (corrupted({1: 0x00010600}), "InconsistentSpirv"),  # SPIR-V 1.6, beyond Vulkan 1.1
        (Code("other", spirv=spirv("frag", WHITE)), "VUID-"),
    ],
    ids=["nonsense", "nothing", "text", "bound", "version", "entry"],
)
def test_code_that_is_no_code(vulkan: Asker, code: Code, said: str) -> None:
    assert said in refusal(vulkan, shading(flat_pipeline(), code))


def wrong_stage() -> Pipeline:
    return shading(flat_pipeline(), glsl("vert", PAINT.replace("target =", "gl_Position =")
        .replace("layout(location = 0) out vec4 target;", "")))  # fmt: skip


def binding_of_another_type() -> Pipeline:
    """The shader has a block where the job has a texture."""
    return flat_pipeline(PAINTED, textures=(TextureSlot(Place("Paint", 0, 0), None),))


MISTAKES: dict[str, Callable[[], Pipeline]] = {
    "nothing bound": lambda: flat_pipeline(PAINTED),
    "another binding": lambda: flat_pipeline(
        PAINTED, blocks=(BlockSlot(Place("Paint", 0, 1), 96),)
    ),
    "another type": binding_of_another_type,
    "no vertex input": lambda: replace(flat_pipeline(), inputs=()),
    "an integer for a float": lambda: replace(
        flat_pipeline(), inputs=(replace(PLACE, format="sint32x3"),)
    ),
    "an input that nobody reads": lambda: replace(
        flat_pipeline(), inputs=(PLACE, VertexInput("more", 1, "float32x3"))
    ),
    "a varying that nobody writes": lambda: shading(flat_pipeline(), glsl("frag", PAINT)),
    "a target that nobody writes": lambda: painted_pipeline(
        RenderTarget("rgba32float"), RenderTarget("rgba32float")
    ),
    "the wrong stage": wrong_stage,
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_word_of_the_validation_layer_is_fatal(vulkan: Asker, mistake: str) -> None:
    pipeline = MISTAKES[mistake]()
    draw = draw_of(WHOLE, [[1.0, 1.0, 1.0, 1.0]] * 6)
    given = dict(zip(("place", "paint"), draw.vertices, strict=True))
    said = refusal(
        vulkan,
        pipeline,
        vertices=tuple(given.get(each.identifier, draw.vertices[0]) for each in pipeline.inputs),
        blocks=(bytes(96),) * len(pipeline.blocks),
        textures=(Image("rgba8unorm", 1, 1, (bytes(4),)),) * len(pipeline.textures),
    )
    first, _, rest = said.partition("\n")
    assert first == "Vulkan refuses a part of the job:"
    assert "Validation" in rest or "VUID" in rest


def test_a_lack_of_memory_is_told_in_words() -> None:
    """Drivers say the name of the code, which tells a user nothing."""
    vk = pytest.importorskip("vulkan")
    from burnish.targets.runner.drivers.vulkan.errors import Messages, explained

    messages = Messages()
    messages._texts.append("VK_ERROR_OUT_OF_HOST_MEMORY")
    with pytest.raises(DriverError) as error, explained(messages):
        raise vk.VkErrorOutOfHostMemory
    assert str(error.value) == "there is not enough memory"
    messages.check()


def test_a_device_that_is_lost_is_what_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """A layer objects to how it is closed, which must not take the place of that."""
    vk = pytest.importorskip("vulkan")
    from burnish.targets.runner.drivers.vulkan import frame, limits
    from burnish.targets.runner.drivers.vulkan.errors import DeviceLostError, Messages

    driver = VulkanDriver("", 1.0)
    gpu = SimpleNamespace(messages=Messages())
    monkeypatch.setattr(driver, "_gpu", gpu)
    monkeypatch.setattr(limits, "check_limits", lambda *_: None)

    def lose(*_: Any) -> Any:
        gpu.messages._texts.append("an object was not destroyed")
        raise vk.VkErrorDeviceLost

    monkeypatch.setattr(frame, "draw_frame", lose)
    with pytest.raises(DeviceLostError) as error:
        driver.draw_frame(FrameJob((), (), (), ()))
    assert str(error.value) == "the device was lost"
    assert driver._gpu is None


def test_a_varying_that_nobody_reads_is_no_mistake(vulkan: Asker) -> None:
    """A compiler may find out that the fragment shader does not need it."""
    pipeline = shading(painted_pipeline(), glsl("frag", WHITE))
    assert np.all(vulkan.one(pipeline, draw_of(WHOLE, [[0.5, 0.5, 0.5, 1.0]] * 6)) == 1.0)


def test_the_layer_does_not_tire_of_saying_it(vulkan: Asker) -> None:
    """The layer can be set to report a message only a few times; then later jobs would pass."""
    pipeline = MISTAKES["nothing bound"]()
    said = {refusal(vulkan, pipeline).partition("]")[0] for _ in range(15)}
    assert len(said) == 1


# --- drivers and layers that are not there -----------------------------------------------------


def said_by(command: list[str], **environment: str) -> str:
    """A fresh worker's answer to who it is."""
    worker = run(command, text="{}\n", check=True, env=os.environ | environment)
    return str(json.loads(worker.stdout).get("error", ""))


def test_a_driver_that_is_not_there() -> None:
    module = "burnish.targets.runner.drivers.vulkan"
    said = said_by([sys.executable, "-m", module, "/nowhere/icd.json"])
    assert said == "there is no Vulkan driver at /nowhere/icd.json"


def test_a_driver_that_is_none(tmp_path: Path) -> None:
    icd = tmp_path / "icd.json"
    icd.write_text("{}")
    said = said_by([sys.executable, "-m", "burnish.targets.runner.drivers.vulkan", str(icd)])
    assert said.startswith("loader_parse_icd_manifest")


def test_nothing_is_drawn_without_the_validation_layer(vulkan: Asker, tmp_path: Path) -> None:
    said = said_by(vulkan.command, VK_LAYER_PATH=str(tmp_path))
    assert said.startswith("VK_LAYER_KHRONOS_validation is missing, and nothing is drawn without")
    assert "vulkan-validationlayers" in said


def test_python_cannot_talk_to_vulkan(vulkan: Asker, tmp_path: Path) -> None:
    """A worker would find a module of that name only in the folder of its packages."""
    (tmp_path / "vulkan.py").write_text("raise OSError('Cannot find Vulkan')")
    module = vulkan.command.index("burnish.targets.runner.drivers.vulkan")
    command = [sys.executable, "-m", *vulkan.command[module:]]
    said = said_by(command, PYTHONPATH=str(tmp_path))
    assert said == "Vulkan cannot be used: Cannot find Vulkan"


# --- workers -----------------------------------------------------------------------------------


def request(pipeline: Pipeline, **draw: Any) -> Packet:
    return frame_request(draw_job(pipeline, (replace(draw_of(WHOLE), **draw),)))


def sent(*requests: Packet) -> bytes:
    """The bytes that a worker reads."""
    stream = io.BytesIO()
    for each in requests:
        send(each, stream)
    return stream.getvalue()


def test_a_worker_leaves_nothing_behind(vulkan: Asker) -> None:
    """The layer would speak of objects that are not destroyed, and the exit code would tell."""
    good = request(flat_pipeline())
    bad = request(flat_pipeline(PAINTED))
    with started(vulkan.command, stdin=PIPE) as program:
        worker = program.ended(sent(good, bad, good))
    answers = io.BytesIO(worker.stdout.encode("utf-8", "surrogateescape"))
    for expected in ("found", "error", "found"):
        assert list(receive(answers, WORKERS.output).content) == [expected]
    assert not answers.read()
    assert (worker.returncode, worker.stderr) == (0, "")


def endless() -> tuple[Pipeline, dict[str, Any]]:
    """A draw of many seconds, whatever the driver."""
    pipeline = flat_pipeline(SPIN, blocks=(BlockSlot(Place("Turns", 0, 0), 4),))
    return pipeline, {"width": 2048, "height": 2048, "blocks": (b"\xff\xff\xff\xff",)}


def test_a_draw_without_end_ends_the_worker(vulkan: Asker) -> None:
    pipeline, draw = endless()
    with started([*vulkan.command, "", "0.5"], stdin=PIPE) as program:
        worker = program.ended(sent(request(pipeline, **draw)))
    assert worker.returncode == 3
    assert worker.stdout == ""
    assert worker.stderr == "the device did not finish drawing within 0.5 s\n"


def test_a_worker_that_takes_too_long_is_replaced(vulkan: Asker) -> None:
    pipeline, draw = endless()
    answer = vulkan.answer(request(pipeline, **draw), time_limit=1.0)
    assert answer.ending == "timeout"
    assert np.all(vulkan.one(flat_pipeline(), draw_of(WHOLE)) == 1.0)


def test_a_worker_that_is_killed_is_replaced(vulkan: Asker) -> None:
    pipeline, draw = endless()

    def kill() -> None:
        time.sleep(0.5)
        vulkan.kill()

    killer = Background(kill)
    answer = vulkan.answer(request(pipeline, **draw))
    killer.returned()
    assert answer.ending == "crashed"
    assert "killed by signal 9" in answer.log
    assert np.all(vulkan.one(flat_pipeline(), draw_of(WHOLE)) == 1.0)


def test_jobs_do_not_pile_up_in_memory(vulkan: Asker) -> None:
    """Each needs more than 300 KiB while it runs, and so much more if one of its images stayed."""
    job = draw_job(painted_pipeline(), (draw_of(WHOLE, [[0.5] * 4] * 6, size=(96, 96)),))
    for _ in range(20):
        vulkan.draw(job)
    before = vulkan.resident_bytes()
    for _ in range(130):
        vulkan.draw(job)
    assert vulkan.resident_bytes() - before < 16 << 20
