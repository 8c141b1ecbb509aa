"""Shapes of text: comments, blanks, names and literals."""

from __future__ import annotations

from .shape import lines, material, shape

MEGABYTE = 1 << 20


@shape(MEGABYTE // 8, 8 * MEGABYTE)
def one_long_comment(size: int) -> str:
    return f"/* {'x ' * (size // 2)} */\n" + material("")


@shape(MEGABYTE // 8, 8 * MEGABYTE)
def one_long_doc_comment(size: int) -> str:
    return f"/// {'x ' * (size // 2)}\n" + material("")


@shape(1000, 64_000)
def lines_of_comments(size: int) -> str:
    return lines(f"// remark number {i}" for i in range(size)) + "\n" + material("")


@shape(1000, 64_000)
def lines_of_doc_comments(size: int) -> str:
    return lines(f"/// remark number {i}" for i in range(size)) + "\n" + material("")


@shape(500, 16_000)
def documented_equations(size: int) -> str:
    steps = lines(f"/// Step {i}\nx{i + 1} = x{i} + 1.5   // remark" for i in range(size))
    return material(f"x0 = sin(uv.x)\n{steps}\nalpha = x{size}")


@shape(MEGABYTE // 8, 8 * MEGABYTE)
def blanks(size: int) -> str:
    return material(" " * size)


@shape(MEGABYTE // 8, 8 * MEGABYTE)
def empty_lines(size: int) -> str:
    return material("\n" * size)


@shape(1000, 64_000)
def long_name(size: int) -> str:
    name = "n" * size
    return material(f"{name} = sin(uv.x)\nalpha = {name} * {name}")


@shape(500, 4000)
def digits(size: int) -> str:
    return material(f"alpha = 0.{'123456789' * (size // 9)}")


@shape(25, 200)
def brackets(size: int) -> str:
    return material(f"alpha = {'(' * size}uv.x{')' * size}")


@shape(25, 200)
def array_brackets(size: int) -> str:
    depth = size // 2
    return material(f"alpha = {'[' * depth}uv.x{']' * depth}{'[0]' * depth}")
