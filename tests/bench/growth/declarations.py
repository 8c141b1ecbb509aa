"""Shapes of files: many declarations of one kind, and chains of what they build on."""

from __future__ import annotations

from collections.abc import Mapping

from .shape import MAIN, lines, material, shape


@shape(125, 4000)
def parameters(size: int) -> str:
    declared = lines(f"param p{i} : float in 0..1 = 0.5    /// number {i}" for i in range(size))
    return material(f"{declared}\nalpha = {' + '.join(f'p{i} * uv.x' for i in range(size))}")


@shape(125, 4000)
def parameters_that_nobody_reads(size: int) -> str:
    return material(lines(f"param p{i} : vec3 = vec3({i})" for i in range(size)))


@shape(125, 4000)
def default_chain(size: int) -> str:
    """Constants that each need the one before, as the default of a parameter."""
    constants = lines(f"c{i + 1} = c{i} * 0.5 + 1" for i in range(size))
    return f"c0 = 0.5\n{constants}\n" + material(f"param p : float = c{size}\nalpha = p")


@shape(16, 512)
def chain_of_array_counts(size: int) -> str:
    """Counts of arrays that each need the count before."""
    constants = lines(f"c{i + 1} = c{i} mod 4 + 1" for i in range(size))
    declared = lines(f"param p{i} : float[c{i}]" for i in range(size))
    return f"c0 = 1\n{constants}\n" + material(f"{declared}\nalpha = p{size - 1}[0]")


@shape(16, 512)
def groups(size: int) -> str:
    declared = lines(f"param p{i} : float per g{i}" for i in range(size))
    return material(f"{declared}\nalpha = {' + '.join(f'p{i}' for i in range(size))}")


@shape(4, 64)
def textures(size: int) -> str:
    declared = lines(f"map t{i} : texture2d" for i in range(size))
    return material(f"{declared}\nalpha = {' + '.join(f't{i}(uv).x' for i in range(size))}")


@shape(125, 2000)
def reads_of_a_texture(size: int) -> str:
    reads = " + ".join(f"t(uv * {i}.5)" for i in range(size))
    return material(f"map t : texture2d\ncolor = ({reads}).rgb")


@shape(16, 256)
def materials(size: int) -> str:
    """Materials that have nothing to do with each other; all are compiled."""
    return lines(f"material M{i} {{ color = vec3(sin(uv.x * {i}.5)) }}" for i in range(size))


@shape(16, 256)
def materials_with_the_librarys_light(size: int) -> str:
    head = "import std.terms.{lambert, phong}\n"
    body = "color = lambert(vec3({i}.5)) + phong(vec3(0.5), {i}.5)"
    return head + lines(f"material M{i} {{ {body.format(i=i)} }}" for i in range(size))


@shape(16, 512)
def abstract_materials(size: int) -> str:
    """Abstract materials, which are checked and not compiled."""
    records = lines(f"abstract material M{i} {{ color = vec3(uv, {i}) }}" for i in range(size))
    return f"{records}\n" + material("")


@shape(16, 512)
def heirs(size: int) -> str:
    """Materials that each extend the one before; the last one is compiled."""
    records = lines(
        f"abstract material M{i + 1} : M{i} {{ x{i} = uv.x * {i}.5 }}" for i in range(size)
    )
    head = f"abstract material M0 {{ }}\n{records}\n"
    return head + f"material Last : M{size} {{ alpha = x{size - 1} }}"


@shape(16, 512)
def chain_of_inherited(size: int) -> str:
    records = lines(
        f"abstract material M{i + 1} : M{i} {{ color = inherited.color * 0.5 + {i}.5 }}"
        for i in range(size)
    )
    head = f"abstract material M0 {{ color = vec3(uv, 1) }}\n{records}\n"
    return head + f"material Last : M{size} {{ }}"


@shape(16, 512)
def mixins(size: int) -> str:
    """Mixins, all of which one material includes."""
    records = lines(f"mixin X{i} {{ color = inherited.color * 0.5 + {i}.5 }}" for i in range(size))
    chain = " + ".join(f"X{i}" for i in range(size))
    return f"{records}\nmaterial Last : Surface + {chain} {{ }}"


@shape(125, 4000)
def functions_that_nobody_calls(size: int) -> str:
    functions = lines(f"fn f{i}(x: float) -> float = sin(x) * {i}.5" for i in range(size))
    return f"{functions}\n" + material("")


@shape(125, 4000)
def chain_of_functions_that_nobody_calls(size: int) -> str:
    functions = lines(f"fn f{i + 1}(x: float) -> float = f{i}(x) * {i}.5" for i in range(size))
    return f"fn f0(x: float) -> float = x\n{functions}\n" + material("")


@shape(16, 512)
def terms_that_nobody_applies(size: int) -> str:
    terms = lines(f"term t{i}(k: rgb) per light = k * light.diffuse * {i}.5" for i in range(size))
    return f"{terms}\n" + material("")


@shape(16, 512)
def terms(size: int) -> str:
    declared = lines(
        f"term t{i}(k: rgb) per light = k * light.diffuse * {i}.5" for i in range(size)
    )
    total = " + ".join(f"t{i}(vec3({i}.5))" for i in range(size))
    return f"{declared}\n" + material(f"color = {total}")


@shape(16, 256)
def overloads(size: int) -> str:
    """Functions of one name with different structures as arguments, each called once."""
    structs = lines(f"struct S{i} {{ a : float }}" for i in range(size))
    functions = lines(f"fn f(x: S{i}) -> float = x.a * {i}.5" for i in range(size))
    total = " + ".join(f"f(S{i}(uv.x))" for i in range(size))
    return f"{structs}\n{functions}\n" + material(f"alpha = {total}")


@shape(4, 64)
def lights_in_a_rig(size: int) -> str:
    entries = lines(f"l{i} : Point" for i in range(size))
    head = "import std.lights.{Point}\nimport std.terms.{lambert, phong}\n"
    body = material("color = lambert(vec3(0.5)) + phong(vec3(0.5), 40)")
    return f"{head}rig All {{\n{entries}\n}}\n{body}"


@shape(4, 64, says="B0604")
def rigs(size: int) -> str:
    """Nobody says which one is meant."""
    head = "import std.lights.{Point}\n"
    return head + lines(f"rig R{i} {{ lamp : Point }}" for i in range(size)) + "\n" + material("")


@shape(8, 256)
def spaces(size: int) -> str:
    """A point goes through as many spaces as there are."""
    declared = lines(f"space s{i}" for i in range(size + 1))
    transforms = lines(f"param t{i} : transform<s{i}, s{i + 1}>" for i in range(size))
    way = f"start : point<s0> = vec3(uv, 1)\nend = start in s{size}"
    return f"{declared}\n" + material(f"{transforms}\n{way}\ncolor = vec3(length(end - end.zxy))")


@shape(16, 512)
def members_of_a_hosts_block(size: int) -> str:
    members = lines(f"m{i} : vec4 at {16 * i}" for i in range(size))
    head = f"extern block Host at group 0, binding 3 {{\n{members}\n}}\n"
    total = " + ".join(f"m{i}" for i in range(size))
    return head + material(f"color = ({total}).rgb")


# --- files ---------------------------------------------------------------------------------------


@shape(16, 512)
def chain_of_imports(size: int) -> Mapping[str, str]:
    files = {
        f"m{i}.burnish": f"import m{i + 1}.{{f{i + 1}}}\n"
        f"fn f{i}(x: float) -> float = f{i + 1}(x) + 1.0\n"
        for i in range(size)
    }
    files[f"m{size}.burnish"] = f"fn f{size}(x: float) -> float = sin(x)\n"
    files[MAIN] = "import m0.{f0}\n" + material("alpha = f0(uv.x)")
    return files


@shape(16, 512)
def imports_beside_each_other(size: int) -> Mapping[str, str]:
    files = {f"m{i}.burnish": f"fn f{i}(x: float) -> float = x * {i}.5\n" for i in range(size)}
    imports = lines(f"import m{i}" for i in range(size))
    total = " + ".join(f"f{i}(uv.x)" for i in range(size))
    files[MAIN] = f"{imports}\n" + material(f"alpha = {total}")
    return files


@shape(500, 16_000)
def large_import_of_which_little_is_used(size: int) -> Mapping[str, str]:
    functions = lines(f"fn f{i}(x: float) -> float = x * {i}.5" for i in range(size))
    return {"large.burnish": functions, MAIN: "import large\n" + material("alpha = f0(uv.x)")}
