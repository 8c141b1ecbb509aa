"""The files from which others draw the cases of a golden folder themselves."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from ....compiler.documents.reflection import Reflection
from ....compiler.documents.writing import to_text
from ...runner.capturing import give_elements
from ...runner.drivers.draws import Dispatch, Draw, Sides
from ...runner.drivers.texels import Image
from ...runner.kernels import dispatch_of, has_images
from ...runner.scene_state import SceneState
from ...runner.subject import Subject
from ...web_host.package import frame_package, without_source_maps
from ..frames import FrameTrial
from ..trials import ShaderTrial
from .document import DrawInputs, FrameInputs, ShaderInputs, ShaderText, TextureInput
from .names import file_name

Keep = Callable[[str, bytes], str]
"""Keeps a file under a name, and returns its path from the folder of the document."""
SHADER, FRAME = "shader", "frame"
"""The folders of a subject beside those of its cases, for what all cases share."""


class Files:
    """The files of one subject. Those that several cases share are kept once."""

    def __init__(self, folder: str, contents: dict[str, bytes]) -> None:
        """``folder`` is that of the subject; ``contents`` gets all files by their paths."""
        self._folder, self._contents = folder, contents
        self._kept: dict[str, tuple[str, bytes]] = {}
        """The files by their paths in small letters, which are one for some systems."""

    def keep(self, name: str, content: bytes) -> str:
        """Keep a file under a name; if other contents have it, under the next one that is free."""
        stem, dot, ending = name.rpartition(".")
        path, number = f"{self._folder}/{name}", 1
        while self._kept.setdefault(path.casefold(), (path, content)) != (path, content):
            number += 1
            path = f"{self._folder}/{stem}-{number}{dot}{ending}"
        self._contents[path] = content
        return path


def shader_inputs(
    trial: ShaderTrial, case: str, profiles: Iterable[str], files: Files, folder: str
) -> ShaderInputs:
    """The inputs of a case of a single shader; ``folder`` is that of the case in the subject's."""

    def keep(name: str, content: bytes) -> str:
        return files.keep(f"{folder}/inputs/{file_name(name)}", content)

    form, state = trial.form(case), trial.cases()[case]
    reflection, calls = form.reflection, _calls(state)
    document = to_text(without_source_maps(reflection)).encode()
    first, names = calls[0], _buffer_names(reflection)
    textures = [row.name for row in reflection.textures if row.stages]
    return ShaderInputs(
        kind="shader",
        reflection=files.keep(f"{SHADER}/reflection.json", document),
        texts=_texts(form, frozenset(profiles), files),
        extent=_extent(state, first),
        draws=tuple(_draw(each, state, keep) for each in calls),
        clear=state.clear,
        blend_constant=state.blend_constant,
        textures={
            name: _texture(name, image, keep)
            for name, image in zip(textures, first.textures, strict=True)
        },
        buffers={
            name: keep(f"buffer.{name}.bin", content)
            for name, content in zip(names, first.buffers, strict=False)
        },
    )


def frame_inputs(
    trial: FrameTrial, case: str, profiles: Iterable[str], files: Files
) -> FrameInputs:
    """The inputs of a frame. All its outputs share them."""
    number, output = trial.cases()[case]
    package = frame_package(trial.host(), profiles)
    path = files.keep(f"{FRAME}/package.json", to_text(package).encode())
    return FrameInputs(kind="frame", package=path, output=output, frame=number)


def _texts(
    form: Subject, profiles: frozenset[str], files: Files
) -> Mapping[str, Mapping[str, ShaderText]]:
    found: dict[str, dict[str, ShaderText]] = {}
    for file in form.files:
        profile = f"{file.target}:{file.profile}"
        if profile in profiles:
            path = files.keep(f"{SHADER}/{file_name(file.name)}", file.text.encode())
            for stage, entry in file.entry_points.items():
                found.setdefault(profile, {})[stage] = ShaderText(file=path, entry=entry)
    return found


def _is_run(reflection: Reflection) -> bool:
    """True for a kernel that writes buffers: over these, or to capture vertices."""
    return reflection.extent is not None and not has_images(reflection)


def _calls(state: SceneState) -> tuple[Draw | Dispatch, ...]:
    """The draws of a state, or the run of a kernel."""
    reflection = state.instance.reflection
    if not _is_run(reflection):
        return state.draws()
    if reflection.capture is not None:
        give_elements(state)
    return (dispatch_of(state.instance),)


def _extent(state: SceneState, call: Draw | Dispatch) -> Sides | None:
    """The elements that a kernel computes; ``None`` where something is drawn."""
    if isinstance(call, Dispatch):
        return call.extent
    return (state.width, state.height, 1) if has_images(state.instance.reflection) else None


def _buffer_names(reflection: Reflection) -> Iterator[str]:
    """The names of all storage buffers, in the order of a draw; those that are written come last,
    and a draw has none of these."""
    yield from (row.name for row in reflection.buffers if row.stages)
    yield from (row.name for row in reflection.results)


def _draw(call: Draw | Dispatch, state: SceneState, keep: Keep) -> DrawInputs:
    reflection = state.instance.reflection
    inputs = [row.name for row in reflection.vertex_inputs if row.buffer is None]
    blocks = {
        row.name: keep(f"block.{row.name}.bin", content)
        for row, content in zip(reflection.blocks, call.blocks, strict=True)
    }
    if isinstance(call, Dispatch):
        return DrawInputs(
            vertex_count=0, instance_count=1, vertices={}, indices=None, index_count=0,
            blocks=blocks,
        )  # fmt: skip
    return DrawInputs(
        vertex_count=call.vertex_count,
        instance_count=call.instance_count,
        vertices={
            name: keep(f"vertices.{name}.bin", content)
            for name, content in zip(inputs, call.vertices, strict=True)
        },
        indices=keep("indices.bin", call.indices),
        index_count=len(call.indices) // 4,
        blocks=blocks,
    )


def _texture(name: str, image: Image, keep: Keep) -> TextureInput:
    return TextureInput(
        format=image.format,
        dimension=image.dimension,
        width=image.width,
        height=image.height,
        depth=image.depth,
        levels=tuple(
            keep(f"texture.{name}.{level}.bin", texels) for level, texels in enumerate(image.levels)
        ),
    )
