// Textures of WebGL 2: those that frames draw to, and pictures of the host.

import { bytesOf, halved, isDepth, hasStencil } from "../bytes.js";
import { present } from "../present.js";

/**
 * @import { PictureRow, SamplerRow } from "../generated/documents.js"
 * @import { TextureSize } from "../renderer.js"
 * @import { Context, Gl } from "./context.js"
 */

/**
 * `layers` are the slices of a first level, if it has three dimensions.
 * `gl` is a renderbuffer where it has several samples: WebGL has no such textures. `sides` are the
 * texels of its first level in each direction, as shaders see them.
 * @typedef {Omit<TextureSize, "uses" | "dimension"> & {
 *   dimension: PictureRow["dimension"],
 *   gl: WebGLTexture | WebGLRenderbuffer,
 *   sides: number[],
 * }} Texture
 */

/** @typedef {"TEXTURE_2D" | "TEXTURE_2D_ARRAY" | "TEXTURE_3D" | "TEXTURE_CUBE_MAP"} Bind */
/** WebGL has no arrays of cubes. @type {Partial<Record<PictureRow["dimension"], Bind>>} */
const BINDS = {
  "2d": "TEXTURE_2D", "2d-array": "TEXTURE_2D_ARRAY", "3d": "TEXTURE_3D", cube: "TEXTURE_CUBE_MAP",
};
/**
 * The texels beyond the edges. WebGL has no borders, and no text for it reads a texture with one.
 * @typedef {Exclude<SamplerRow["state"]["wrap"], "clamp-to-border">} AddressMode
 */
/** @type {Record<AddressMode, "REPEAT" | "CLAMP_TO_EDGE" | "MIRRORED_REPEAT">} */
const WRAPS = {
  "repeat": "REPEAT", "clamp-to-edge": "CLAMP_TO_EDGE", "mirror-repeat": "MIRRORED_REPEAT",
};

/**
 * How WebGL stores each format, and in which lanes and numbers texels are brought there.
 * @type {Partial<Record<GPUTextureFormat, [string, string, string]>>}
 */
const STORAGE = {
  "r8unorm": ["R8", "RED", "UNSIGNED_BYTE"],
  "rg8unorm": ["RG8", "RG", "UNSIGNED_BYTE"],
  "rgba8unorm": ["RGBA8", "RGBA", "UNSIGNED_BYTE"],
  "rgba8unorm-srgb": ["SRGB8_ALPHA8", "RGBA", "UNSIGNED_BYTE"],
  "r16float": ["R16F", "RED", "HALF_FLOAT"],
  "rg16float": ["RG16F", "RG", "HALF_FLOAT"],
  "rgba16float": ["RGBA16F", "RGBA", "HALF_FLOAT"],
  "r32float": ["R32F", "RED", "FLOAT"],
  "rg32float": ["RG32F", "RG", "FLOAT"],
  "rgba32float": ["RGBA32F", "RGBA", "FLOAT"],
  "depth32float": ["DEPTH_COMPONENT32F", "DEPTH_COMPONENT", "FLOAT"],
  "depth32float-stencil8": ["DEPTH32F_STENCIL8", "DEPTH_STENCIL", "FLOAT_32_UNSIGNED_INT_24_8_REV"],
  "r8uint": ["R8UI", "RED_INTEGER", "UNSIGNED_BYTE"],
  "rgba8uint": ["RGBA8UI", "RGBA_INTEGER", "UNSIGNED_BYTE"],
  "r32uint": ["R32UI", "RED_INTEGER", "UNSIGNED_INT"],
  "rgba32uint": ["RGBA32UI", "RGBA_INTEGER", "UNSIGNED_INT"],
  "r32sint": ["R32I", "RED_INTEGER", "INT"],
  "rgba32sint": ["RGBA32I", "RGBA_INTEGER", "INT"],
};

/** @type {(gl: Gl, name: string) => number} */
const constant = (gl, name) => /** @type {number} */ (gl[/** @type {keyof Gl} */ (name)]);

/** @type {(gl: Gl, dimension: PictureRow["dimension"]) => number} */
export const bindOf = (gl, dimension) => {
  const bind = BINDS[dimension];
  if (!bind) throw new Error(`WebGL 2 has no textures of dimension ${dimension}`);
  return gl[bind];
};

/**
 * @param {Context} context
 * @param {Omit<Texture, "gl">} made
 * @returns {Texture}
 */
function allocate(context, made) {
  const { gl } = context;
  const { format, dimension, width, height, layers, levels, samples } = made;
  const storage = STORAGE[format];
  if (!storage) throw new Error(`WebGL 2 has no textures of ${format}`);
  if (samples > 1) return { ...made, gl: renderbuffer(gl, made, constant(gl, storage[0])) };
  const texture = gl.createTexture();
  const bind = bindOf(gl, dimension);
  gl.bindTexture(bind, texture);
  if (dimension === "2d" || dimension === "cube") {
    gl.texStorage2D(bind, levels, constant(gl, storage[0]), width, height);
  } else {
    gl.texStorage3D(bind, levels, constant(gl, storage[0]), width, height, layers);
  }
  return { ...made, gl: texture };
}

/**
 * @param {Gl} gl
 * @param {Omit<Texture, "gl">} made
 * @param {number} storage
 * @returns {WebGLRenderbuffer}
 */
function renderbuffer(gl, { format, width, height, samples }, storage) {
  /** @type {Int32Array} */
  const counts = gl.getInternalformatParameter(gl.RENDERBUFFER, storage, gl.SAMPLES);
  if (!counts.includes(samples)) {
    throw new Error(`this device has no ${samples} samples of ${format} in WebGL 2`);
  }
  const made = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, made);
  gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, storage, width, height);
  return made;
}

/**
 * @param {Gl} gl
 * @param {Texture} texture
 */
export function freeTexture(gl, { gl: texture, samples }) {
  if (samples > 1) gl.deleteRenderbuffer(texture);
  else gl.deleteTexture(texture);
}

/**
 * A texture that is transparent black, as WebGL makes all of them, or as far away as can be.
 * @param {Context} context
 * @param {TextureSize} size
 * @returns {Texture}
 */
export function makeTexture(context, size) {
  const { uses: _, ...row } = size;
  const { format, width, height } = row;
  if (format.endsWith("float") && !isDepth(format)) {
    context.need("EXT_color_buffer_float", `draw to textures of ${format}`);
  }
  const made = allocate(context, { ...row, sides: [width, height] });
  if (isDepth(format)) clearDepths(context.gl, made);
  return made;
}

/**
 * @param {Gl} gl
 * @param {Texture} texture
 */
function clearDepths(gl, texture) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.depthMask(true);
  gl.stencilMask(0xff);
  gl.disable(gl.SCISSOR_TEST);
  for (let level = 0; level < texture.levels; level++) {
    for (let layer = 0; layer < texture.layers; layer++) {
      attach(gl, gl.FRAMEBUFFER, depthPoint(gl, texture.format), texture, layer, level);
      if (hasStencil(texture.format)) gl.clearBufferfi(gl.DEPTH_STENCIL, 0, 1, 0);
      else gl.clearBufferfv(gl.DEPTH, 0, [1]);
    }
  }
  gl.deleteFramebuffer(framebuffer);
}

/**
 * Where depths are attached to a framebuffer.
 * @type {(gl: Gl, format: GPUTextureFormat) => number}
 */
export const depthPoint = (gl, format) =>
  hasStencil(format) ? gl.DEPTH_STENCIL_ATTACHMENT : gl.DEPTH_ATTACHMENT;

/**
 * Attach one layer and level of a texture to the framebuffer that is bound.
 * @param {Gl} gl
 * @param {number} framebuffer
 * @param {number} point
 * @param {Texture} texture
 * @param {number} layer
 * @param {number} level
 */
export function attach(gl, framebuffer, point, { gl: texture, dimension, samples }, layer, level) {
  if (samples > 1) {
    gl.framebufferRenderbuffer(framebuffer, point, gl.RENDERBUFFER, texture);
  } else if (dimension === "2d-array" || dimension === "3d") {
    gl.framebufferTextureLayer(framebuffer, point, texture, level, layer);
  } else {
    const face = dimension === "cube" ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + layer : gl.TEXTURE_2D;
    gl.framebufferTexture2D(framebuffer, point, face, texture, level);
  }
}

/**
 * A picture of the host. Its rows are uploaded in their order, as WebGL, too, counts them from
 * v = 0.
 * @param {Context} context
 * @param {PictureRow} picture
 * @returns {Texture}
 */
export function makePicture(context, picture) {
  const { gl } = context;
  const { format, dimension, width, height, depth, levels } = picture;
  if (format === "rgba32float") {
    context.need("OES_texture_float_linear", "filter pictures of floats");
  }
  const hasThree = dimension === "3d" || dimension === "2d-array";
  const sides = hasThree ? [width, height, depth] : [width, height];
  const made = allocate(context, {
    format, dimension, width, height, layers: depth, levels: levels.length, samples: 1, sides,
  });
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  levels.forEach((level, number) => upload(gl, made, number, bytesOf(level)));
  return made;
}

/**
 * @param {Gl} gl
 * @param {Texture} texture
 * @param {number} level
 * @param {Uint8Array<ArrayBuffer>} bytes
 */
function upload(gl, { format, dimension, width, height, layers }, level, bytes) {
  const [, lanes, type] = present(STORAGE[format]);
  const area = /** @type {const} */ ([halved(width, level), halved(height, level)]);
  const what = /** @type {const} */ ([constant(gl, lanes), constant(gl, type)]);
  const texels = numbersOf(type, bytes);
  if (dimension === "2d") {
    gl.texSubImage2D(gl.TEXTURE_2D, level, 0, 0, ...area, ...what, texels);
  } else if (dimension === "cube") {
    const face = texels.length / layers;
    for (let at = 0; at < layers; at++) {
      const part = texels.subarray(at * face, (at + 1) * face);
      gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + at, level, 0, 0, ...area, ...what, part);
    }
  } else {
    const depth = dimension === "3d" ? halved(layers, level) : layers;
    gl.texSubImage3D(bindOf(gl, dimension), level, 0, 0, 0, ...area, depth, ...what, texels);
  }
}

/**
 * @param {string} type
 * @param {Uint8Array<ArrayBuffer>} bytes
 */
function numbersOf(type, { buffer }) {
  switch (type) {
    case "FLOAT":
      return new Float32Array(buffer);
    case "UNSIGNED_INT":
      return new Uint32Array(buffer);
    case "INT":
      return new Int32Array(buffer);
    default:
      return new Uint8Array(buffer);
  }
}

/** @type {SamplerRow["state"]} */
const LOADED = { filter: "nearest", mip: "nearest", wrap: "clamp-to-edge", compare: null };

/**
 * The sampler of a texture in a shader; without a state, its texels are only loaded.
 * @param {Gl} gl
 * @param {SamplerRow["state"] | null} state
 * @returns {WebGLSampler}
 */
export function makeSampler(gl, state) {
  const sampler = gl.createSampler();
  /** @type {(name: number, value: number) => void} */
  const set = (name, value) => gl.samplerParameteri(sampler, name, value);
  const { filter, mip, wrap, wrap_u, wrap_v, wrap_w, anisotropy, compare } = state ?? LOADED;
  const words = [filter, mip === "linear" ? "linear" : "nearest"];
  const [near, between] = words.map((word) => word.toUpperCase());
  set(gl.TEXTURE_MAG_FILTER, constant(gl, near));
  set(gl.TEXTURE_MIN_FILTER, constant(gl, `${near}_MIPMAP_${between}`));
  /** @type {(own: typeof wrap_u) => AddressMode} */
  const mode = (own) => /** @type {AddressMode} */ (own ?? wrap);
  set(gl.TEXTURE_WRAP_S, gl[WRAPS[mode(wrap_u)]]);
  set(gl.TEXTURE_WRAP_T, gl[WRAPS[mode(wrap_v)]]);
  set(gl.TEXTURE_WRAP_R, gl[WRAPS[mode(wrap_w)]]);
  // A sampler stays on the first level by this; other levels can still be loaded.
  if (mip === "none") gl.samplerParameterf(sampler, gl.TEXTURE_MAX_LOD, 0);
  if (compare) {
    set(gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    set(gl.TEXTURE_COMPARE_FUNC, compareOf(gl, compare));
  }
  const longer = anisotropy ? gl.getExtension("EXT_texture_filter_anisotropic") : null;
  if (anisotropy && longer) {
    const most = gl.getParameter(longer.MAX_TEXTURE_MAX_ANISOTROPY_EXT);
    const taken = Math.min(anisotropy, most);
    gl.samplerParameterf(sampler, longer.TEXTURE_MAX_ANISOTROPY_EXT, taken);
  }
  return sampler;
}

const COMPARES = /** @type {const} */ ({
  "never": "NEVER", "less": "LESS", "equal": "EQUAL", "less-equal": "LEQUAL",
  "greater": "GREATER", "not-equal": "NOTEQUAL", "greater-equal": "GEQUAL", "always": "ALWAYS",
});

/** @type {(gl: Gl, word: GPUCompareFunction) => number} */
export const compareOf = (gl, word) => gl[COMPARES[word]];
