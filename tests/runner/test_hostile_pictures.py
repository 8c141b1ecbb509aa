"""Pictures that are broken, absurd or hostile: each is refused by one clear sentence, before it
takes much memory or time."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from random import Random

import numpy as np
import pytest
from PIL import Image

from burnish import PictureError, Texture
from burnish.compiler.budget import BudgetError, raised

from ..fuzz.hostile.picture_bytes import mutated, read, seeds
from ..suite.memory import measured

POSTSCRIPT = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 100 100\nshowpage\n"
FORMATS = "PNG, JPEG, WEBP, GIF, BMP, TGA or TIFF"

LOADING = """\
from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.textures.kinds import PictureError
from burnish.targets.runner.textures.texture import Texture
path, sample, memory = sys.argv[1:]
try:
    with raised({"memory": int(memory)}):
        print(Texture.load(path, sample=sample).width)
except (BudgetError, PictureError) as error:
    print(error)
"""


def saved(name: str, form: str, mode: str, side: int, folder: Path) -> Path:
    """A picture of one colour, which takes few bytes."""
    path = folder / name
    Image.new(mode, (side, side)).save(path, form)
    return path


def chunk(kind: bytes, data: bytes = b"") -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


HEADER = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 4, 4, 8, 6, 0, 0, 0))
TEXELS, END = chunk(b"IDAT", zlib.compress(bytes(4 * 17))), chunk(b"IEND")


def jpeg() -> bytes:
    stream = BytesIO()
    Image.new("RGB", (4, 4)).save(stream, "JPEG")
    return stream.getvalue()


def strips(count: int) -> bytes:
    """A TIFF file which says that it consists of so many strips."""
    rows = [
        (256, 4, 1, 8192), (257, 4, 1, 4096), (258, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, 1),
        (273, 4, count, 126), (277, 3, 1, 1), (278, 4, 1, 1), (279, 4, 1, 4),
    ]  # fmt: skip
    entries = b"".join(struct.pack("<HHII", *row) for row in rows)
    head = b"II*\0" + struct.pack("<IH", 8, len(rows))
    return head + entries + bytes(8) + bytes(4 * count)


@pytest.mark.parametrize("name", ["eps.png", "eps.eps", "-eps.png"])
def test_programs_are_never_run_for_a_picture(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Pillow would take PostScript for a picture whatever the file's name is, and run a program."""
    from PIL import EpsImagePlugin

    def never(*_: object) -> None:
        raise AssertionError("PostScript was taken for a picture")

    monkeypatch.setattr(EpsImagePlugin, "Ghostscript", never)
    monkeypatch.setattr(EpsImagePlugin.EpsImageFile, "_open", never)
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(POSTSCRIPT)
    with pytest.raises(PictureError) as caught:
        Texture.load(name)
    assert str(caught.value) == f"{name} is not a picture of a known format: {FORMATS}"


@pytest.mark.parametrize("form", ["PPM", "PCX", "ICO", "ICNS", "SGI", "DDS", "JPEG2000", "PDF"])
def test_other_formats_are_not_read(form: str, tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    Image.new("RGBA" if form == "ICNS" else "RGB", (64, 64)).save(path, form)
    with pytest.raises(PictureError, match=f"is not a picture of a known format: {FORMATS}$"):
        Texture.load(path)


BOMBS: dict[str, Callable[[], bytes]] = {
    "chunks": lambda: HEADER + chunk(b"abCd") * 10**6 + TEXELS + END,
    "chunks behind": lambda: HEADER + TEXELS + chunk(b"abCd") * 10**6 + END,
    "empty texels": lambda: HEADER + chunk(b"IDAT") * 10**6 + TEXELS + END,
    "texts": lambda: HEADER + chunk(b"tEXt", b"a\0b") * 10**6 + TEXELS + END,
    "profile": lambda: HEADER + chunk(b"iCCP", b"a\0\0" + bytes(8 * 2**20)) + TEXELS + END,
    "segments": lambda: jpeg()[:2] + b"\xff\xe2\0\x02" * 10**6 + jpeg()[2:],
    "filling": lambda: jpeg()[:2] + b"\xff" * 10**7 + jpeg()[2:],
    "strips": lambda: strips(4 * 10**6),
    "comment": lambda: (
        b"GIF89a" + struct.pack("<2H3B", 4, 4, 0, 0, 0) + b"!\xfe"
        + (b"\xff" + b"a" * 255) * 10**5 + b"\0,"
        + struct.pack("<4HB", 0, 0, 4, 4, 0) + b"\x02\x02\x4c\x01\0;"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BOMBS)
def test_more_metadata_than_any_picture_has(name: str, tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(BOMBS[name]())
    said, peak = measured(LOADING, str(path), "float", "1000000000")
    assert said == f"{path} is damaged: it has more metadata than any picture"
    assert peak < 300 * 10**6


def test_more_parts_than_any_picture_has(tmp_path: Path) -> None:
    path = tmp_path / "a.tiff"
    path.write_bytes(strips(100_000))
    with pytest.raises(PictureError, match=r"is damaged: it consists of 100,000 parts$"):
        Texture.load(path)


def scans(count: int, *, side: int = 4) -> bytes:
    """A progressive JPEG picture whose last scan comes so many times more. Each takes 4 ms where a
    side has 2000 texels."""
    stream = BytesIO()
    Image.new("L", (side, side), 128).save(stream, "JPEG", progressive=True)
    whole, end = stream.getvalue()[:-2], stream.getvalue()[-2:]
    return whole + whole[whole.rindex(b"\xff\xda") :] * count + end


def test_more_scans_than_any_picture_has(tmp_path: Path) -> None:
    path = tmp_path / "a.jpg"
    path.write_bytes(scans(40))
    assert Texture.load(path).width == 4
    path.write_bytes(scans(3000))
    with pytest.raises(PictureError, match=r"is damaged: it has 3,\d+ scans$"):
        Texture.load(path)


def tile(side: int) -> bytes:
    """A TIFF picture of 16 x 16 grey texels in one deflated tile, which is far larger."""
    texels = zlib.compressobj()
    rows = b"".join(texels.compress(bytes(side)) for _ in range(side)) + texels.flush()
    tags = [
        (256, 16), (257, 16), (258, 8), (259, 8), (262, 1), (277, 1), (322, side), (323, side),
        (324, 8), (325, len(rows)),
    ]  # fmt: skip
    entries = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags)
    head = b"II*\0" + struct.pack("<I", 8 + len(rows))
    return head + rows + struct.pack("<H", len(tags)) + entries + bytes(4)


def test_tiles_are_counted_and_not_the_picture_alone(tmp_path: Path) -> None:
    path = tmp_path / "a.tiff"
    path.write_bytes(tile(256))
    assert Texture.load(path).width == 16
    path.write_bytes(tile(16_384))
    said, peak = measured(LOADING, str(path), "float", "1000000000")
    assert said == (
        "the texture takes 4.29 GB, and the limit is 1 GB: `--budget memory=4295M` raises it"
    )
    assert peak < 100 * 10**6


def test_tiles_of_floats_are_counted(tmp_path: Path) -> None:
    import OpenImageIO

    path = tmp_path / "a.exr"
    spec = OpenImageIO.ImageSpec(16, 16, 4, "float")
    spec.tile_width = spec.tile_height = 2048
    sink = OpenImageIO.ImageOutput.create("openexr")
    assert sink is not None
    assert sink.open(str(path), spec)
    assert sink.write_image(np.zeros((16, 16, 4), np.float32))
    assert sink.close()
    assert path.stat().st_size < 2000
    with raised({"memory": 50 * 10**6}), pytest.raises(BudgetError, match="the texture takes 101"):
        Texture.load(path)


def test_profiles_and_comments_of_usual_size(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    noise = np.random.default_rng(1).bytes(900_000)
    Image.new("RGB", (4, 4)).save(path, icc_profile=noise)
    assert Texture.load(path).width == 4


def test_pixels_are_counted_before_they_are_decoded(tmp_path: Path) -> None:
    path = saved("a.png", "PNG", "RGB", 8192, tmp_path)
    said, peak = measured(LOADING, str(path), "float", "1000000000")
    assert said == (
        f"{path} has 67,108,864 pixels, and the limit is 33,554,432 pixels: "
        "`--budget pixels=68M` raises it"
    )
    assert peak < 100 * 10**6


KINDS = {
    "rgb.png": ("PNG", "RGB", "float"), "rgba.png": ("PNG", "RGBA", "float"),
    "palette.png": ("PNG", "P", "float"), "deep.png": ("PNG", "I;16", "float"),
    "cmyk.jpg": ("JPEG", "CMYK", "float"), "rgb.webp": ("WEBP", "RGB", "float"),
    "floats.tiff": ("TIFF", "F", "float"), "depths.tiff": ("TIFF", "F", "depth"),
    "numbers.png": ("PNG", "RGBA", "uint"), "numbers.tiff": ("TIFF", "I", "int"),
}  # fmt: skip


@pytest.mark.parametrize("name", KINDS)
def test_what_a_picture_takes_is_no_more_than_is_counted(name: str, tmp_path: Path) -> None:
    """With a limit that is just enough for what is counted, it is read within the limit."""
    form, mode, sample = KINDS[name]
    path = saved(name, form, mode, 2048, tmp_path)
    said, _ = measured(LOADING, str(path), sample, "1000000")
    most = int(said.rpartition("memory=")[2].partition("M")[0]) * 10**6
    said, peak = measured(LOADING, str(path), sample, str(most))
    assert said == "2048"
    at_rest = 40 * 10**6
    assert peak < most + at_rest


def test_layers_are_counted_together(tmp_path: Path) -> None:
    path = saved("a.png", "PNG", "RGB", 1024, tmp_path)
    with raised({"memory": 60 * 10**6}):
        assert Texture.load([path] * 2, dimension="2d_array").depth == 2
        with pytest.raises(BudgetError, match=r"^the texture takes .*the limit is 60 MB"):
            Texture.load([path] * 8, dimension="2d_array")


def test_damage_is_not_logged(tmp_path: Path) -> None:
    """Pillow's log records would be printed, as no other handler takes them."""
    path = tmp_path / "a.tiff"
    path.write_bytes(strips(4).replace(struct.pack("<HHII", 277, 3, 1, 1),
                                       struct.pack("<HHII", 277, 3, 1, 9)))  # fmt: skip
    code = """\
from burnish.targets.runner.textures.kinds import PictureError
from burnish.targets.runner.textures.texture import Texture
sys.stderr = sys.stdout
try:
    Texture.load(sys.argv[1])
except PictureError as error:
    print(error)
"""
    said, _ = measured(code, str(path))
    assert said == f"{path} is not a picture of a known format: {FORMATS}"


@pytest.mark.parametrize("name", seeds())
@pytest.mark.filterwarnings("error")
def test_whatever_is_in_a_file_it_is_read_or_refused(name: str, tmp_path: Path) -> None:
    """``make fuzz`` tries other files, for as long as one likes."""
    good = seeds()[name]
    assert read(good, tmp_path / name) is None
    refusals = 0
    for seed in range(150):
        said = read(mutated(good, Random(seed)), tmp_path / name)
        if said is not None:
            assert "\n" not in said
            assert len(said) < 1000
            refusals += 1
    assert refusals > 20
