// Creates the textures and samplers of a job, and their entries in a bind group's layout.

import { bytes, levelSize, Refusal } from "./answers.mjs";

const TEXEL_SIZES = {
  "rgba8unorm": 4, "rgba8unorm-srgb": 4, "rgba32float": 16, "depth32float": 4,
  "r8uint": 1, "rgba8uint": 4, "r32uint": 4, "rgba32uint": 16, "r32sint": 4, "rgba32sint": 16,
};
const ADDRESS_MODES = { repeat: "repeat", clamp: "clamp-to-edge", mirror: "mirror-repeat" };
const VIEWS = { "2d": "2d", "2d_array": "2d-array", "3d": "3d", "cube": "cube" };

/** A texture's part of a layout's entry. */
export const textureLayout = ({ dimension, sample }) => ({
  viewDimension: VIEWS[dimension],
  sampleType: sample,
});

/** A sampler's part of a layout's entry. */
export const samplerLayout = ({ sampling }) => ({ type: sampling });

export function makeSampler(device, { filter, mip, wrap, compare }) {
  return device.createSampler({
    addressModeU: ADDRESS_MODES[wrap],
    addressModeV: ADDRESS_MODES[wrap],
    addressModeW: ADDRESS_MODES[wrap],
    magFilter: filter,
    minFilter: filter,
    // A sampler cannot ignore mip levels, but it can stay on the first one.
    ...(mip === "none" ? { lodMaxClamp: 0 } : { mipmapFilter: mip }),
    ...(compare !== null && { compare: compare.replace("_", "-") }),
  });
}

/** A texture with all levels of an image. */
export function makeTexture(device, image) {
  if (image.format === "rgba32float" && !device.features.has("float32-filterable")) {
    throw new Refusal("the WebGPU adapter cannot filter rgba32float: it lacks float32-filterable");
  }
  const isDepth = image.format === "depth32float";
  const texture = device.createTexture({
    format: image.format,
    dimension: image.dimension === "3d" ? "3d" : "2d",
    size: levelSize(image, 0),
    mipLevelCount: image.levels.length,
    usage:
      GPUTextureUsage.TEXTURE_BINDING |
      (isDepth ? GPUTextureUsage.RENDER_ATTACHMENT : GPUTextureUsage.COPY_DST),
  });
  if (isDepth) drawDepths(device, texture, image);
  else image.levels.forEach((_, level) => writeTexels(device, texture, image, level));
  return texture;
}

/** The view of a texture that a shader reads. */
export const viewOf = (texture, image) =>
  texture.createView({ dimension: VIEWS[image.dimension] });

function writeTexels(device, texture, image, mipLevel) {
  const size = levelSize(image, mipLevel);
  const bytesPerRow = size[0] * TEXEL_SIZES[image.format];
  const layout = { bytesPerRow, rowsPerImage: size[1] };
  const texels = bytes(image.levels[mipLevel]);
  device.queue.writeTexture({ texture, mipLevel }, texels, layout, size);
}

const DEPTHS = `
@group(0) @binding(0) var<storage, read> depths: array<f32>;
@group(0) @binding(1) var<uniform> width_and_first: vec2u;
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}
@fragment fn depth(@builtin(position) at: vec4f) -> @builtin(frag_depth) f32 {
  let texel = vec2u(at.xy);
  return depths[width_and_first.y + texel.y * width_and_first.x + texel.x];
}`;

// WebGPU cannot copy to a texture of 32-bit depths, so they are drawn, layer by layer.
function drawDepths(device, texture, image) {
  const module = device.createShaderModule({ code: DEPTHS });
  const pipeline = device.createRenderPipeline({
    layout: "auto",
    vertex: { module },
    fragment: { module, targets: [] },
    depthStencil: { format: image.format, depthWriteEnabled: true, depthCompare: "always" },
  });
  const encoder = device.createCommandEncoder();
  const scratch = [];
  image.levels.forEach((texels, level) => {
    const [width, height, layers] = levelSize(image, level);
    const depths = filledBuffer(device, GPUBufferUsage.STORAGE, bytes(texels));
    scratch.push(depths);
    for (let layer = 0; layer < layers; layer++) {
      const where = new Uint32Array([width, layer * width * height]);
      const place = filledBuffer(device, GPUBufferUsage.UNIFORM, where);
      scratch.push(place);
      const view = layerOf(texture, level, layer);
      drawLayer(device, encoder, pipeline, view, [depths, place]);
    }
  });
  device.queue.submit([encoder.finish()]);
  scratch.forEach((buffer) => buffer.destroy());
}

function layerOf(texture, baseMipLevel, baseArrayLayer) {
  const dimension = "2d";
  return texture.createView({
    dimension, baseMipLevel, baseArrayLayer, mipLevelCount: 1, arrayLayerCount: 1,
  });
}

function drawLayer(device, encoder, pipeline, view, buffers) {
  const pass = encoder.beginRenderPass({
    colorAttachments: [],
    depthStencilAttachment: {
      view, depthClearValue: 0, depthLoadOp: "clear", depthStoreOp: "store",
    },
  });
  const layout = pipeline.getBindGroupLayout(0);
  const entries = buffers.map((buffer, binding) => ({ binding, resource: { buffer } }));
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({ layout, entries }));
  pass.draw(3);
  pass.end();
}

function filledBuffer(device, usage, data) {
  const buffer = device.createBuffer({
    size: data.byteLength,
    usage: usage | GPUBufferUsage.COPY_DST,
  });
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}
