// Generated from compiler/reference, which says what builtins mean, by the tests: do not edit.

/** A number is one lane; a vector its lanes; a matrix its columns. Truth is 1 or 0. */
export type Lanes = number[] | number[][];
export type Kind = "float" | "int" | "uint" | "bool";

/** The nearest whole number, and the even one in the middle between two. */
function nearest(x: number): number {
  const found = Math.round(x);
  return Math.abs(x % 1) === 0.5 && found % 2 !== 0 ? found - 1 : found;
}

/** The remainder of the quotient rounded down; it has the sign of `y`. */
function remainder(x: number, y: number): number {
  const rest = x % y;
  return rest !== 0 && rest < 0 !== y < 0 ? rest + y : rest;
}

const whole = (x: number) => (Number.isFinite(x) ? Math.trunc(x) : 0);

/** The exponent of a number whose fraction is at least a half and below one. */
function exponentOf(x: number): number {
  if (x === 0) return 0;
  const found = Math.floor(Math.log2(Math.abs(x))) + 1;
  // Logarithms are rounded.
  const fraction = Math.abs(x) / 2 ** found;
  return fraction >= 1 ? found + 1 : fraction < 0.5 ? found - 1 : found;
}

const fractionOf = (x: number) => x / 2 ** exponentOf(x);

/** Functions that work lane by lane, by name and the type of the operands' lanes. */
export const LANEWISE: Record<string, (...lanes: number[]) => number> = {
  "add float": (x, y) => x + y,
  "add int": (x, y) => (x + y) | 0,
  "add uint": (x, y) => (x + y) >>> 0,
  "sub float": (x, y) => x - y,
  "sub int": (x, y) => (x - y) | 0,
  "sub uint": (x, y) => (x - y) >>> 0,
  "mul float": (x, y) => x * y,
  "mul int": (x, y) => Math.imul(x, y) | 0,
  "mul uint": (x, y) => Math.imul(x, y) >>> 0,
  "div float": (x, y) => {
    const v0 = Math.abs(y) < 1.1754943508222875e-38;
    return v0 ? 0 : x / (v0 ? 1 : y);
  },
  "div int": (x, y) => {
    const v0 = Math.floor(Math.abs(x) / Math.max(Math.abs(y), 1));
    return (y === 0 ? x : x < 0 !== y < 0 ? -v0 : v0) | 0;
  },
  "div uint": (x, y) => {
    const v0 = Math.floor(Math.abs(x) / Math.max(Math.abs(y), 1));
    return (y === 0 ? x : x < 0 !== y < 0 ? -v0 : v0) >>> 0;
  },
  "mod float": (x, y) => {
    const v0 = Math.abs(y) < 1.1754943508222875e-38;
    return v0 ? 0 : remainder(x, v0 ? 1 : y);
  },
  "mod int": (x, y) => {
    const v0 = y === 0;
    return (v0 ? 0 : remainder(x, v0 ? 1 : y)) | 0;
  },
  "mod uint": (x, y) => {
    const v0 = y === 0;
    return (v0 ? 0 : remainder(x, v0 ? 1 : y)) >>> 0;
  },
  "neg float": (x) => -x,
  "neg int": (x) => -x | 0,
  "eq float": (x, y) => Number(x === y),
  "eq int": (x, y) => Number(x === y),
  "eq uint": (x, y) => Number(x === y),
  "eq bool": (x, y) => Number(x === y),
  "ne float": (x, y) => Number(x !== y),
  "ne int": (x, y) => Number(x !== y),
  "ne uint": (x, y) => Number(x !== y),
  "ne bool": (x, y) => Number(x !== y),
  "lt float": (x, y) => Number(x < y),
  "lt int": (x, y) => Number(x < y),
  "lt uint": (x, y) => Number(x < y),
  "le float": (x, y) => Number(x <= y),
  "le int": (x, y) => Number(x <= y),
  "le uint": (x, y) => Number(x <= y),
  "gt float": (x, y) => Number(x > y),
  "gt int": (x, y) => Number(x > y),
  "gt uint": (x, y) => Number(x > y),
  "ge float": (x, y) => Number(x >= y),
  "ge int": (x, y) => Number(x >= y),
  "ge uint": (x, y) => Number(x >= y),
  "and bool": (x, y) => Number(x && y),
  "or bool": (x, y) => Number(x || y),
  "not bool": (x) => Number(!x),
  "choose bool": (x, y, z) => (x ? y : z),
  "abs float": (x) => Math.abs(x),
  "abs int": (x) => Math.abs(x) | 0,
  "sign float": (x) => (x > 0 ? 1 : x < 0 ? -1 : 0),
  "sign int": (x) => (x > 0 ? 1 : x < 0 ? -1 : 0) | 0,
  "floor float": (x) => Math.floor(x),
  "ceil float": (x) => Math.ceil(x),
  "round float": (x) => nearest(x),
  "trunc float": (x) => Math.trunc(x),
  "fract float": (x) => x - Math.floor(x),
  "min float": (x, y) => Math.min(x, y),
  "min int": (x, y) => Math.min(x, y) | 0,
  "min uint": (x, y) => Math.min(x, y) >>> 0,
  "max float": (x, y) => Math.max(x, y),
  "max int": (x, y) => Math.max(x, y) | 0,
  "max uint": (x, y) => Math.max(x, y) >>> 0,
  "clamp float": (x, y, z) => Math.min(Math.max(x, y), z),
  "clamp int": (x, y, z) => Math.min(Math.max(x, y), z) | 0,
  "clamp uint": (x, y, z) => Math.min(Math.max(x, y), z) >>> 0,
  "saturate float": (x) => Math.min(Math.max(x, 0), 1),
  "mix float": (x, y, z) => x * (1 - z) + y * z,
  "fma float": (x, y, z) => x * y + z,
  "step float": (x, y) => (y >= x ? 1 : 0),
  "smoothstep float": (x, y, z) => {
    const v0 = y - x;
    const v1 = Math.min(
      Math.max((z - x) / (Math.abs(v0) < 5.421010862427522e-20 ? 5.421010862427522e-20 : v0), 0),
      1,
    );
    return v1 * v1 * (3 - 2 * v1);
  },
  "sqrt float": (x) => Math.sqrt(Math.max(x, 0)),
  "inversesqrt float": (x) => 1 / Math.sqrt(Math.max(x, 1.1754943508222875e-38)),
  "pow float": (x, y) => {
    const v0 = x < 1.1754943508222875e-38;
    return v0 && y < 1.1754943508222875e-38
      ? Math.abs(y) < 1.1754943508222875e-38
        ? 1
        : 0
      : Math.pow(v0 ? 0 : x, y);
  },
  "exp float": (x) => Math.exp(x),
  "exp2 float": (x) => Math.pow(2, x),
  "log float": (x) => Math.log(Math.max(x, 1.1754943508222875e-38)),
  "log10 float": (x) => 0.3010299956639812 * Math.log2(Math.max(x, 1.1754943508222875e-38)),
  "log2 float": (x) => Math.log2(Math.max(x, 1.1754943508222875e-38)),
  "sin float": (x) => Math.sin(x),
  "cos float": (x) => Math.cos(x),
  "tan float": (x) => Math.tan(x),
  "asin float": (x) => Math.asin(Math.min(Math.max(x, -1), 1)),
  "acos float": (x) => Math.acos(Math.min(Math.max(x, -1), 1)),
  "atan float": (x) => Math.atan(x),
  "atan2 float": (x, y) =>
    Math.abs(x) < 1.1754943508222875e-38
      ? y <= -1.1754943508222875e-38
        ? 3.141592653589793
        : 0
      : Math.atan2(x, y),
  "radians float": (x) => x * 0.017453292519943295,
  "degrees float": (x) => x * 57.29577951308232,
  "sinh float": (x) => Math.sinh(x),
  "cosh float": (x) => Math.cosh(x),
  "tanh float": (x) => Math.tanh(x),
  "asinh float": (x) => Math.asinh(x),
  "acosh float": (x) => Math.acosh(Math.max(x, 1)),
  "atanh float": (x) => Math.atanh(Math.min(Math.max(x, -0.9999999403953552), 0.9999999403953552)),
  "to_float int": (x) => x,
  "to_float uint": (x) => x,
  "to_float bool": (x) => x,
  "to_int float": (x) => whole(Math.min(Math.max(x, -2147483648), 2147483520)),
  "to_int uint": (x) => whole(x) | 0,
  "to_int bool": (x) => whole(x) | 0,
  "to_uint float": (x) => whole(Math.min(Math.max(x, 0), 4294967040)) >>> 0,
  "to_uint int": (x) => whole(x) >>> 0,
  "to_uint bool": (x) => whole(x) >>> 0,
  "bit_and int": (x, y) => (x & y) | 0,
  "bit_and uint": (x, y) => (x & y) >>> 0,
  "bit_or int": (x, y) => x | y | 0,
  "bit_or uint": (x, y) => (x | y) >>> 0,
  "bit_xor int": (x, y) => (x ^ y) | 0,
  "bit_xor uint": (x, y) => (x ^ y) >>> 0,
  "bit_not int": (x) => ~x | 0,
  "bit_not uint": (x) => ~x >>> 0,
  "shift_left int": (x, y) => (x * 2 ** ((y & 31) >>> 0)) | 0,
  "shift_left uint": (x, y) => (x * 2 ** ((y & 31) >>> 0)) >>> 0,
  "shift_right int": (x, y) => Math.floor(x / 2 ** ((y & 31) >>> 0)) | 0,
  "shift_right uint": (x, y) => Math.floor(x / 2 ** ((y & 31) >>> 0)) >>> 0,
  "count_bits int": (x) => {
    const v0 = x >>> 0;
    const v1 = v0 - ((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0);
    const v2 = ((v1 & 858993459) >>> 0) + ((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0);
    return Math.floor(
      (Math.imul(((v2 + Math.floor(v2 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
    );
  },
  "count_bits uint": (x) => {
    const v0 = x >>> 0;
    const v1 = v0 - ((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0);
    const v2 = ((v1 & 858993459) >>> 0) + ((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0);
    return Math.floor(
      (Math.imul(((v2 + Math.floor(v2 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
    );
  },
  "reverse_bits int": (x) => {
    const v0 = x >>> 0;
    const v1 =
      (((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0) | (((v0 & 1431655765) >>> 0) * 2 ** 1)) >>> 0;
    const v2 =
      (((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0) | (((v1 & 858993459) >>> 0) * 2 ** 2)) >>> 0;
    const v3 =
      (((Math.floor(v2 / 2 ** 4) & 252645135) >>> 0) | (((v2 & 252645135) >>> 0) * 2 ** 4)) >>> 0;
    const v4 =
      (((Math.floor(v3 / 2 ** 8) & 16711935) >>> 0) | (((v3 & 16711935) >>> 0) * 2 ** 8)) >>> 0;
    return (
      ((((Math.floor(v4 / 2 ** 16) & 65535) >>> 0) | (((v4 & 65535) >>> 0) * 2 ** 16)) >>> 0) | 0
    );
  },
  "reverse_bits uint": (x) => {
    const v0 = x >>> 0;
    const v1 =
      (((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0) | (((v0 & 1431655765) >>> 0) * 2 ** 1)) >>> 0;
    const v2 =
      (((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0) | (((v1 & 858993459) >>> 0) * 2 ** 2)) >>> 0;
    const v3 =
      (((Math.floor(v2 / 2 ** 4) & 252645135) >>> 0) | (((v2 & 252645135) >>> 0) * 2 ** 4)) >>> 0;
    const v4 =
      (((Math.floor(v3 / 2 ** 8) & 16711935) >>> 0) | (((v3 & 16711935) >>> 0) * 2 ** 8)) >>> 0;
    return (((Math.floor(v4 / 2 ** 16) & 65535) >>> 0) | (((v4 & 65535) >>> 0) * 2 ** 16)) >>> 0;
  },
  "first_leading_bit int": (x) => {
    const v0 = x < 0 ? ~x : x;
    const v1 = v0 | Math.floor(v0 / 2 ** 1);
    const v2 = v1 | Math.floor(v1 / 2 ** 2);
    const v3 = v2 | Math.floor(v2 / 2 ** 4);
    const v4 = v3 | Math.floor(v3 / 2 ** 8);
    const v5 = (v4 | Math.floor(v4 / 2 ** 16)) >>> 0;
    const v6 = v5 - ((Math.floor(v5 / 2 ** 1) & 1431655765) >>> 0);
    const v7 = ((v6 & 858993459) >>> 0) + ((Math.floor(v6 / 2 ** 2) & 858993459) >>> 0);
    return (
      Math.floor(
        (Math.imul(((v7 + Math.floor(v7 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
      ) - 1
    );
  },
  "first_leading_bit uint": (x) => {
    const v0 = x < 0 ? ~x : x;
    const v1 = v0 | Math.floor(v0 / 2 ** 1);
    const v2 = v1 | Math.floor(v1 / 2 ** 2);
    const v3 = v2 | Math.floor(v2 / 2 ** 4);
    const v4 = v3 | Math.floor(v3 / 2 ** 8);
    const v5 = (v4 | Math.floor(v4 / 2 ** 16)) >>> 0;
    const v6 = v5 - ((Math.floor(v5 / 2 ** 1) & 1431655765) >>> 0);
    const v7 = ((v6 & 858993459) >>> 0) + ((Math.floor(v6 / 2 ** 2) & 858993459) >>> 0);
    return (
      Math.floor(
        (Math.imul(((v7 + Math.floor(v7 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
      ) - 1
    );
  },
  "first_trailing_bit int": (x) => {
    const v0 = (~x & (x - 1)) >>> 0;
    const v1 = v0 - ((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0);
    const v2 = ((v1 & 858993459) >>> 0) + ((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0);
    return x === 0
      ? -1
      : Math.floor(
          (Math.imul(((v2 + Math.floor(v2 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
        );
  },
  "first_trailing_bit uint": (x) => {
    const v0 = (~x & (x - 1)) >>> 0;
    const v1 = v0 - ((Math.floor(v0 / 2 ** 1) & 1431655765) >>> 0);
    const v2 = ((v1 & 858993459) >>> 0) + ((Math.floor(v1 / 2 ** 2) & 858993459) >>> 0);
    return x === 0
      ? -1
      : Math.floor(
          (Math.imul(((v2 + Math.floor(v2 / 2 ** 4)) & 252645135) >>> 0, 16843009) >>> 0) / 2 ** 24,
        );
  },
  "extract_bits int": (x, y, z) => {
    const v0 = Math.min(Math.max(y, 0), 32);
    const v1 = 1 * 2 ** Math.min(Math.max(z, 0), 32 - v0);
    const v2 = Math.floor(v1 / 2 ** 1);
    return (((((Math.floor((x >>> 0) / 2 ** v0) & (v1 - 1)) >>> 0) ^ v2) >>> 0) - v2) | 0;
  },
  "extract_bits uint": (x, y, z) => {
    const v0 = Math.min(Math.max(y, 0), 32);
    return (
      (Math.floor((x >>> 0) / 2 ** v0) & (1 * 2 ** Math.min(Math.max(z, 0), 32 - v0) - 1)) >>> 0
    );
  },
  "insert_bits int": (x, y, z, w) => {
    const v0 = Math.min(Math.max(z, 0), 32);
    const v1 = 1 * 2 ** Math.min(Math.max(w, 0), 32 - v0) - 1;
    return (x & ~(v1 * 2 ** v0)) | ((y & v1) * 2 ** v0) | 0;
  },
  "insert_bits uint": (x, y, z, w) => {
    const v0 = Math.min(Math.max(z, 0), 32);
    const v1 = 1 * 2 ** Math.min(Math.max(w, 0), 32 - v0) - 1;
    return (((x & ~(v1 * 2 ** v0)) >>> 0) | (((y & v1) >>> 0) * 2 ** v0)) >>> 0;
  },
  "bits_of float": (x) => {
    const v0 = Math.min(Math.abs(x), 3.4028234663852886e38);
    const v1 =
      (whole(exponentOf(v0)) + 126) * 2 ** 23 + whole(nearest(fractionOf(v0) * 16777216)) - 8388608;
    return (v0 < 1.1754943508222875e-38 ? 0 : x < 0 ? v1 | 2147483648 : v1) >>> 0;
  },
  "float_of_bits uint": (x) => {
    const v0 = (Math.floor(x / 2 ** 23) & 255) >>> 0;
    const v1 = v0 > 0 && v0 < 255;
    const v2 = ((((x & 8388607) >>> 0) | 8388608) >>> 0) * 2 ** ((v1 ? v0 : 127) - 150);
    return v1 ? ((Math.floor(x / 2 ** 31) & 1) >>> 0 === 1 ? -v2 : v2) : 0;
  },
  "exponent float": (x) => {
    const v0 = Math.min(Math.abs(x), 3.4028234663852886e38);
    const v1 =
      (whole(exponentOf(v0)) + 126) * 2 ** 23 + whole(nearest(fractionOf(v0) * 16777216)) - 8388608;
    const v2 = v0 < 1.1754943508222875e-38 ? 0 : x < 0 ? v1 | 2147483648 : v1;
    return v2 === 0 ? 0 : ((Math.floor(v2 / 2 ** 23) & 255) >>> 0) - 126;
  },
  "mantissa float": (x) => {
    const v0 = Math.min(Math.abs(x), 3.4028234663852886e38);
    const v1 =
      (whole(exponentOf(v0)) + 126) * 2 ** 23 + whole(nearest(fractionOf(v0) * 16777216)) - 8388608;
    const v2 = v0 < 1.1754943508222875e-38 ? 0 : x < 0 ? v1 | 2147483648 : v1;
    const v3 = (Math.floor(v2 / 2 ** 23) & 255) >>> 0;
    const v4 = v3 > 0 && v3 < 255;
    const v5 = ((((v2 & 8388607) >>> 0) | 8388608) >>> 0) * 2 ** ((v4 ? v3 : 127) - 150);
    return fractionOf(v4 ? ((Math.floor(v2 / 2 ** 31) & 1) >>> 0 === 1 ? -v5 : v5) : 0);
  },
  "ldexp float": (x, y) => x * 2 ** Math.min(Math.max(y, -252), 254),
  "quantize_half float": (x) => {
    const v0 = Math.min(Math.abs(x), 65504);
    const v1 =
      v0 < 6.103515625e-5
        ? whole(nearest(v0 * 16777216))
        : (whole(exponentOf(v0)) + 14) * 2 ** 10 + whole(nearest(fractionOf(v0) * 2048)) - 1024;
    const v2 = x < 0 && v1 > 0 ? v1 | 32768 : v1;
    const v3 = (Math.floor(v2 / 2 ** 10) & 31) >>> 0;
    const v4 = (v2 & 1023) >>> 0;
    const v5 = v3 === 0 ? v4 * 5.960464477539063e-8 : v3 === 31 ? 0 : (v4 + 1024) * 2 ** (v3 - 25);
    return (v2 & 32768) >>> 0 === 0 ? v5 : -v5;
  },
};

/** Other functions, by name, this type, and the lanes of each operand. */
export const WHOLE: Record<string, (...operands: any[]) => Lanes> = {
  "add float 2x2 2x2": (x, y) => [
    [x[0][0] + y[0][0], x[0][1] + y[0][1]],
    [x[1][0] + y[1][0], x[1][1] + y[1][1]],
  ],
  "add float 3x3 3x3": (x, y) => [
    [x[0][0] + y[0][0], x[0][1] + y[0][1], x[0][2] + y[0][2]],
    [x[1][0] + y[1][0], x[1][1] + y[1][1], x[1][2] + y[1][2]],
    [x[2][0] + y[2][0], x[2][1] + y[2][1], x[2][2] + y[2][2]],
  ],
  "add float 4x4 4x4": (x, y) => [
    [x[0][0] + y[0][0], x[0][1] + y[0][1], x[0][2] + y[0][2], x[0][3] + y[0][3]],
    [x[1][0] + y[1][0], x[1][1] + y[1][1], x[1][2] + y[1][2], x[1][3] + y[1][3]],
    [x[2][0] + y[2][0], x[2][1] + y[2][1], x[2][2] + y[2][2], x[2][3] + y[2][3]],
    [x[3][0] + y[3][0], x[3][1] + y[3][1], x[3][2] + y[3][2], x[3][3] + y[3][3]],
  ],
  "sub float 2x2 2x2": (x, y) => [
    [x[0][0] - y[0][0], x[0][1] - y[0][1]],
    [x[1][0] - y[1][0], x[1][1] - y[1][1]],
  ],
  "sub float 3x3 3x3": (x, y) => [
    [x[0][0] - y[0][0], x[0][1] - y[0][1], x[0][2] - y[0][2]],
    [x[1][0] - y[1][0], x[1][1] - y[1][1], x[1][2] - y[1][2]],
    [x[2][0] - y[2][0], x[2][1] - y[2][1], x[2][2] - y[2][2]],
  ],
  "sub float 4x4 4x4": (x, y) => [
    [x[0][0] - y[0][0], x[0][1] - y[0][1], x[0][2] - y[0][2], x[0][3] - y[0][3]],
    [x[1][0] - y[1][0], x[1][1] - y[1][1], x[1][2] - y[1][2], x[1][3] - y[1][3]],
    [x[2][0] - y[2][0], x[2][1] - y[2][1], x[2][2] - y[2][2], x[2][3] - y[2][3]],
    [x[3][0] - y[3][0], x[3][1] - y[3][1], x[3][2] - y[3][2], x[3][3] - y[3][3]],
  ],
  "mul float 2x2 2": (x, y) => [x[0][0] * y[0] + x[1][0] * y[1], x[0][1] * y[0] + x[1][1] * y[1]],
  "mul float 3x3 3": (x, y) => [
    x[0][0] * y[0] + x[1][0] * y[1] + x[2][0] * y[2],
    x[0][1] * y[0] + x[1][1] * y[1] + x[2][1] * y[2],
    x[0][2] * y[0] + x[1][2] * y[1] + x[2][2] * y[2],
  ],
  "mul float 4x4 4": (x, y) => [
    x[0][0] * y[0] + x[1][0] * y[1] + x[2][0] * y[2] + x[3][0] * y[3],
    x[0][1] * y[0] + x[1][1] * y[1] + x[2][1] * y[2] + x[3][1] * y[3],
    x[0][2] * y[0] + x[1][2] * y[1] + x[2][2] * y[2] + x[3][2] * y[3],
    x[0][3] * y[0] + x[1][3] * y[1] + x[2][3] * y[2] + x[3][3] * y[3],
  ],
  "mul float 2x2 2x2": (x, y) => [
    [x[0][0] * y[0][0] + x[1][0] * y[0][1], x[0][1] * y[0][0] + x[1][1] * y[0][1]],
    [x[0][0] * y[1][0] + x[1][0] * y[1][1], x[0][1] * y[1][0] + x[1][1] * y[1][1]],
  ],
  "mul float 3x3 3x3": (x, y) => [
    [
      x[0][0] * y[0][0] + x[1][0] * y[0][1] + x[2][0] * y[0][2],
      x[0][1] * y[0][0] + x[1][1] * y[0][1] + x[2][1] * y[0][2],
      x[0][2] * y[0][0] + x[1][2] * y[0][1] + x[2][2] * y[0][2],
    ],
    [
      x[0][0] * y[1][0] + x[1][0] * y[1][1] + x[2][0] * y[1][2],
      x[0][1] * y[1][0] + x[1][1] * y[1][1] + x[2][1] * y[1][2],
      x[0][2] * y[1][0] + x[1][2] * y[1][1] + x[2][2] * y[1][2],
    ],
    [
      x[0][0] * y[2][0] + x[1][0] * y[2][1] + x[2][0] * y[2][2],
      x[0][1] * y[2][0] + x[1][1] * y[2][1] + x[2][1] * y[2][2],
      x[0][2] * y[2][0] + x[1][2] * y[2][1] + x[2][2] * y[2][2],
    ],
  ],
  "mul float 4x4 4x4": (x, y) => [
    [
      x[0][0] * y[0][0] + x[1][0] * y[0][1] + x[2][0] * y[0][2] + x[3][0] * y[0][3],
      x[0][1] * y[0][0] + x[1][1] * y[0][1] + x[2][1] * y[0][2] + x[3][1] * y[0][3],
      x[0][2] * y[0][0] + x[1][2] * y[0][1] + x[2][2] * y[0][2] + x[3][2] * y[0][3],
      x[0][3] * y[0][0] + x[1][3] * y[0][1] + x[2][3] * y[0][2] + x[3][3] * y[0][3],
    ],
    [
      x[0][0] * y[1][0] + x[1][0] * y[1][1] + x[2][0] * y[1][2] + x[3][0] * y[1][3],
      x[0][1] * y[1][0] + x[1][1] * y[1][1] + x[2][1] * y[1][2] + x[3][1] * y[1][3],
      x[0][2] * y[1][0] + x[1][2] * y[1][1] + x[2][2] * y[1][2] + x[3][2] * y[1][3],
      x[0][3] * y[1][0] + x[1][3] * y[1][1] + x[2][3] * y[1][2] + x[3][3] * y[1][3],
    ],
    [
      x[0][0] * y[2][0] + x[1][0] * y[2][1] + x[2][0] * y[2][2] + x[3][0] * y[2][3],
      x[0][1] * y[2][0] + x[1][1] * y[2][1] + x[2][1] * y[2][2] + x[3][1] * y[2][3],
      x[0][2] * y[2][0] + x[1][2] * y[2][1] + x[2][2] * y[2][2] + x[3][2] * y[2][3],
      x[0][3] * y[2][0] + x[1][3] * y[2][1] + x[2][3] * y[2][2] + x[3][3] * y[2][3],
    ],
    [
      x[0][0] * y[3][0] + x[1][0] * y[3][1] + x[2][0] * y[3][2] + x[3][0] * y[3][3],
      x[0][1] * y[3][0] + x[1][1] * y[3][1] + x[2][1] * y[3][2] + x[3][1] * y[3][3],
      x[0][2] * y[3][0] + x[1][2] * y[3][1] + x[2][2] * y[3][2] + x[3][2] * y[3][3],
      x[0][3] * y[3][0] + x[1][3] * y[3][1] + x[2][3] * y[3][2] + x[3][3] * y[3][3],
    ],
  ],
  "mul float 2x2 1": (x, y) => [
    [x[0][0] * y[0], x[0][1] * y[0]],
    [x[1][0] * y[0], x[1][1] * y[0]],
  ],
  "mul float 3x3 1": (x, y) => [
    [x[0][0] * y[0], x[0][1] * y[0], x[0][2] * y[0]],
    [x[1][0] * y[0], x[1][1] * y[0], x[1][2] * y[0]],
    [x[2][0] * y[0], x[2][1] * y[0], x[2][2] * y[0]],
  ],
  "mul float 4x4 1": (x, y) => [
    [x[0][0] * y[0], x[0][1] * y[0], x[0][2] * y[0], x[0][3] * y[0]],
    [x[1][0] * y[0], x[1][1] * y[0], x[1][2] * y[0], x[1][3] * y[0]],
    [x[2][0] * y[0], x[2][1] * y[0], x[2][2] * y[0], x[2][3] * y[0]],
    [x[3][0] * y[0], x[3][1] * y[0], x[3][2] * y[0], x[3][3] * y[0]],
  ],
  "mul float 1 2x2": (x, y) => [
    [y[0][0] * x[0], y[0][1] * x[0]],
    [y[1][0] * x[0], y[1][1] * x[0]],
  ],
  "mul float 1 3x3": (x, y) => [
    [y[0][0] * x[0], y[0][1] * x[0], y[0][2] * x[0]],
    [y[1][0] * x[0], y[1][1] * x[0], y[1][2] * x[0]],
    [y[2][0] * x[0], y[2][1] * x[0], y[2][2] * x[0]],
  ],
  "mul float 1 4x4": (x, y) => [
    [y[0][0] * x[0], y[0][1] * x[0], y[0][2] * x[0], y[0][3] * x[0]],
    [y[1][0] * x[0], y[1][1] * x[0], y[1][2] * x[0], y[1][3] * x[0]],
    [y[2][0] * x[0], y[2][1] * x[0], y[2][2] * x[0], y[2][3] * x[0]],
    [y[3][0] * x[0], y[3][1] * x[0], y[3][2] * x[0], y[3][3] * x[0]],
  ],
  "neg float 2x2": (x) => [
    [-x[0][0], -x[0][1]],
    [-x[1][0], -x[1][1]],
  ],
  "neg float 3x3": (x) => [
    [-x[0][0], -x[0][1], -x[0][2]],
    [-x[1][0], -x[1][1], -x[1][2]],
    [-x[2][0], -x[2][1], -x[2][2]],
  ],
  "neg float 4x4": (x) => [
    [-x[0][0], -x[0][1], -x[0][2], -x[0][3]],
    [-x[1][0], -x[1][1], -x[1][2], -x[1][3]],
    [-x[2][0], -x[2][1], -x[2][2], -x[2][3]],
    [-x[3][0], -x[3][1], -x[3][2], -x[3][3]],
  ],
  "any bool 2": (x) => [Number(x[0] || x[1])],
  "any bool 3": (x) => [Number(x[0] || x[1] || x[2])],
  "any bool 4": (x) => [Number(x[0] || x[1] || x[2] || x[3])],
  "all bool 2": (x) => [Number(x[0] && x[1])],
  "all bool 3": (x) => [Number(x[0] && x[1] && x[2])],
  "all bool 4": (x) => [Number(x[0] && x[1] && x[2] && x[3])],
  "dot float 2 2": (x, y) => [x[0] * y[0] + x[1] * y[1]],
  "dot float 3 3": (x, y) => [x[0] * y[0] + x[1] * y[1] + x[2] * y[2]],
  "dot float 4 4": (x, y) => [x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3]],
  "dot int 2 2": (x, y) => [(Math.imul(x[0], y[0]) + Math.imul(x[1], y[1])) | 0],
  "dot int 3 3": (x, y) => [
    (Math.imul(x[0], y[0]) + Math.imul(x[1], y[1]) + Math.imul(x[2], y[2])) | 0,
  ],
  "dot int 4 4": (x, y) => [
    (Math.imul(x[0], y[0]) +
      Math.imul(x[1], y[1]) +
      Math.imul(x[2], y[2]) +
      Math.imul(x[3], y[3])) |
      0,
  ],
  "dot uint 2 2": (x, y) => [(Math.imul(x[0], y[0]) + Math.imul(x[1], y[1])) >>> 0],
  "dot uint 3 3": (x, y) => [
    (Math.imul(x[0], y[0]) + Math.imul(x[1], y[1]) + Math.imul(x[2], y[2])) >>> 0,
  ],
  "dot uint 4 4": (x, y) => [
    (Math.imul(x[0], y[0]) +
      Math.imul(x[1], y[1]) +
      Math.imul(x[2], y[2]) +
      Math.imul(x[3], y[3])) >>>
      0,
  ],
  "cross float 3 3": (x, y) => [
    x[1] * y[2] - x[2] * y[1],
    x[2] * y[0] - x[0] * y[2],
    x[0] * y[1] - x[1] * y[0],
  ],
  "length float 2": (x) => [Math.sqrt(x[0] * x[0] + x[1] * x[1])],
  "length float 3": (x) => [Math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])],
  "length float 4": (x) => [Math.sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3])],
  "distance float 2 2": (x, y) => {
    const v0 = x[0] - y[0];
    const v1 = x[1] - y[1];
    return [Math.sqrt(v0 * v0 + v1 * v1)];
  },
  "distance float 3 3": (x, y) => {
    const v0 = x[0] - y[0];
    const v1 = x[1] - y[1];
    const v2 = x[2] - y[2];
    return [Math.sqrt(v0 * v0 + v1 * v1 + v2 * v2)];
  },
  "distance float 4 4": (x, y) => {
    const v0 = x[0] - y[0];
    const v1 = x[1] - y[1];
    const v2 = x[2] - y[2];
    const v3 = x[3] - y[3];
    return [Math.sqrt(v0 * v0 + v1 * v1 + v2 * v2 + v3 * v3)];
  },
  "normalize float 2": (x) => {
    const v0 = 1 / Math.sqrt(Math.max(x[0] * x[0] + x[1] * x[1], 1.1754943508222875e-38));
    return [x[0] * v0, x[1] * v0];
  },
  "normalize float 3": (x) => {
    const v0 =
      1 / Math.sqrt(Math.max(x[0] * x[0] + x[1] * x[1] + x[2] * x[2], 1.1754943508222875e-38));
    return [x[0] * v0, x[1] * v0, x[2] * v0];
  },
  "normalize float 4": (x) => {
    const v0 =
      1 /
      Math.sqrt(
        Math.max(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3], 1.1754943508222875e-38),
      );
    return [x[0] * v0, x[1] * v0, x[2] * v0, x[3] * v0];
  },
  "nonzero float 2": (x) => [x[0], x[1]],
  "nonzero float 3": (x) => [x[0], x[1], x[2]],
  "nonzero float 4": (x) => [x[0], x[1], x[2], x[3]],
  "reflect float 2 2": (x, y) => {
    const v0 = 2 * (y[0] * x[0] + y[1] * x[1]);
    return [x[0] - v0 * y[0], x[1] - v0 * y[1]];
  },
  "reflect float 3 3": (x, y) => {
    const v0 = 2 * (y[0] * x[0] + y[1] * x[1] + y[2] * x[2]);
    return [x[0] - v0 * y[0], x[1] - v0 * y[1], x[2] - v0 * y[2]];
  },
  "reflect float 4 4": (x, y) => {
    const v0 = 2 * (y[0] * x[0] + y[1] * x[1] + y[2] * x[2] + y[3] * x[3]);
    return [x[0] - v0 * y[0], x[1] - v0 * y[1], x[2] - v0 * y[2], x[3] - v0 * y[3]];
  },
  "refract float 2 2 1": (x, y, z) => {
    const v0 = y[0] * x[0] + y[1] * x[1];
    const v1 = 1 - z[0] * z[0] * (1 - v0 * v0);
    const v2 = v1 < 0;
    const v3 = z[0] * v0 + Math.sqrt(Math.max(v1, 0));
    return [v2 ? 0 : z[0] * x[0] - v3 * y[0], v2 ? 0 : z[0] * x[1] - v3 * y[1]];
  },
  "refract float 3 3 1": (x, y, z) => {
    const v0 = y[0] * x[0] + y[1] * x[1] + y[2] * x[2];
    const v1 = 1 - z[0] * z[0] * (1 - v0 * v0);
    const v2 = v1 < 0;
    const v3 = z[0] * v0 + Math.sqrt(Math.max(v1, 0));
    return [
      v2 ? 0 : z[0] * x[0] - v3 * y[0],
      v2 ? 0 : z[0] * x[1] - v3 * y[1],
      v2 ? 0 : z[0] * x[2] - v3 * y[2],
    ];
  },
  "refract float 4 4 1": (x, y, z) => {
    const v0 = y[0] * x[0] + y[1] * x[1] + y[2] * x[2] + y[3] * x[3];
    const v1 = 1 - z[0] * z[0] * (1 - v0 * v0);
    const v2 = v1 < 0;
    const v3 = z[0] * v0 + Math.sqrt(Math.max(v1, 0));
    return [
      v2 ? 0 : z[0] * x[0] - v3 * y[0],
      v2 ? 0 : z[0] * x[1] - v3 * y[1],
      v2 ? 0 : z[0] * x[2] - v3 * y[2],
      v2 ? 0 : z[0] * x[3] - v3 * y[3],
    ];
  },
  "faceforward float 2 2 2": (x, y, z) => {
    const v0 = z[0] * y[0] + z[1] * y[1] < 0;
    return [v0 ? x[0] : -x[0], v0 ? x[1] : -x[1]];
  },
  "faceforward float 3 3 3": (x, y, z) => {
    const v0 = z[0] * y[0] + z[1] * y[1] + z[2] * y[2] < 0;
    return [v0 ? x[0] : -x[0], v0 ? x[1] : -x[1], v0 ? x[2] : -x[2]];
  },
  "faceforward float 4 4 4": (x, y, z) => {
    const v0 = z[0] * y[0] + z[1] * y[1] + z[2] * y[2] + z[3] * y[3] < 0;
    return [v0 ? x[0] : -x[0], v0 ? x[1] : -x[1], v0 ? x[2] : -x[2], v0 ? x[3] : -x[3]];
  },
  "lit float 1 1 1": (x, y, z) => {
    const v0 = y[0] < 1.1754943508222875e-38;
    return [
      1,
      Math.max(x[0], 0),
      x[0] < 0 || y[0] < 0
        ? 0
        : v0 && z[0] < 1.1754943508222875e-38
          ? Math.abs(z[0]) < 1.1754943508222875e-38
            ? 1
            : 0
          : Math.pow(v0 ? 0 : y[0], z[0]),
      1,
    ];
  },
  "transpose float 2x2": (x) => [
    [x[0][0], x[1][0]],
    [x[0][1], x[1][1]],
  ],
  "transpose float 3x3": (x) => [
    [x[0][0], x[1][0], x[2][0]],
    [x[0][1], x[1][1], x[2][1]],
    [x[0][2], x[1][2], x[2][2]],
  ],
  "transpose float 4x4": (x) => [
    [x[0][0], x[1][0], x[2][0], x[3][0]],
    [x[0][1], x[1][1], x[2][1], x[3][1]],
    [x[0][2], x[1][2], x[2][2], x[3][2]],
    [x[0][3], x[1][3], x[2][3], x[3][3]],
  ],
  "determinant float 2x2": (x) => [x[0][0] * x[1][1] + x[0][1] * -x[1][0]],
  "determinant float 3x3": (x) => {
    const v0 = -x[2][0];
    return [
      x[0][0] * (x[1][1] * x[2][2] + x[1][2] * -x[2][1]) +
        x[0][1] * -(x[1][0] * x[2][2] + x[1][2] * v0) +
        x[0][2] * (x[1][0] * x[2][1] + x[1][1] * v0),
    ];
  },
  "determinant float 4x4": (x) => {
    const v0 = x[2][2] * x[3][3] + x[2][3] * -x[3][2];
    const v1 = -x[3][1];
    const v2 = x[2][1] * x[3][3] + x[2][3] * v1;
    const v3 = x[2][1] * x[3][2] + x[2][2] * v1;
    const v4 = -x[3][0];
    const v5 = -(x[2][0] * x[3][3] + x[2][3] * v4);
    const v6 = x[2][0] * x[3][2] + x[2][2] * v4;
    const v7 = x[2][0] * x[3][1] + x[2][1] * v4;
    return [
      x[0][0] * (x[1][1] * v0 + x[1][2] * -v2 + x[1][3] * v3) +
        x[0][1] * -(x[1][0] * v0 + x[1][2] * v5 + x[1][3] * v6) +
        x[0][2] * (x[1][0] * v2 + x[1][1] * v5 + x[1][3] * v7) +
        x[0][3] * -(x[1][0] * v3 + x[1][1] * -v6 + x[1][2] * v7),
    ];
  },
  "outer float 2 2": (x, y) => [
    [x[0] * y[0], x[1] * y[0]],
    [x[0] * y[1], x[1] * y[1]],
  ],
  "outer float 3 3": (x, y) => [
    [x[0] * y[0], x[1] * y[0], x[2] * y[0]],
    [x[0] * y[1], x[1] * y[1], x[2] * y[1]],
    [x[0] * y[2], x[1] * y[2], x[2] * y[2]],
  ],
  "outer float 4 4": (x, y) => [
    [x[0] * y[0], x[1] * y[0], x[2] * y[0], x[3] * y[0]],
    [x[0] * y[1], x[1] * y[1], x[2] * y[1], x[3] * y[1]],
    [x[0] * y[2], x[1] * y[2], x[2] * y[2], x[3] * y[2]],
    [x[0] * y[3], x[1] * y[3], x[2] * y[3], x[3] * y[3]],
  ],
  "hadamard float 2x2 2x2": (x, y) => [
    [x[0][0] * y[0][0], x[0][1] * y[0][1]],
    [x[1][0] * y[1][0], x[1][1] * y[1][1]],
  ],
  "hadamard float 3x3 3x3": (x, y) => [
    [x[0][0] * y[0][0], x[0][1] * y[0][1], x[0][2] * y[0][2]],
    [x[1][0] * y[1][0], x[1][1] * y[1][1], x[1][2] * y[1][2]],
    [x[2][0] * y[2][0], x[2][1] * y[2][1], x[2][2] * y[2][2]],
  ],
  "hadamard float 4x4 4x4": (x, y) => [
    [x[0][0] * y[0][0], x[0][1] * y[0][1], x[0][2] * y[0][2], x[0][3] * y[0][3]],
    [x[1][0] * y[1][0], x[1][1] * y[1][1], x[1][2] * y[1][2], x[1][3] * y[1][3]],
    [x[2][0] * y[2][0], x[2][1] * y[2][1], x[2][2] * y[2][2], x[2][3] * y[2][3]],
    [x[3][0] * y[3][0], x[3][1] * y[3][1], x[3][2] * y[3][2], x[3][3] * y[3][3]],
  ],
  "inverse float 2x2": (x) => {
    const v0 = -x[1][0];
    const v1 = x[0][0] * x[1][1] + x[0][1] * v0;
    const v2 = Math.abs(v1) < 1.1754943508222875e-38;
    const v3 = v2 ? 0 : 1 / (v2 ? 1 : v1);
    return [
      [x[1][1] * v3, -x[0][1] * v3],
      [v0 * v3, x[0][0] * v3],
    ];
  },
  "inverse float 3x3": (x) => {
    const v0 = -x[2][1];
    const v1 = x[1][1] * x[2][2] + x[1][2] * v0;
    const v2 = -x[2][0];
    const v3 = -(x[1][0] * x[2][2] + x[1][2] * v2);
    const v4 = x[1][0] * x[2][1] + x[1][1] * v2;
    const v5 = x[0][0] * v1 + x[0][1] * v3 + x[0][2] * v4;
    const v6 = Math.abs(v5) < 1.1754943508222875e-38;
    const v7 = v6 ? 0 : 1 / (v6 ? 1 : v5);
    const v8 = -x[1][0];
    return [
      [
        v1 * v7,
        -(x[0][1] * x[2][2] + x[0][2] * v0) * v7,
        (x[0][1] * x[1][2] + x[0][2] * -x[1][1]) * v7,
      ],
      [v3 * v7, (x[0][0] * x[2][2] + x[0][2] * v2) * v7, -(x[0][0] * x[1][2] + x[0][2] * v8) * v7],
      [v4 * v7, -(x[0][0] * x[2][1] + x[0][1] * v2) * v7, (x[0][0] * x[1][1] + x[0][1] * v8) * v7],
    ];
  },
  "inverse float 4x4": (x) => {
    const v0 = -x[3][2];
    const v1 = x[2][2] * x[3][3] + x[2][3] * v0;
    const v2 = -x[3][1];
    const v3 = x[2][1] * x[3][3] + x[2][3] * v2;
    const v4 = -v3;
    const v5 = x[2][1] * x[3][2] + x[2][2] * v2;
    const v6 = x[1][1] * v1 + x[1][2] * v4 + x[1][3] * v5;
    const v7 = -x[3][0];
    const v8 = -(x[2][0] * x[3][3] + x[2][3] * v7);
    const v9 = x[2][0] * x[3][2] + x[2][2] * v7;
    const v10 = -(x[1][0] * v1 + x[1][2] * v8 + x[1][3] * v9);
    const v11 = x[2][0] * x[3][1] + x[2][1] * v7;
    const v12 = x[1][0] * v3 + x[1][1] * v8 + x[1][3] * v11;
    const v13 = -v9;
    const v14 = -(x[1][0] * v5 + x[1][1] * v13 + x[1][2] * v11);
    const v15 = x[0][0] * v6 + x[0][1] * v10 + x[0][2] * v12 + x[0][3] * v14;
    const v16 = Math.abs(v15) < 1.1754943508222875e-38;
    const v17 = v16 ? 0 : 1 / (v16 ? 1 : v15);
    const v18 = x[1][2] * x[3][3] + x[1][3] * v0;
    const v19 = x[1][1] * x[3][3] + x[1][3] * v2;
    const v20 = x[1][1] * x[3][2] + x[1][2] * v2;
    const v21 = x[1][2] * x[2][3] + x[1][3] * -x[2][2];
    const v22 = -x[2][1];
    const v23 = x[1][1] * x[2][3] + x[1][3] * v22;
    const v24 = x[1][1] * x[2][2] + x[1][2] * v22;
    const v25 = -(x[1][0] * x[3][3] + x[1][3] * v7);
    const v26 = x[1][0] * x[3][2] + x[1][2] * v7;
    const v27 = -x[2][0];
    const v28 = -(x[1][0] * x[2][3] + x[1][3] * v27);
    const v29 = x[1][0] * x[2][2] + x[1][2] * v27;
    const v30 = x[1][0] * x[3][1] + x[1][1] * v7;
    const v31 = x[1][0] * x[2][1] + x[1][1] * v27;
    return [
      [
        v6 * v17,
        -(x[0][1] * v1 + x[0][2] * v4 + x[0][3] * v5) * v17,
        (x[0][1] * v18 + x[0][2] * -v19 + x[0][3] * v20) * v17,
        -(x[0][1] * v21 + x[0][2] * -v23 + x[0][3] * v24) * v17,
      ],
      [
        v10 * v17,
        (x[0][0] * v1 + x[0][2] * v8 + x[0][3] * v9) * v17,
        -(x[0][0] * v18 + x[0][2] * v25 + x[0][3] * v26) * v17,
        (x[0][0] * v21 + x[0][2] * v28 + x[0][3] * v29) * v17,
      ],
      [
        v12 * v17,
        -(x[0][0] * v3 + x[0][1] * v8 + x[0][3] * v11) * v17,
        (x[0][0] * v19 + x[0][1] * v25 + x[0][3] * v30) * v17,
        -(x[0][0] * v23 + x[0][1] * v28 + x[0][3] * v31) * v17,
      ],
      [
        v14 * v17,
        (x[0][0] * v5 + x[0][1] * v13 + x[0][2] * v11) * v17,
        -(x[0][0] * v20 + x[0][1] * -v26 + x[0][2] * v30) * v17,
        (x[0][0] * v24 + x[0][1] * -v29 + x[0][2] * v31) * v17,
      ],
    ];
  },
  "pack_unorm4x8 float 4": (x) => [
    (((((((whole(nearest(Math.min(Math.max(x[0], 0), 1) * 255)) & 255) >>> 0) |
      (((whole(nearest(Math.min(Math.max(x[1], 0), 1) * 255)) & 255) >>> 0) * 2 ** 8)) >>>
      0) |
      (((whole(nearest(Math.min(Math.max(x[2], 0), 1) * 255)) & 255) >>> 0) * 2 ** 16)) >>>
      0) |
      (((whole(nearest(Math.min(Math.max(x[3], 0), 1) * 255)) & 255) >>> 0) * 2 ** 24)) >>>
      0,
  ],
  "pack_snorm4x8 float 4": (x) => [
    (((((((whole(nearest(Math.min(Math.max(x[0], -1), 1) * 127)) & 255) >>> 0) |
      (((whole(nearest(Math.min(Math.max(x[1], -1), 1) * 127)) & 255) >>> 0) * 2 ** 8)) >>>
      0) |
      (((whole(nearest(Math.min(Math.max(x[2], -1), 1) * 127)) & 255) >>> 0) * 2 ** 16)) >>>
      0) |
      (((whole(nearest(Math.min(Math.max(x[3], -1), 1) * 127)) & 255) >>> 0) * 2 ** 24)) >>>
      0,
  ],
  "pack_unorm2x16 float 2": (x) => [
    (((whole(nearest(Math.min(Math.max(x[0], 0), 1) * 65535)) & 65535) >>> 0) |
      (((whole(nearest(Math.min(Math.max(x[1], 0), 1) * 65535)) & 65535) >>> 0) * 2 ** 16)) >>>
      0,
  ],
  "pack_snorm2x16 float 2": (x) => [
    (((whole(nearest(Math.min(Math.max(x[0], -1), 1) * 32767)) & 65535) >>> 0) |
      (((whole(nearest(Math.min(Math.max(x[1], -1), 1) * 32767)) & 65535) >>> 0) * 2 ** 16)) >>>
      0,
  ],
  "pack_half2x16 float 2": (x) => {
    const v0 = Math.min(Math.abs(x[0]), 65504);
    const v1 =
      v0 < 6.103515625e-5
        ? whole(nearest(v0 * 16777216))
        : (whole(exponentOf(v0)) + 14) * 2 ** 10 + whole(nearest(fractionOf(v0) * 2048)) - 1024;
    const v2 = Math.min(Math.abs(x[1]), 65504);
    const v3 =
      v2 < 6.103515625e-5
        ? whole(nearest(v2 * 16777216))
        : (whole(exponentOf(v2)) + 14) * 2 ** 10 + whole(nearest(fractionOf(v2) * 2048)) - 1024;
    return [
      ((((x[0] < 0 && v1 > 0 ? v1 | 32768 : v1) & 65535) >>> 0) |
        ((((x[1] < 0 && v3 > 0 ? v3 | 32768 : v3) & 65535) >>> 0) * 2 ** 16)) >>>
        0,
    ];
  },
  "unpack_unorm4x8 uint 1": (x) => [
    ((x[0] & 255) >>> 0) / 255,
    ((Math.floor(x[0] / 2 ** 8) & 255) >>> 0) / 255,
    ((Math.floor(x[0] / 2 ** 16) & 255) >>> 0) / 255,
    ((Math.floor(x[0] / 2 ** 24) & 255) >>> 0) / 255,
  ],
  "unpack_snorm4x8 uint 1": (x) => [
    Math.max((((((x[0] & 255) >>> 0) ^ 128) >>> 0) - 128) / 127, -1),
    Math.max((((((Math.floor(x[0] / 2 ** 8) & 255) >>> 0) ^ 128) >>> 0) - 128) / 127, -1),
    Math.max((((((Math.floor(x[0] / 2 ** 16) & 255) >>> 0) ^ 128) >>> 0) - 128) / 127, -1),
    Math.max((((((Math.floor(x[0] / 2 ** 24) & 255) >>> 0) ^ 128) >>> 0) - 128) / 127, -1),
  ],
  "unpack_unorm2x16 uint 1": (x) => [
    ((x[0] & 65535) >>> 0) / 65535,
    ((Math.floor(x[0] / 2 ** 16) & 65535) >>> 0) / 65535,
  ],
  "unpack_snorm2x16 uint 1": (x) => [
    Math.max((((((x[0] & 65535) >>> 0) ^ 32768) >>> 0) - 32768) / 32767, -1),
    Math.max((((((Math.floor(x[0] / 2 ** 16) & 65535) >>> 0) ^ 32768) >>> 0) - 32768) / 32767, -1),
  ],
  "unpack_half2x16 uint 1": (x) => {
    const v0 = (x[0] & 65535) >>> 0;
    const v1 = (Math.floor(v0 / 2 ** 10) & 31) >>> 0;
    const v2 = (v0 & 1023) >>> 0;
    const v3 = v1 === 0 ? v2 * 5.960464477539063e-8 : v1 === 31 ? 0 : (v2 + 1024) * 2 ** (v1 - 25);
    const v4 = (Math.floor(x[0] / 2 ** 16) & 65535) >>> 0;
    const v5 = (Math.floor(v4 / 2 ** 10) & 31) >>> 0;
    const v6 = (v4 & 1023) >>> 0;
    const v7 = v5 === 0 ? v6 * 5.960464477539063e-8 : v5 === 31 ? 0 : (v6 + 1024) * 2 ** (v5 - 25);
    return [(v0 & 32768) >>> 0 === 0 ? v3 : -v3, (v4 & 32768) >>> 0 === 0 ? v7 : -v7];
  },
};
