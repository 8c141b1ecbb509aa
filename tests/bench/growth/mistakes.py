"""Shapes of wrong programs: what is said of each mistake must not depend on how many there are."""

from __future__ import annotations

from .shape import lines, material, shape


@shape(125, 4000, says="B0201")
def unknown_names(size: int) -> str:
    return material(lines(f"x{i} = unknown_{i} * 2" for i in range(size)))


@shape(125, 4000, says="B0201")
def misspelt_names(size: int) -> str:
    right = lines(f"value_{i} = uv.x * {i}.5" for i in range(size))
    return material(f"{right}\n" + lines(f"x{i} = valeu_{i} * 2" for i in range(size)))


@shape(125, 4000, says="B0201")
def unknown_functions(size: int) -> str:
    return material(lines(f"x{i} = unknown_{i}(2)" for i in range(size)))


@shape(125, 4000, says="B0301")
def wrong_types(size: int) -> str:
    return material(lines(f"x{i} : vec3 = vec2({i}, 1)" for i in range(size)))


@shape(125, 4000, says="B0305")
def wrong_operands(size: int) -> str:
    return material(lines(f"x{i} = vec3(1) + vec2({i}, 1)" for i in range(size)))


@shape(125, 4000, says="B0202")
def duplicate_names(size: int) -> str:
    return material(lines(f"x = {i}" for i in range(size)))


@shape(125, 4000, says="B0203")
def circle_of_equations(size: int) -> str:
    steps = lines(f"x{i} = x{(i + 1) % size} + 1.5" for i in range(size))
    return material(f"{steps}\nalpha = x0")


@shape(125, 4000, says="B0204")
def circle_of_functions(size: int) -> str:
    functions = lines(
        f"fn f{i}(x: float) -> float = f{(i + 1) % size}(x) + 1.5" for i in range(size)
    )
    return f"{functions}\n" + material("alpha = f0(uv.x)")


@shape(125, 4000, says="B0101")
def broken_members(size: int) -> str:
    return material(lines(f"x{i} = = {i}" for i in range(size)))


@shape(125, 4000, says="B0108")
def broken_declarations(size: int) -> str:
    return lines(f"fn f{i}(x: float -> float = x" for i in range(size))


@shape(500, 16_000, says="B0101")
def garbage(size: int) -> str:
    return "+ ) } ] ( " * size


@shape(1000, 16_000, says="B0111")
def open_braces(size: int) -> str:
    return "material M { " * size


@shape(125, 4000, says="B0101")
def words_of_other_languages(size: int) -> str:
    return lines(f"float f{i}(float x) {{ return x * {i}.0; }}" for i in range(size))


@shape(125, 4000, says="B0006")
def missing_imports(size: int) -> str:
    return lines(f"import missing{i}" for i in range(size)) + "\n" + material("")
