// Textures of WebGPU: those that frames draw to, and pictures of the host.

import { bytesOf, halved, hasStencil, isDepth, lanesOf } from "../bytes.js";
import type { PictureRow } from "../generated/documents.js";
import type { TextureSize } from "../renderer.js";
import { cover, coverPipeline } from "./cover.js";
import type { Device } from "./device.js";

export interface Texture {
  gpu: GPUTexture;
  /** The texels of its first level in each direction. */
  sides: number[];
}

/** What kernels can store to. */
const STORABLE = /^(rgba8unorm|rgba16float|(r|rg|rgba)32float)$/;

export function makeTexture({ gpu }: Device, size: TextureSize): Texture {
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

export function layerOf(texture: GPUTexture, layer: number, level: number): GPUTextureView {
  return texture.createView({
    dimension: "2d", baseArrayLayer: layer, arrayLayerCount: 1, baseMipLevel: level,
    mipLevelCount: 1,
  });
}

/** The view by which a shader reads a whole texture. */
export function viewOf({ gpu }: Texture, dimension?: GPUTextureViewDimension): GPUTextureView {
  return gpu.createView({ dimension, aspect: isDepth(gpu.format) ? "depth-only" : "all" });
}

export function makePicture(device: Device, picture: PictureRow): Texture {
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
  const hasThree = isSolid || dimension === "2d_array";
  return { gpu: texture, sides: hasThree ? [width, height, depth] : [width, height] };
}

function writeTexels(
  { gpu }: Device, texture: GPUTexture, bytes: Uint8Array<ArrayBuffer>, mipLevel: number,
  size: number[],
): void {
  const [lanes, bytesPerLane] = lanesOf(texture.format);
  const layout = { bytesPerRow: size[0] * lanes * bytesPerLane, rowsPerImage: size[1] };
  gpu.queue.writeTexture({ texture, mipLevel }, bytes, layout, size);
}

// --- depths --------------------------------------------------------------------------------------

function depthPass(texture: GPUTexture, layer: number, level: number): GPURenderPassDescriptor {
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

function clearDepths(gpu: GPUDevice, texture: GPUTexture): void {
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

/** WebGPU cannot copy to textures of 32-bit depths, so they are drawn, layer by layer. */
function drawDepths(
  device: Device, texture: GPUTexture, bytes: Uint8Array<ArrayBuffer>, level: number,
  size: number[],
): void {
  const { gpu } = device;
  const state = { depthWriteEnabled: true, depthCompare: "always" } as const;
  const pipeline = coverPipeline(gpu, AS_DEPTH, [], { format: texture.format, ...state });
  const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
  const texels = gpu.createTexture({ format: "r32float", size, usage });
  writeTexels(device, texels, bytes, 0, size);
  for (let layer = 0; layer < texels.depthOrArrayLayers; layer++) {
    cover(gpu, pipeline, layerOf(texels, layer, 0), depthPass(texture, layer, level));
  }
  texels.destroy();
}
