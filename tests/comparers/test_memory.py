"""Pictures in memory: Python takes them from arrays of all kinds, and TypeScript from canvases."""

from __future__ import annotations

import ctypes
from array import array
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.targets.conformance.comparers.burnish_judge import (
    Bounds,
    Encoding,
    JudgeError,
    Outlier,
    Picture,
    judge,
)

from ..suite.processes import run
from .folders import Array, npy
from .kit import compiled

pytestmark = pytest.mark.xdist_group("comparers")  # One process compiles the programs.

HEIGHT, WIDTH = 2, 3
LEVELS = 0.25 + np.arange(HEIGHT * WIDTH).reshape(HEIGHT, WIDTH, 1) / 8
"""Values that all types of floats have exactly."""

EXACT = Bounds(WIDTH, HEIGHT, 1, [*LEVELS.flat], [*LEVELS.flat], bytes(HEIGHT * WIDTH))
CODES = (np.round(LEVELS * 255)).astype("u1")

DATA: dict[str, Any] = {
    **{type_: LEVELS.astype(type_) for type_ in ("<f2", ">f2", "<f4", ">f4", "<f8", ">f8")},
    "bytes": CODES.tobytes(),
    "bytearray": bytearray(CODES.tobytes()),
    "two bytes": np.round(LEVELS * 65535).astype("<u2"),
    "two bytes, big-endian": np.round(LEVELS * 65535).astype(">u2"),
    "memoryview": LEVELS.data,
    "array": array("f", LEVELS.flat),
    "ctypes": (ctypes.c_float * (HEIGHT * WIDTH))(*LEVELS.flat),
    "columns first": np.asfortranarray(LEVELS),
    "every other one": np.repeat(LEVELS, 2, axis=1)[:, ::2],
}


@pytest.mark.parametrize("name", DATA)
def test_arrays(name: str) -> None:
    verdict = judge(EXACT, Picture(WIDTH, HEIGHT, 1, DATA[name]))
    assert verdict.is_good, verdict.message


@pytest.mark.parametrize("name", DATA)
def test_order(name: str) -> None:
    """The next pixel has other values: a picture that is off by one is outside everywhere."""
    levels = [*np.roll(LEVELS, 1).flat]
    bounds = Bounds(WIDTH, HEIGHT, 1, levels, levels, bytes(HEIGHT * WIDTH))
    assert judge(bounds, Picture(WIDTH, HEIGHT, 1, DATA[name])).outside == HEIGHT * WIDTH


@pytest.mark.parametrize("data", [LEVELS.astype("i4"), LEVELS.astype(bool), LEVELS.astype("c8")])
def test_other_types_are_refused(data: Array) -> None:
    with pytest.raises(JudgeError, match="has numbers of type"):
        judge(EXACT, Picture(WIDTH, HEIGHT, 1, data))


def test_the_worst_one() -> None:
    """Its numbers are codes for integers, and its distance is one of values."""
    codes = CODES.copy()
    codes[1, 2, 0] -= 51
    verdict = judge(EXACT, Picture(WIDTH, HEIGHT, 1, codes))
    assert verdict.worst == Outlier(x=2, y=1, lane=0, value=172, lower=223, upper=224, distance=0.2)


def test_the_encoding_makes_a_difference() -> None:
    picture = Picture(WIDTH, HEIGHT, 1, CODES)
    assert judge(EXACT, picture, Encoding.LINEAR).outside == 0
    assert judge(EXACT, picture, Encoding.SRGB).outside == HEIGHT * WIDTH


CANVAS = """
import { argv } from "node:process";
import { runInNewContext } from "node:vm";

import { Bounds, judge, JudgeError, Picture, type Samples } from "./burnish_judge.js";

const files = argv.slice(2).map((text) => Uint8Array.from(text.split(","), Number).buffer);
const [lower, upper, undecided] = files as [ArrayBuffer, ArrayBuffer, ArrayBuffer];
const bounds = Bounds.parse(lower, upper, undecided);
const said = (data: Samples): string => {
  try {
    return judge(bounds, new Picture(2, 1, 1, data)).message.split(" ")[0]!;
  } catch (error) {
    return error instanceof JudgeError ? error.message : String(error);
  }
};
const fromElsewhere = (text: string): Samples => runInNewContext(text) as Samples;
console.log(said(new Uint8ClampedArray([127, 128])));
console.log(said(new Uint8ClampedArray([127, 129])));
console.log(said(fromElsewhere("new Float32Array([0.5, 0.5])")));
console.log(said(fromElsewhere("new Float32Array([0.5, 0.6])")));
console.log(said(fromElsewhere("new Uint16Array([32767, 32768])")));
console.log(said(fromElsewhere("new Int8Array([127, 127])")));
"""
"""Judges what a canvas gives, and arrays of another global object: test frameworks have several."""


def test_arrays_of_typescript(tmp_path: Path) -> None:
    half = npy(np.full((1, 2, 1), 0.5))
    files = (half, half, npy(np.zeros((1, 2), "u1")))
    command = compiled("typescript", CANVAS, tmp_path)
    done = run([*command, *(",".join(map(str, content)) for content in files)], check=True)
    refused = "the picture has numbers of type Int8Array"
    assert done.stdout.splitlines() == ["good:", "bad:", "good:", "bad:", "good:", refused]
