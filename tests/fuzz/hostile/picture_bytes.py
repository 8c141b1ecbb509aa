"""Mutates the bytes of pictures, in each format that is read.

Whatever is in such a file, reading it ends with a texture or with one of the errors in ``TOLD``,
whose text is a sentence.
"""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from random import Random

import numpy as np
from PIL import Image

from burnish.compiler.budget import BudgetError
from burnish.targets.runner.textures.high_range import FORMATS as OF_FLOATS
from burnish.targets.runner.textures.high_range import encoded_floats
from burnish.targets.runner.textures.kinds import PictureError
from burnish.targets.runner.textures.texture import Texture

TOLD = (PictureError, BudgetError)
"""The errors that reading a picture may raise."""

_WRITTEN: Mapping[str, tuple[str, str, dict[str, object]]] = {
    "rgba.png": ("PNG", "RGBA", {}),
    "palette.png": ("PNG", "P", {"transparency": 3}),
    "deep.png": ("PNG", "I;16", {}),
    "moving.png": ("PNG", "RGB", {"save_all": True}),
    "a.jpg": ("JPEG", "RGB", {"comment": b"abc"}),
    "progressive.jpg": ("JPEG", "CMYK", {"progressive": True}),
    "a.webp": ("WEBP", "RGB", {}),
    "moving.webp": ("WEBP", "RGBA", {"lossless": True, "save_all": True}),
    "a.gif": ("GIF", "P", {"comment": b"abc"}),
    "moving.gif": ("GIF", "RGB", {"save_all": True}),
    "a.bmp": ("BMP", "RGB", {}),
    "a.tga": ("TGA", "RGBA", {"compression": "tga_rle"}),
    "a.tiff": ("TIFF", "RGB", {}),
    "lzw.tiff": ("TIFF", "RGB", {"compression": "tiff_lzw"}),
    "deflate.tiff": ("TIFF", "F", {"compression": "tiff_deflate"}),
    "jpeg.tiff": ("TIFF", "L", {"compression": "jpeg"}),
}
"""Pillow's format, the mode, and how it is saved, by the name of a file."""
_PROFILE = b"""IESNA:LM-63-2002
[LUMINAIRE] a lamp
TILT=INCLUDE
1 2
0 90
1.0 0.9
1 1000 2.0 3 2 1 2 0.1 0.2 0 0.9 1.0 50
0 45 90 0 90
100 50.5 0 1e2 100 0
"""
_WORDS = (b"\0\0", b"\xff\xff", b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\0\0\x01\0", b"\x80")


def seeds() -> dict[str, bytes]:
    """Small good pictures, by names with their endings."""
    chance = np.random.default_rng(3)
    noise = Image.fromarray(chance.integers(0, 256, (9, 7, 4)).astype(np.uint8))
    found = {}
    for name, (form, mode, how) in _WRITTEN.items():
        picture = noise.convert("RGB").convert("L" if mode == "I;16" else mode)
        if mode == "RGBA":
            picture = noise
        elif mode == "I;16":
            picture = Image.fromarray(np.asarray(picture).astype(np.uint16) * 257)
        turned = picture.transpose(Image.Transpose.ROTATE_180)
        more = {"append_images": [turned]} if "save_all" in how else {}
        stream = BytesIO()
        picture.save(stream, form, **how, **more)
        found[name] = stream.getvalue()
    numbers = chance.random((9, 7, 4))
    for ending, form_of_floats in OF_FLOATS.items():
        name = f"a{ending}"
        found[name] = encoded_floats(numbers, 3, Path(name), form_of_floats)
    found["a.ies"] = _PROFILE
    return found


def mutated(seed: bytes, chance: Random) -> bytes:
    """A file with a few changes, more often of the header than of what follows."""
    found = bytearray(seed)
    for _ in range(chance.choice((1, 1, 2, 4, 8))):
        at = chance.randrange(min(len(found), chance.choice((40, 200, 10**6))) or 1)
        match chance.randrange(5):
            case 0 | 1:
                found[at : at + 1] = bytes((chance.randrange(256),))
            case 2:
                word = chance.choice(_WORDS)
                found[at : at + len(word)] = word
            case 3:
                end = min(at + chance.choice((1, 4, 30)), len(found))
                found[at:end] = found[at:end] * chance.choice((0, 2, 20))
            case _:
                del found[len(found) - chance.randint(0, 20) :]
    return bytes(found)


def read(content: bytes, path: Path) -> str | None:
    """Write a file and read it: what is told of it, or ``None`` for a texture."""
    path.write_bytes(content)
    try:
        Texture.load(path)
    except TOLD as error:
        return str(error)
    return None
