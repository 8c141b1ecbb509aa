// What builtins mean, for the host's part of a computation: see docs/builtins.md. All functions are
// defined for all operands, as both sides of a choice are computed.
const TINY = 2 ** -126;
const LARGEST = 2 ** 128 - 2 ** 104;
const NARROWEST = 2 ** -64;
const BELOW_ONE = 1 - 2 ** -24;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const isTiny = (x) => Math.abs(x) < TINY;
const truth = (is) => (is ? 1 : 0);
/** The nearest whole number, and the even one in the middle between two. */
function round(x) {
    const found = Math.round(x);
    return Math.abs(x % 1) === 0.5 && found % 2 !== 0 ? found - 1 : found;
}
const floored = (x, y) => {
    const rest = x % y;
    return rest !== 0 && rest < 0 !== y < 0 ? rest + y : rest;
};
const divided = (x, y) => (isTiny(y) ? 0 : x / y);
const root = (x) => Math.sqrt(Math.max(x, 0));
const inverseRoot = (x) => 1 / Math.sqrt(Math.max(x, TINY));
const log2 = (x) => Math.log2(Math.max(x, TINY));
function power(x, y) {
    if (x < TINY && y < TINY)
        return isTiny(y) ? 1 : 0;
    return Math.pow(x < TINY ? 0 : x, y);
}
function smoothstep(low, high, x) {
    const width = high - low;
    const t = clamp((x - low) / (Math.abs(width) < NARROWEST ? NARROWEST : width), 0, 1);
    return t * t * (3 - 2 * t);
}
function atan2(y, x) {
    if (isTiny(y))
        return x <= -TINY ? Math.PI : 0;
    return Math.atan2(y, x);
}
// --- bits ----------------------------------------------------------------------------------------
const word = new DataView(new ArrayBuffer(4));
function bitsOf(x) {
    const magnitude = Math.min(Math.abs(x), LARGEST);
    if (magnitude < TINY)
        return 0;
    word.setFloat32(0, x < 0 ? -magnitude : magnitude);
    return word.getUint32(0);
}
function floatOfBits(bits) {
    const exponent = (bits >>> 23) & 255;
    if (exponent === 0 || exponent === 255)
        return 0;
    word.setUint32(0, bits >>> 0);
    return word.getFloat32(0);
}
function exponentOf(x) {
    const bits = bitsOf(x);
    return bits === 0 ? 0 : ((bits >>> 23) & 255) - 126;
}
/** The bits of the nearest number of 16 bits. */
function halfBits(x) {
    const magnitude = Math.min(Math.abs(x), 65504);
    let exponent = Math.floor(Math.log2(Math.max(magnitude, 2 ** -14)));
    if (2 ** exponent > magnitude)
        exponent = Math.max(exponent - 1, -14);
    if (2 ** (exponent + 1) <= magnitude)
        exponent += 1;
    const bits = magnitude < 2 ** -14
        ? round(magnitude * 2 ** 24)
        : ((exponent + 14) << 10) + round(magnitude * 2 ** (10 - exponent));
    return x < 0 && bits > 0 ? bits | 0x8000 : bits;
}
export function halfOfBits(bits) {
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 0x3ff;
    const normal = exponent === 31 ? 0 : (fraction + 1024) * 2 ** (exponent - 25);
    const magnitude = exponent === 0 ? fraction * 2 ** -24 : normal;
    return bits & 0x8000 ? -magnitude : magnitude;
}
function countBits(x) {
    let count = 0;
    for (let bits = x >>> 0; bits; bits &= bits - 1)
        count++;
    return count;
}
function reversed(x) {
    let found = 0;
    for (let bit = 0; bit < 32; bit++)
        found |= ((x >>> bit) & 1) << (31 - bit);
    return found;
}
/** A field's first bit, its width, and as many ones: all within 32 bits. */
function field(offset, count) {
    const first = clamp(offset, 0, 32);
    const width = clamp(count, 0, 32 - first);
    return [first, width, width === 32 ? -1 : (1 << width) - 1];
}
function extracted(x, offset, count) {
    const [first, , ones] = field(offset, count);
    return (x >>> (first & 31)) & ones;
}
function extractedSigned(x, offset, count) {
    const [, width] = field(offset, count);
    return width ? (extracted(x, offset, count) << (32 - width)) >> (32 - width) : 0;
}
function inserted(x, y, offset, count) {
    const [first, width, ones] = field(offset, count);
    return width ? (x & ~(ones << first)) | ((y & ones) << first) : x;
}
/** Parts of equal width in 32 bits, the first one lowest. */
function packed(parts) {
    const width = 32 / parts.length;
    const ones = 2 ** width - 1;
    return [parts.reduce((all, part, at) => all | ((part & ones) << (at * width)), 0) >>> 0];
}
const parted = (x, count) => Array.from({ length: count }, (_, at) => (x >>> ((at * 32) / count)) & (2 ** (32 / count) - 1));
const packUnorm = (v) => packed(v.map((lane) => round(clamp(lane, 0, 1) * (2 ** (32 / v.length) - 1))));
const packSnorm = (v) => packed(v.map((lane) => round(clamp(lane, -1, 1) * (2 ** (32 / v.length - 1) - 1))));
const unpackUnorm = (count) => ([x]) => parted(x, count).map((part) => part / (2 ** (32 / count) - 1));
const unpackSnorm = (count) => ([x]) => {
    const sign = 2 ** (32 / count - 1);
    return parted(x, count).map((part) => Math.max(((part ^ sign) - sign) / (sign - 1), -1));
};
// --- lane by lane --------------------------------------------------------------------------------
const FLOATS = {
    add: (x, y) => x + y,
    sub: (x, y) => x - y,
    mul: (x, y) => x * y,
    neg: (x) => -x,
    abs: Math.abs,
    min: Math.min,
    max: Math.max,
    clamp,
    div: divided,
    mod: (x, y) => (isTiny(y) ? 0 : floored(x, y)),
    sign: (x) => (x > 0 ? 1 : x < 0 ? -1 : 0),
    floor: Math.floor,
    ceil: Math.ceil,
    round,
    trunc: Math.trunc,
    fract: (x) => x - Math.floor(x),
    saturate: (x) => clamp(x, 0, 1),
    mix: (x, y, a) => x * (1 - a) + y * a,
    step: (edge, x) => truth(x >= edge),
    smoothstep,
    sqrt: root,
    inversesqrt: inverseRoot,
    pow: power,
    exp: Math.exp,
    exp2: (x) => Math.pow(2, x),
    log: (x) => Math.log(Math.max(x, TINY)),
    log2,
    log10: (x) => Math.log10(2) * log2(x),
    sin: Math.sin,
    cos: Math.cos,
    tan: Math.tan,
    asin: (x) => Math.asin(clamp(x, -1, 1)),
    acos: (x) => Math.acos(clamp(x, -1, 1)),
    atan: Math.atan,
    atan2,
    radians: (x) => x * (Math.PI / 180),
    degrees: (x) => x * (180 / Math.PI),
    fma: (x, y, z) => x * y + z,
    sinh: Math.sinh,
    cosh: Math.cosh,
    tanh: Math.tanh,
    asinh: Math.asinh,
    acosh: (x) => Math.acosh(Math.max(x, 1)),
    atanh: (x) => Math.atanh(clamp(x, -BELOW_ONE, BELOW_ONE)),
    mantissa: (x) => floatOfBits(bitsOf(x)) / 2 ** exponentOf(x),
    ldexp: (x, n) => x * 2 ** clamp(n, -252, 254),
    quantize_half: (x) => halfOfBits(halfBits(x)),
};
const INTEGERS = {
    add: FLOATS.add,
    sub: FLOATS.sub,
    mul: Math.imul,
    neg: FLOATS.neg,
    abs: Math.abs,
    min: Math.min,
    max: Math.max,
    clamp,
    div: (x, y) => (y === 0 ? x : Math.trunc(x / y)),
    mod: (x, y) => (y === 0 ? 0 : floored(x, y)),
    sign: FLOATS.sign,
    bit_and: (x, y) => x & y,
    bit_or: (x, y) => x | y,
    bit_xor: (x, y) => x ^ y,
    bit_not: (x) => ~x,
    shift_left: (x, amount) => x << (amount & 31),
    reverse_bits: reversed,
    insert_bits: inserted,
};
const OF_KIND = {
    int: { shift_right: (x, amount) => x >> (amount & 31), extract_bits: extractedSigned },
    uint: { shift_right: (x, amount) => x >>> (amount & 31), extract_bits: extracted },
};
const OF_ANOTHER_KIND = {
    eq: (x, y) => truth(x === y),
    ne: (x, y) => truth(x !== y),
    lt: (x, y) => truth(x < y),
    le: (x, y) => truth(x <= y),
    gt: (x, y) => truth(x > y),
    ge: (x, y) => truth(x >= y),
    and: (x, y) => truth(!!x && !!y),
    or: (x, y) => truth(!!x || !!y),
    not: (x) => truth(!x),
    choose: (condition, x, y) => (condition ? x : y),
    count_bits: countBits,
    first_leading_bit: (x) => 31 - Math.clz32(x < 0 ? ~x : x),
    first_trailing_bit: (x) => (x === 0 ? -1 : countBits(~x & (x - 1))),
    bits_of: bitsOf,
    float_of_bits: floatOfBits,
    exponent: exponentOf,
};
const wrapped = (kind, x) => (kind === "int" ? x | 0 : x >>> 0);
function converted(name, kind, x) {
    if (name === "to_float")
        return x;
    if (kind !== "float")
        return wrapped(name === "to_int" ? "int" : "uint", x);
    if (Number.isNaN(x))
        return 0;
    const isSigned = name === "to_int";
    return Math.trunc(clamp(x, isSigned ? -(2 ** 31) : 0, isSigned ? LARGEST_INT : LARGEST_UINT));
}
const LARGEST_INT = 2 ** 31 - 2 ** 7;
const LARGEST_UINT = 2 ** 32 - 2 ** 8;
// --- whole values --------------------------------------------------------------------------------
function dot(x, y, product = (a, b) => a * b) {
    return x.reduce((sum, lane, at) => sum + product(lane, y[at]), 0);
}
const scaled = (v, by) => v.map((lane) => lane * by);
const transposed = (m) => m[0].map((_, row) => m.map((column) => column[row]));
function determinant(m) {
    if (!m.length)
        return 1;
    return m[0].reduce((sum, lane, row) => sum + lane * cofactor(m, 0, row), 0);
}
function cofactor(m, column, row) {
    const without = (items, at) => items.filter((_, other) => other !== at);
    const minor = without(m, column).map((lanes) => without(lanes, row));
    return determinant(minor) * (-1) ** (column + row);
}
function inverse(m) {
    const scale = divided(1, determinant(m));
    return m.map((_, j) => m.map((_, i) => cofactor(m, i, j) * scale));
}
function product(x, y) {
    if (!isMatrix(x))
        return product(y, x);
    if (isMatrix(y))
        return y.map((column) => product(x, column));
    if (y.length === 1)
        return x.map((column) => scaled(column, y[0]));
    return transposed(x).map((row) => dot(row, y));
}
function refracted(incident, normal, [eta]) {
    const cosine = dot(normal, incident);
    const square = 1 - eta * eta * (1 - cosine * cosine);
    const along = eta * cosine + root(square);
    return incident.map((i, at) => (square < 0 ? 0 : eta * i - along * normal[at]));
}
const WHOLE = {
    dot: (x, y) => [dot(x, y)],
    any: (x) => [truth(x.some(Boolean))],
    all: (x) => [truth(x.every(Boolean))],
    cross: (x, y) => [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ],
    length: (v) => [Math.sqrt(dot(v, v))],
    distance: (x, y) => WHOLE.length(x.map((lane, at) => lane - y[at])),
    normalize: (v) => scaled(v, inverseRoot(dot(v, v))),
    nonzero: (v) => v,
    reflect: (incident, normal) => {
        const twice = 2 * dot(normal, incident);
        return incident.map((i, at) => i - twice * normal[at]);
    },
    refract: refracted,
    faceforward: (normal, incident, reference) => dot(reference, incident) < 0 ? normal : scaled(normal, -1),
    lit: ([nl], [nh], [exponent]) => [
        1, Math.max(nl, 0), nl < 0 || nh < 0 ? 0 : power(nh, exponent), 1,
    ],
    transpose: transposed,
    determinant: (m) => [determinant(m)],
    outer: (column, row) => row.map((lane) => scaled(column, lane)),
    hadamard: (x, y) => x.map((column, at) => column.map((lane, row) => lane * y[at][row])),
    inverse,
    pack_unorm4x8: packUnorm,
    pack_unorm2x16: packUnorm,
    pack_snorm4x8: packSnorm,
    pack_snorm2x16: packSnorm,
    pack_half2x16: (v) => packed(v.map(halfBits)),
    unpack_unorm4x8: unpackUnorm(4),
    unpack_unorm2x16: unpackUnorm(2),
    unpack_snorm4x8: unpackSnorm(4),
    unpack_snorm2x16: unpackSnorm(2),
    unpack_half2x16: ([x]) => parted(x, 2).map(halfOfBits),
};
const isMatrix = (value) => Array.isArray(value[0]);
/** The value of a builtin; `kind` is the type of the operands' lanes. */
export function evaluate(name, operands, kind) {
    if (name === "dot" && kind !== "float") {
        return [wrapped(kind, dot(operands[0], operands[1], Math.imul))];
    }
    if (WHOLE[name])
        return WHOLE[name](...operands);
    if (operands.some(isMatrix)) {
        if (name === "mul")
            return product(operands[0], operands[1]);
        return operands[0].map((_, at) => evaluate(name, operands.map((each) => each[at]), kind));
    }
    const lanewise = laneFunction(name, kind);
    const width = Math.max(...operands.map((each) => each.length));
    return Array.from({ length: width }, (_, at) => lanewise(...operands.map((each) => each[each.length === 1 ? 0 : at])));
}
function laneFunction(name, kind) {
    if (name.startsWith("to_"))
        return (x) => converted(name, kind, x);
    if (OF_ANOTHER_KIND[name])
        return OF_ANOTHER_KIND[name];
    const isInteger = kind === "int" || kind === "uint";
    const found = isInteger ? (OF_KIND[kind][name] ?? INTEGERS[name]) : FLOATS[name];
    if (!found)
        throw new Error(`this host does not know the function ${name} of ${kind}`);
    return isInteger ? (...lanes) => wrapped(kind, found(...lanes)) : found;
}
