// Textures of WebGPU: those that frames draw to, and pictures of the host.

import { bytesOf, halved, hasStencil, isDepth, lanesOf } from "../bytes.js";
import { cover, coverPipeline } from "./cover.js";

/**
 * @import { PictureRow } from "../generated/documents.js"
 * @import { TextureSize } from "../renderer.js"
 * @import { Device } from "./device.js"
 */

/**
 * @typedef {object} Texture
 * @property {GPUTexture} gpu
 * @property {number[]} sides The texels of its first level in each direction.
 */

/** The formats to which kernels can store. */
const STORABLE = /^(rgba8unorm|rgba16float|(r|rg|rgba)32float)$/;

/**
 * @param {Device} device
 * @param {TextureSize} size
 * @returns {Texture}
 */
export function makeTexture({ gpu }, size) {
  const { format, width, height, layers, levels, samples, uses } = size;
  const texture = gpu.createTexture({
    format,
    size: [width, height, layers],
    mipLevelCount: levels,
    sampleCount: samples,
    usage:
      GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_SRC | GPUTextureUsage.COPY_DST |
      GPUTextureUsage.RENDER_ATTACHMENT |
      (uses.includes("image") && STORABLE.test(format) ? GPUTextureUsage.STORAGE_BINDING : 0),
  });
  // WebGPU makes every texture zero; depths begin as far away as can be.
  if (isDepth(format)) clearDepths(gpu, texture);
  return { gpu: texture, sides: [width, height] };
}

/**
 * @param {GPUTexture} texture
 * @param {number} layer
 * @param {number} level
 * @returns {GPUTextureView}
 */
export function layerOf(texture, layer, level) {
  return texture.createView({
    dimension: "2d", baseArrayLayer: layer, arrayLayerCount: 1, baseMipLevel: level,
    mipLevelCount: 1,
  });
}

/**
 * The view by which a shader reads a whole texture.
 * @param {Texture} texture
 * @param {GPUTextureViewDimension} [dimension]
 * @returns {GPUTextureView}
 */
export function viewOf({ gpu }, dimension) {
  return gpu.createView({ dimension, aspect: isDepth(gpu.format) ? "depth-only" : "all" });
}

/**
 * @param {Device} device
 * @param {PictureRow} picture
 * @returns {Texture}
 */
export function makePicture(device, picture) {
  const { format, dimension, width, height, depth, levels } = picture;
  if (format === "rgba32float" && !device.gpu.features.has("float32-filterable")) {
    throw new Error("this device cannot filter pictures of floats: it lacks float32-filterable");
  }
  const texture = device.gpu.createTexture({
    format,
    dimension: dimension === "3d" ? "3d" : "2d",
    size: [width, height, depth],
    mipLevelCount: levels.length,
    usage:
      GPUTextureUsage.TEXTURE_BINDING |
      (isDepth(format) ? GPUTextureUsage.RENDER_ATTACHMENT : GPUTextureUsage.COPY_DST),
  });
  const isSolid = dimension === "3d";
  levels.forEach((level, number) => {
    const layers = isSolid ? halved(depth, number) : depth;
    const size = [halved(width, number), halved(height, number), layers];
    const fill = isDepth(format) ? drawDepths : writeTexels;
    fill(device, texture, bytesOf(level), number, size);
  });
  const hasThree = isSolid || dimension === "2d-array";
  return { gpu: texture, sides: hasThree ? [width, height, depth] : [width, height] };
}

/**
 * @param {Device} device
 * @param {GPUTexture} texture
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} mipLevel
 * @param {number[]} size
 */
function writeTexels({ gpu }, texture, bytes, mipLevel, size) {
  const [lanes, bytesPerLane] = lanesOf(texture.format);
  const layout = { bytesPerRow: size[0] * lanes * bytesPerLane, rowsPerImage: size[1] };
  gpu.queue.writeTexture({ texture, mipLevel }, bytes, layout, size);
}

// --- depths --------------------------------------------------------------------------------------

/**
 * @param {GPUTexture} texture
 * @param {number} layer
 * @param {number} level
 * @returns {GPURenderPassDescriptor}
 */
function depthPass(texture, layer, level) {
  return {
    colorAttachments: [],
    depthStencilAttachment: {
      view: layerOf(texture, layer, level),
      depthClearValue: 1,
      depthLoadOp: "clear",
      depthStoreOp: "store",
      ...(hasStencil(texture.format) && { stencilLoadOp: "clear", stencilStoreOp: "store" }),
    },
  };
}

/**
 * @param {GPUDevice} gpu
 * @param {GPUTexture} texture
 */
function clearDepths(gpu, texture) {
  const encoder = gpu.createCommandEncoder();
  for (let level = 0; level < texture.mipLevelCount; level++) {
    for (let layer = 0; layer < texture.depthOrArrayLayers; layer++) {
      encoder.beginRenderPass(depthPass(texture, layer, level)).end();
    }
  }
  gpu.queue.submit([encoder.finish()]);
}

const AS_DEPTH = `
@fragment fn depth(@builtin(position) at: vec4f) -> @builtin(frag_depth) f32 {
  return textureLoad(texels, vec2u(at.xy), 0).r;
}`;

/**
 * WebGPU cannot copy to textures of 32-bit depths, so they are drawn, layer by layer.
 * @param {Device} device
 * @param {GPUTexture} texture
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} level
 * @param {number[]} size
 */
function drawDepths(device, texture, bytes, level, size) {
  const { gpu } = device;
  const state = /** @type {const} */ ({ depthWriteEnabled: true, depthCompare: "always" });
  const pipeline = coverPipeline(gpu, AS_DEPTH, [], { format: texture.format, ...state });
  const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
  const texels = gpu.createTexture({ format: "r32float", size, usage });
  writeTexels(device, texels, bytes, 0, size);
  for (let layer = 0; layer < texels.depthOrArrayLayers; layer++) {
    cover(gpu, pipeline, layerOf(texels, layer, 0), depthPass(texture, layer, level));
  }
  texels.destroy();
}
