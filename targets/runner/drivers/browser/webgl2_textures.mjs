// Textures and samplers from a job.

import { bytes, levelSize } from "./answers.mjs";

const WRAPS = { repeat: "REPEAT", clamp: "CLAMP_TO_EDGE", mirror: "MIRRORED_REPEAT" };
const STORAGE = {
  "rgba8unorm": ["RGBA8", "UNSIGNED_BYTE", Uint8Array],
  "rgba8unorm-srgb": ["SRGB8_ALPHA8", "UNSIGNED_BYTE", Uint8Array],
  "rgba32float": ["RGBA32F", "FLOAT", Float32Array],
};

/** A texture with all levels of an image, bound to a unit.
 *
 * OpenGL counts rows from v = 0, and so does Burnish: the rows go up as they are.
 */
export function bindTexture(gl, unit, image) {
  const [storage, kind, Lanes] = STORAGE[image.format];
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, image.levels.length, gl[storage], image.width, image.height);
  image.levels.forEach((texels, level) => {
    const size = levelSize(image, level);
    const lanes = new Lanes(bytes(texels).buffer);
    gl.texSubImage2D(gl.TEXTURE_2D, level, 0, 0, ...size, gl.RGBA, gl[kind], lanes);
  });
  return texture;
}

/** A sampler as the slot wants it, bound to a unit. */
export function bindSampler(gl, unit, { filter, mip, wrap }) {
  const sampler = gl.createSampler();
  const name = filter.toUpperCase();
  const minify = mip === "none" ? name : `${name}_MIPMAP_${mip.toUpperCase()}`;
  gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, gl[name]);
  gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, gl[minify]);
  gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_S, gl[WRAPS[wrap]]);
  gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_T, gl[WRAPS[wrap]]);
  gl.bindSampler(unit, sampler);
  return sampler;
}
