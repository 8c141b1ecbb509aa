"""Golden folders with mistakes, and damaged pictures that are judged by them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
from PIL import Image

from burnish.targets.conformance.golden.pictures import read_picture
from burnish.targets.conformance.golden.within import GoldenError, judged, outputs_of

from ...judging.kit import CASE, flat, small_golden
from .documents import mutated
from .picture_bytes import mutated as damaged

PICTURES = ("p.npy", "p.png", "p.exr")


def trial() -> Callable[[Random, Path], None]:
    """The trial that judges a picture, where something is damaged."""

    def judge(random: Random, folder: Path) -> None:
        golden = small_golden(folder / "g")
        _write_pictures(folder)
        files = sorted((golden / CASE).glob("*.npy"))
        wrong = random.choice([golden / "golden.json", *files, folder / random.choice(PICTURES)])
        if wrong.suffix == ".json":
            document = mutated(json.loads(wrong.read_text("utf-8")), random)
            wrong.write_text(json.dumps(document), "utf-8")
        else:
            wrong.write_bytes(damaged(wrong.read_bytes(), random))
        for name in PICTURES:
            try:
                for output in outputs_of(golden):
                    assert str(output.root / output.folder).startswith(str(golden))
                    judged(read_picture(folder / name, output), output)
            except GoldenError:
                continue

    return judge


def _write_pictures(folder: Path) -> None:
    from burnish.targets.runner.pictures import encoded_numbers

    np.save(folder / "p.npy", flat(0.3).astype("<f4"))
    Image.new("RGBA", (3, 2), (80, 80, 80, 80)).save(folder / "p.png")
    exr = folder / "p.exr"
    exr.write_bytes(encoded_numbers(flat(0.3), exr))
