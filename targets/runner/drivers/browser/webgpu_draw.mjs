// Draws one picture of a job: its resources, the render pass, and reading it back.

import { base64, bytes } from "./answers.mjs";
import { bindGroups, makeBuffer, makeStorage } from "./webgpu_bindings.mjs";
import { depthFormat, vertexBuffers } from "./webgpu_pipeline.mjs";

const ROW_ALIGNMENT = 256;
const TEXEL_SIZES = {
  "r8unorm": 1, "rg8unorm": 2, "rgba8unorm": 4, "rgba8unorm-srgb": 4,
  "r16float": 2, "rg16float": 4, "rgba16float": 8,
  "r32float": 4, "rg32float": 8, "rgba32float": 16,
};

/** The picture of a draw: the format and the texels of each target. */
export async function drawPicture(device, job, { pipeline, layouts }, draw) {
  const resources = [];
  const keep = (resource) => (resources.push(resource), resource);
  try {
    const size = [draw.width, draw.height];
    const targets = (samples) =>
      job.targets.map(({ format }) => keep(makeTarget(device, format, size, samples)));
    const screen = targets(1);
    const drawn = job.samples > 1 ? targets(job.samples) : screen;
    const depth = keep(makeTarget(device, depthFormat(job), size, job.samples));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass(passDescriptor(job, drawn, screen, depth, draw));
    pass.setPipeline(pipeline);
    pass.setBlendConstant(draw.blend_constant);
    if (job.stencil) pass.setStencilReference(job.stencil.reference);
    const storage = makeStorage(device, job, draw, keep);
    bindGroups(device, job, layouts, draw, storage, keep).forEach((group, at) =>
      pass.setBindGroup(at, group),
    );
    drawMesh(device, pass, job, draw, keep);
    pass.end();
    const copies = screen.map((target) => keep(copyBack(device, encoder, target)));
    device.queue.submit([encoder.finish()]);
    await Promise.all(copies.map((copy) => copy.mapAsync(GPUMapMode.READ)));
    return copies.map((copy, at) => ({
      format: job.targets[at].format,
      texels: base64(withoutPadding(new Uint8Array(copy.getMappedRange()), screen[at])),
    }));
  } finally {
    resources.forEach((resource) => resource.destroy());
  }
}

function makeTarget(device, format, size, sampleCount) {
  return device.createTexture({
    format,
    size,
    sampleCount,
    usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
  });
}

/** What is drawn to, and to what its samples are resolved, if it is not the same. */
function passDescriptor(job, drawn, screen, depth, draw) {
  return {
    colorAttachments: drawn.map((target, at) => ({
      view: target.createView(),
      clearValue: draw.clear[at],
      loadOp: "clear",
      ...(target === screen[at]
        ? { storeOp: "store" }
        : { storeOp: "discard", resolveTarget: screen[at].createView() }),
    })),
    depthStencilAttachment: {
      view: depth.createView(),
      depthClearValue: draw.clear_depth,
      depthLoadOp: "clear",
      depthStoreOp: "discard",
      ...(job.stencil && {
        stencilClearValue: 0,
        stencilLoadOp: "clear",
        stencilStoreOp: "discard",
      }),
    },
  };
}

function drawMesh(device, pass, job, draw, keep) {
  const buffer = (data, usage) => keep(makeBuffer(device, bytes(data), usage));
  vertexBuffers(job.inputs).forEach((layout, at) => {
    const data = interleaved(layout, draw.vertices);
    pass.setVertexBuffer(at, keep(makeBuffer(device, data, GPUBufferUsage.VERTEX)));
  });
  const indices = buffer(draw.indices, GPUBufferUsage.INDEX);
  pass.setIndexBuffer(indices, "uint32");
  pass.drawIndexed(indices.size / 4, draw.instance_count);
}

/** The attributes of one buffer, interleaved. */
function interleaved({ arrayStride, members }, vertices) {
  const parts = members.map(({ input, size, offset }) => ({ data: bytes(vertices[input]), size, offset }));
  const count = parts[0].data.length / parts[0].size;
  const whole = new Uint8Array(count * arrayStride);
  for (const { data, size, offset } of parts) {
    for (let at = 0; at < count; at++) {
      whole.set(data.subarray(at * size, (at + 1) * size), at * arrayStride + offset);
    }
  }
  return whole;
}

const rowSize = ({ width, format }) => width * TEXEL_SIZES[format];
const paddedRowSize = (target) => Math.ceil(rowSize(target) / ROW_ALIGNMENT) * ROW_ALIGNMENT;

/** A buffer into which the encoder copies a target, with rows padded as WebGPU requires. */
export function copyBack(device, encoder, target) {
  const bytesPerRow = paddedRowSize(target);
  const buffer = device.createBuffer({
    size: bytesPerRow * target.height,
    usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
  });
  encoder.copyTextureToBuffer({ texture: target }, { buffer, bytesPerRow }, [
    target.width,
    target.height,
  ]);
  return buffer;
}

/** The texels of a target, or of an image that a kernel has written, row by row. */
export function withoutPadding(data, target) {
  const row = rowSize(target);
  const padded = paddedRowSize(target);
  if (row === padded) return data;
  const packed = new Uint8Array(row * target.height);
  for (let y = 0; y < target.height; y++) {
    packed.set(data.subarray(y * padded, y * padded + row), y * row);
  }
  return packed;
}
