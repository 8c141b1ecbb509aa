"""Shapes of values: chains, sums, choices, calls and loops."""

from __future__ import annotations

from .shape import lines, material, shape

PARAMETERS = "param a : float\nparam b : float"


def _chain(start: str, length: int) -> str:
    """A material of equations, each of which needs the one before."""
    steps = lines(f"x{i + 1} = x{i} * a + b" for i in range(length))
    return material(f"{PARAMETERS}\nx0 = {start}\n{steps}\ncolor = vec3(x{length})")


@shape(500, 32_000)
def chain_of_equations(size: int) -> str:
    return _chain("fract(uv.x)", size)


@shape(500, 16_000)
def chain_of_affine_equations(size: int) -> str:
    """All of it can be computed at the vertices."""
    return _chain("uv.x", size)


@shape(500, 16_000)
def chain_of_parameters(size: int) -> str:
    """All of it can be left to the host."""
    return _chain("a", size)


@shape(500, 8000)
def chain_of_typed_vectors(size: int) -> str:
    steps = lines(f"x{i + 1} : vec3 = normalize(x{i} + b) * a" for i in range(size))
    return material(f"{PARAMETERS}\nx0 = vec3(uv, 1)\n{steps}\ncolor = x{size}")


@shape(500, 8000)
def chain_of_points(size: int) -> str:
    """Values whose meaning is checked at each step."""
    steps = lines(
        f"x{i + 1} : point<world> = x{i} + ({i + 1}.5 * to_eye as vector<world>)"
        for i in range(size)
    )
    return material(f"x0 = position\n{steps}\ncolor = vec3(length(x{size} - eye))")


@shape(500, 8000)
def squares(size: int) -> str:
    """Each value is used twice by the next."""
    steps = lines(f"x{i + 1} = fract(x{i} * x{i} + {i}.5)" for i in range(size))
    return material(f"x0 = uv.x\n{steps}\ncolor = vec3(x{size})")


@shape(500, 16_000)
def equations_that_nobody_reads(size: int) -> str:
    steps = lines(f"x{i} = sin(uv.x * {i}.5)" for i in range(size))
    return material(f"{steps}\ncolor = vec3(uv, 0)")


@shape(500, 16_000)
def chain_that_nobody_reads(size: int) -> str:
    steps = lines(f"x{i + 1} = x{i} * 1.5 + 0.5" for i in range(size))
    return material(f"x0 = uv.x\n{steps}\ncolor = vec3(uv, 0)")


@shape(500, 16_000)
def wide_sum(size: int) -> str:
    return material(f"alpha = {' + '.join(f'sin(uv.x * {i + 1}.5)' for i in range(size))}")


@shape(500, 16_000)
def wide_sum_of_equations(size: int) -> str:
    steps = lines(f"x{i} = sin(uv.x * {i + 1}.5)" for i in range(size))
    return material(f"{steps}\nalpha = {' + '.join(f'x{i}' for i in range(size))}")


@shape(500, 16_000)
def sum_of_constants(size: int) -> str:
    return material(f"alpha = uv.x * ({' + '.join(f'{i}.5' for i in range(size))})")


@shape(500, 16_000)
def wide_conjunction(size: int) -> str:
    tests = " and ".join(f"uv.x < {i + 1}.5" for i in range(size))
    return material(f"alpha = if {tests} then 1.0 else 0.0")


@shape(500, 8000)
def signs(size: int) -> str:
    return material(f"alpha = {'-' * size}uv.x")


@shape(500, 8000)
def negations(size: int) -> str:
    return material(f"alpha = if {'not ' * size}(uv.x < 0.5) then 1.0 else 0.0")


@shape(500, 8000)
def swizzles(size: int) -> str:
    return material(f"color = position{'.zxy' * size}")


@shape(125, 4000)
def constant_divisors(size: int) -> str:
    """Constants of which each is divided by; none of them may be zero."""
    return f"c0 = 2.0\n{lines(f'c{i + 1} = 2.0 / c{i}' for i in range(size))}\n" + material(
        f"alpha = c{size}"
    )


@shape(125, 4000)
def values_at_the_vertices(size: int) -> str:
    equations = lines(f"a{i + 1} = @vertex (a{i} * 2)" for i in range(size))
    return material(f"a0 = uv.x\n{equations}\nalpha = a{size}")


@shape(125, 8000)
def signs_of_a_value(size: int) -> str:
    return material(f"alpha = {'-' * size}uv.x")


@shape(125, 4000)
def choices_in_a_row(size: int) -> str:
    """``if … else if …``, as deep as it is long."""
    tests = "".join(f"if uv.x < {i + 1}.5 then sin(uv.y * {i}.5)\nelse " for i in range(size))
    return material(f"alpha = {tests}0.5")


@shape(125, 4000)
def nested_choices(size: int) -> str:
    """Each choice decides whether the one before it is needed."""
    steps = lines(
        f"x{i + 1} = if uv.x < {i + 1}.5 then sin(x{i} * {i}.5) else uv.y" for i in range(size)
    )
    return material(f"x0 = uv.x\n{steps}\nalpha = x{size}")


@shape(125, 4000)
def choices_of_both_sides(size: int) -> str:
    """Each choice needs the one before it on both sides."""
    steps = lines(
        f"x{i + 1} = if uv.x < {i + 1}.5 then sin(x{i}) else cos(x{i} + uv.y)" for i in range(size)
    )
    return material(f"x0 = uv.x\n{steps}\nalpha = x{size}")


@shape(125, 4000)
def choices_beside_each_other(size: int) -> str:
    steps = lines(
        f"x{i} = if uv.x < {i + 1}.5 then sin(exp(uv.y * {i}.5)) else cos(uv.y)"
        for i in range(size)
    )
    return material(f"{steps}\nalpha = {' + '.join(f'x{i}' for i in range(size))}")


@shape(125, 4000)
def choices_of_constants(size: int) -> str:
    steps = lines(f"x{i + 1} = if {i} mod 2 == 0 then x{i} + 1.5 else x{i}" for i in range(size))
    return material(f"x0 = uv.x\n{steps}\nalpha = x{size}")


# --- calls ---------------------------------------------------------------------------------------


def _calls(head: str, size: int, body: str) -> str:
    functions = lines(f"fn f{i + 1}{head} = {body.format(f=f'f{i}', i=i + 1)}" for i in range(size))
    return f"fn f0{head} = sin(x)\n{functions}\n" + material(f"alpha = f{size}(uv.x)")


@shape(8, 512)
def call_dag(size: int) -> str:
    """Functions that each call the one before twice."""
    return _calls("(x: float) -> float", size, "{f}(x * {i}.5) + {f}(x)")


@shape(8, 512)
def call_dag_without_result_types(size: int) -> str:
    return _calls("(x: float)", size, "{f}(x * {i}.5) + {f}(x)")


@shape(8, 512)
def generic_call_dag(size: int) -> str:
    return _calls("<T: floats>(x: T) -> T", size, "{f}(x * {i}.5) + {f}(x)")


@shape(8, 512)
def polynomial_call_dag(size: int) -> str:
    return _calls("(x: float) -> float", size, "{f}(x) * {f}(x + 1.0)")


@shape(8, 512)
def call_dag_of_constants(size: int) -> str:
    """The argument is known while compiling."""
    text = _calls("(x: float) -> float", size, "fract({f}(x * {i}.5) + {f}(x))")
    return text.replace("(uv.x)", "(0.25)")


@shape(8, 512)
def call_dag_of_terms(size: int) -> str:
    head = "import std.terms.{lambert}\nterm t0(k: rgb) = lambert(k)\n"
    terms = lines(f"term t{i + 1}(k: rgb) = t{i}({i + 1}.5 * k) + t{i}(k)" for i in range(size))
    return f"{head}{terms}\n" + material(f"color = t{size}(vec3(0.5))")


CLOSURES = """
struct Closure { response : vec3, throughput : vec3 }
fn over(top: Closure, base: Closure) -> Closure =
    Closure(top.response + base.response * top.throughput, top.throughput * base.throughput)
term layer0(k: vec3) -> Closure = Closure(k * saturate(dot(normal, to_eye)), vec3(0.5))
"""
"""Reflection as closures: what comes back from a layer, and what passes through it."""


def _layers(size: int, body: str) -> str:
    """Terms that each put a layer on the one before."""
    terms = lines(
        f"term layer{i + 1}(k: vec3) -> Closure = "
        + body.format(below=f"layer{i}", i=i + 1, top=f"Closure(k * {i}.5, vec3(1) / (k + {i}.5))")
        for i in range(size)
    )
    return f"{CLOSURES}{terms}\n" + material(f"color = rgb(layer{size}(vec3(uv, 0.5)).response)")


@shape(8, 512)
def closures_in_closures(size: int) -> str:
    return _layers(size, "over({top}, {below}(0.5 * k))")


@shape(8, 512)
def closure_dag(size: int) -> str:
    return _layers(size, "over({top}, over({below}(0.5 * k), {below}(k)))")


@shape(8, 512)
def with_twice(size: int) -> str:
    """Terms that each apply the one before with another slot, and once more as it is."""
    head = "import std.terms.{lambert}\nterm t0(k: rgb) = lambert(k)\n"
    terms = lines(
        f"term t{i + 1}(k: rgb) = "
        f"(t{i}(k) with {{ normal = normalize(normal + {i + 1}.5) }}) + t{i}(k)"
        for i in range(size)
    )
    return f"{head}{terms}\n" + material(f"color = t{size}(vec3(0.5))")


@shape(125, 4000)
def chain_of_calls(size: int) -> str:
    """Functions that each call the one before once."""
    return _calls("(x: float) -> float", size, "{f}(x * {i}.5) + 1")


@shape(500, 8000)
def calls_of_one_function(size: int) -> str:
    steps = lines(f"x{i + 1} = f(x{i}, {i}.5)" for i in range(size))
    head = "fn f(x: float, y: float) -> float = sin(x * y) + cos(x - y) * exp(-y) + sqrt(x)\n"
    return head + material(f"x0 = uv.x\n{steps}\nalpha = x{size}")


@shape(125, 4000)
def calls_of_many_functions(size: int) -> str:
    """Each of them is called twice, and so is a function of the shader."""
    functions = lines(
        f"fn f{i}(x: float) -> float = sin(x * {i}.5) + cos(exp(x) - sqrt(x)) * log(x + {i}.5)"
        for i in range(size)
    )
    uses = " + ".join(f"f{i}(uv.x) * f{i}(uv.y)" for i in range(size))
    return f"{functions}\n" + material(f"alpha = {uses}")


@shape(125, 4000)
def parts_of_a_function(size: int) -> str:
    parts = lines(f"p{i + 1} = p{i} * 1.5 + x" for i in range(size))
    head = f"fn f(x: float) -> float = p{size} where {{\np0 = sin(x)\n{parts}\n}}\n"
    return head + material("alpha = f(uv.x) + f(uv.y)")


# --- loops ---------------------------------------------------------------------------------------


@shape(64, 2048)
def loops_in_a_row(size: int) -> str:
    steps = lines(f"x{i + 1} = sum i in 0..8 : sin(x{i} * float(i)) + {i}.5" for i in range(size))
    return material(f"x0 = uv.x\n{steps}\nalpha = x{size}")


@shape(8, 32)
def loops_in_loops(size: int) -> str:
    head = "".join(f"(sum i{i} in 0..q : " for i in range(size))
    total = "+".join(f"float(i{i})" for i in range(size))
    return material(f"param q : int in 0..3\nalpha = {head}{total}{')' * size}")


@shape(4, 32)
def short_loops_in_loops(size: int) -> str:
    """Loops of two turns, whose innermost terms all differ: not all of them can be written out."""
    head = "".join(f"sum i{i} in 0..2 : " for i in range(size))
    total = " + ".join(f"float(i{i}) * {i}.5" for i in range(size))
    return material(f"alpha = {head}sin(uv.x + {total})")


@shape(4, 32)
def short_loops_over_states_in_loops(size: int) -> str:
    head = "".join(f"iterate x{i + 1} from x{i} up to 2 : " for i in range(size))
    return material(f"x0 = uv.x\nalpha = {head}sin(x{size} + 0.5)")


@shape(64, 4096)
def turns_of_a_constant_fold(size: int) -> str:
    return material(f"alpha = uv.x * (sum i in 0..{size} : sin(float(i)))")


@shape(32, 4096)
def turns_of_nested_constant_folds(size: int) -> str:
    inner = f"(sum j in 0..{size} : sin(float(i * j)))"
    head = f"c = (sum i in 0..{size} : {inner})\n"
    return head + material("param p : float = c\nalpha = p")


@shape(64, 4096)
def turns_of_a_constant_iteration(size: int) -> str:
    return material(f"alpha = uv.x * (iterate x from 1.0 up to {size} : sin(x) + 0.5)")


@shape(8, 64)
def states_of_a_loop(size: int) -> str:
    members = lines(f"m{i} : float" for i in range(size))
    start = ", ".join("uv.x" for _ in range(size))
    after = ", ".join(f"s.m{(i + 1) % size} * 1.5 + float(i)" for i in range(size))
    head = f"struct State {{\n{members}\n}}\n"
    loop = f"iterate s from State({start}) for i in 0..20 :\nState({after})"
    return head + material(f"last = {loop}\nalpha = last.m0")


# --- what is put together ------------------------------------------------------------------------


@shape(125, 4000)
def long_array(size: int) -> str:
    values = ", ".join(f"{i}.5" for i in range(size))
    return material(f"param i : int\nvalues = [{values}]\nalpha = values[i]")


@shape(125, 4000)
def long_computed_array(size: int) -> str:
    values = ", ".join(f"sin(uv.x * {i}.5)" for i in range(size))
    return material(f"param i : int\nvalues = [{values}]\nalpha = values[i]")


@shape(125, 4000)
def large_structure(size: int) -> str:
    members = lines(f"m{i} : float" for i in range(size))
    values = ", ".join(f"uv.x * {i}.5" for i in range(size))
    head = f"struct Large {{\n{members}\n}}\n"
    total = " + ".join(f"made.m{i}" for i in range(size))
    return head + material(f"made = Large({values})\nalpha = {total}")


@shape(125, 4000)
def structures_through_choices(size: int) -> str:
    head = "struct Pair { one : float, two : vec3 }\n"
    steps = lines(
        f"p{i + 1} = if uv.x < {i}.5 then Pair(p{i}.one + 1, p{i}.two) else p{i}"
        for i in range(size)
    )
    return head + material(f"p0 = Pair(uv.x, position)\n{steps}\nalpha = p{size}.one")


@shape(8, 64)
def structures_in_structures(size: int) -> str:
    head = "struct S0 { a : float, b : float }\n"
    nested = lines(f"struct S{i + 1} {{ a : S{i}, b : float }}" for i in range(size - 1))
    path = ".a" * size
    return f"{head}{nested}\n" + material(f"param s : S{size - 1}\nalpha = s{path}")


@shape(8, 64)
def structures_of_two_structures(size: int) -> str:
    """The number of parts doubles with each level."""
    head = "struct S0 { a : float, b : float }\n"
    nested = lines(f"struct S{i + 1} {{ a : S{i}, b : S{i} }}" for i in range(size - 1))
    path = ".a" * size
    return f"{head}{nested}\n" + material(f"param s : S{size - 1}\nalpha = s{path}")
