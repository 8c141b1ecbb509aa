// Creates the textures and samplers of a job.

import { bytes, levelSize } from "./answers.mjs";

const WRAPS = { repeat: "REPEAT", clamp: "CLAMP_TO_EDGE", mirror: "MIRRORED_REPEAT" };
const TARGETS = {
  "2d": "TEXTURE_2D",
  "2d_array": "TEXTURE_2D_ARRAY",
  "3d": "TEXTURE_3D",
  "cube": "TEXTURE_CUBE_MAP",
};
// The internal format of each format, and its bytes: lanes, type, and an array of that type.
const STORAGE = {
  "rgba8unorm": ["RGBA8", "RGBA", "UNSIGNED_BYTE", Uint8Array],
  "rgba8unorm-srgb": ["SRGB8_ALPHA8", "RGBA", "UNSIGNED_BYTE", Uint8Array],
  "rgba32float": ["RGBA32F", "RGBA", "FLOAT", Float32Array],
  "depth32float": ["DEPTH_COMPONENT32F", "DEPTH_COMPONENT", "FLOAT", Float32Array],
  "r8uint": ["R8UI", "RED_INTEGER", "UNSIGNED_BYTE", Uint8Array],
  "rgba8uint": ["RGBA8UI", "RGBA_INTEGER", "UNSIGNED_BYTE", Uint8Array],
  "r32uint": ["R32UI", "RED_INTEGER", "UNSIGNED_INT", Uint32Array],
  "rgba32uint": ["RGBA32UI", "RGBA_INTEGER", "UNSIGNED_INT", Uint32Array],
  "r32sint": ["R32I", "RED_INTEGER", "INT", Int32Array],
  "rgba32sint": ["RGBA32I", "RGBA_INTEGER", "INT", Int32Array],
};
export const COMPARES = {
  never: "NEVER", less: "LESS", equal: "EQUAL", less_equal: "LEQUAL",
  greater: "GREATER", not_equal: "NOTEQUAL", greater_equal: "GEQUAL", always: "ALWAYS",
};

/** A texture with all levels of an image, bound to a unit.
 *
 * OpenGL counts rows from v = 0, as Burnish does, so the rows are uploaded in their order.
 */
export function bindTexture(gl, unit, image) {
  const target = gl[TARGETS[image.dimension]];
  const storage = gl[STORAGE[image.format][0]];
  const [width, height, depth] = levelSize(image, 0);
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(target, texture);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  if (image.dimension === "2d" || image.dimension === "cube") {
    gl.texStorage2D(target, image.levels.length, storage, width, height);
  } else {
    gl.texStorage3D(target, image.levels.length, storage, width, height, depth);
  }
  image.levels.forEach((_, level) => upload(gl, target, image, level));
  return texture;
}

function upload(gl, target, image, level) {
  const [, lanes, kind, Lanes] = STORAGE[image.format];
  const [width, height, depth] = levelSize(image, level);
  const texels = new Lanes(bytes(image.levels[level]).buffer);
  const area = [width, height];
  const what = [gl[lanes], gl[kind]];
  if (image.dimension === "2d") {
    gl.texSubImage2D(target, level, 0, 0, ...area, ...what, texels);
  } else if (image.dimension === "cube") {
    const size = texels.length / depth;
    for (let face = 0; face < depth; face++) {
      const part = texels.subarray(face * size, (face + 1) * size);
      gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, level, 0, 0, ...area, ...what, part);
    }
  } else {
    gl.texSubImage3D(target, level, 0, 0, 0, ...area, depth, ...what, texels);
  }
}

/** The sampler of a slot, bound to a unit; if the slot has none, it must not filter. */
export function bindSampler(gl, unit, { filter, mip, wrap, compare, sampling }) {
  const sampler = gl.createSampler();
  const set = (name, value) => gl.samplerParameteri(sampler, gl[name], gl[value]);
  const name = sampling === null ? "NEAREST" : filter.toUpperCase();
  const between = mip === "linear" && sampling !== null ? "LINEAR" : "NEAREST";
  set("TEXTURE_MAG_FILTER", name);
  set("TEXTURE_MIN_FILTER", `${name}_MIPMAP_${between}`);
  set("TEXTURE_WRAP_S", WRAPS[wrap]);
  set("TEXTURE_WRAP_T", WRAPS[wrap]);
  set("TEXTURE_WRAP_R", WRAPS[wrap]);
  // The texels of other levels can still be loaded.
  if (mip === "none") gl.samplerParameterf(sampler, gl.TEXTURE_MAX_LOD, 0);
  if (compare !== null) {
    set("TEXTURE_COMPARE_MODE", "COMPARE_REF_TO_TEXTURE");
    set("TEXTURE_COMPARE_FUNC", COMPARES[compare]);
  }
  gl.bindSampler(unit, sampler);
  return sampler;
}
