"""Parameters by their owner: ``Clay.base`` of a frame's materials, and on a command line."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

import burnish
from burnish.commands.group import burnish as command
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.instances.values import ParameterError

MATERIALS = """
import std.lights.{Spot}
rig Night { torch : Spot }
material Clay { param base : rgb = #a64  param gloss : float = 0.5  color = base * gloss }
material Slate { param base : rgb = #456  param gloss : rgb = #fff  color = base * gloss }
"""
FRAME = "frame Pair { models scene  drawn = Forward(scene)  output picture = drawn.color }"


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> FrameHost:
    path = tmp_path_factory.mktemp("frame") / "m.burnish"
    path.write_text(MATERIALS + FRAME, encoding="utf-8")
    (frame,) = burnish.compile(path, "glsl", keep_graphs=True).frames
    return FrameHost(frame, in_a_row(["Clay", "Slate"], {}, "sphere"), (8, 8))


def _bases(host: FrameHost) -> dict[str, object]:
    return {owner: values.get("base") for owner, (values,) in host.owners.items()}


def test_a_parameter_of_one_material(shared: FrameHost) -> None:
    shared.set("base", (0, 0, 1))
    shared.set("Clay.base", (1, 0, 0))
    assert _bases(shared) == {"Clay": (1, 0, 0), "Slate": (0, 0, 1)}
    shared.set_text("Slate.gloss", "#000")
    shared.set_text("Clay.gloss", "0.25")


@pytest.mark.parametrize(
    "name, message",
    [
        (
            "gloss",
            "`gloss` is float in Clay and rgb in Slate: say whose is meant, as in `Clay.gloss`",
        ),
        ("Mud.base", "there is no material `Mud` here: `base` belongs to Clay, Slate"),
        ("Slat.base", "there is no material `Slat` here: did you mean `Slate`?"),
        ("Clay.bsae", "`Clay` has no parameter `bsae`: did you mean `base`?"),
        ("torch.position", "there is no parameter `torch.position`: did you mean `torch.place`?"),
    ],
)
def test_names_that_mean_nothing(shared: FrameHost, name: str, message: str) -> None:
    before = _bases(shared)
    with pytest.raises(ParameterError) as caught:
        shared.set_text(name, "1")
    assert str(caught.value) == message
    assert _bases(shared) == before


@pytest.mark.parametrize(
    "given, message",
    [
        (("base=#f00", "base=#0f0"), "'base' is set twice, to #f00 and to #0f0"),
        (("gloss=1",), "`gloss` is float in Clay and rgb in Slate"),
        (("Mud.base=#f00",), "there is no material `Mud` here"),
    ],
)
def test_a_command_line_that_is_refused(
    given: tuple[str, ...], message: str, tmp_path: Path
) -> None:
    """Materials of a file are single frames, which are set together."""
    file, picture = tmp_path / "m.burnish", tmp_path / "m.png"
    file.write_text(MATERIALS, encoding="utf-8")
    options = [option for text in given for option in ("--set", text)]
    line = ["render", str(file), "-o", str(picture), "--on", "reference", "--size", "4x4", *options]
    said = CliRunner().invoke(command, line)
    assert said.exit_code
    assert message in " ".join(said.output.split())
    assert not picture.exists()
