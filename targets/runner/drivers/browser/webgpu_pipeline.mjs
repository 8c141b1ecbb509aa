// Creates WebGPU's pipeline from that of a job.

import { Refusal } from "./answers.mjs";
import { samplerLayout, textureLayout } from "./webgpu_textures.mjs";

export const COMPUTE_STAGE = 4; // GPUShaderStage.COMPUTE
const BOTH_STAGES = 3; // GPUShaderStage.VERTEX | GPUShaderStage.FRAGMENT
const FLOAT32_TARGETS = ["r32float", "rg32float", "rgba32float"];

const LANES = { r: 1, g: 2, b: 4, a: 8 }; // GPUColorWrite

/** The pipeline, and the layouts of its bind groups. */
export async function makePipeline(device, job) {
  const layouts = groupLayouts(device, job);
  const [vertex, fragment] = await Promise.all([
    makeModule(device, "vertex", job.stages.vertex.text),
    makeModule(device, "fragment", job.stages.fragment.text),
  ]);
  const pipeline = await device.createRenderPipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: layouts }),
    vertex: {
      module: vertex,
      entryPoint: job.stages.vertex.entry,
      buffers: vertexBuffers(job.inputs).map(({ arrayStride, stepMode, members }) => ({
        arrayStride,
        stepMode,
        attributes: members.map(({ format, offset, location }) => ({
          format,
          offset,
          shaderLocation: location,
        })),
      })),
    },
    fragment: {
      module: fragment,
      entryPoint: job.stages.fragment.entry,
      targets: job.targets.map((target) => targetState(device, target)),
    },
    primitive: {
      topology: `${job.primitive}-list`,
      cullMode: job.cull,
      frontFace: job.front_face,
    },
    multisample: { count: job.samples },
    depthStencil: depthStencilState(device, job),
  });
  return { pipeline, layouts };
}

/** One buffer for the attributes of vertices and one for those of instances.
 *
 * WebGPU guarantees 16 attributes, but only 8 buffers.
 */
export function vertexBuffers(inputs) {
  return ["vertex", "instance"].flatMap((stepMode) => {
    let arrayStride = 0;
    const members = [];
    inputs.forEach(({ format, location, step }, input) => {
      if (step !== stepMode) return;
      const size = 4 * Number(format.split("x")[1] ?? 1);
      members.push({ input, format, location, size, offset: arrayStride });
      arrayStride += size;
    });
    return members.length ? [{ arrayStride, stepMode, members }] : [];
  });
}

/** A module; any message of the compiler about its text is an error. */
export async function makeModule(device, stage, code) {
  const module = device.createShaderModule({ code });
  const { messages } = await module.getCompilationInfo();
  if (messages.length) {
    const lines = messages.map(
      ({ type, lineNum, linePos, message }) => `${stage} ${lineNum}:${linePos}: ${type}: ${message}`,
    );
    throw new Refusal(lines.join("\n"));
  }
  return module;
}

// The words of a job are WebGPU's, with other dashes.
const dashed = (word) => word.replaceAll("_", "-");

function depthStencilState(device, job) {
  const format = depthFormat(job);
  if (job.stencil && !device.features.has(format)) {
    throw new Refusal(`the WebGPU adapter has no ${format}`);
  }
  const { constant, slope, clamp } = job.depth_bias;
  const side = ({ compare, fail, depth_fail, passed }) => ({
    compare: dashed(compare),
    failOp: dashed(fail),
    depthFailOp: dashed(depth_fail),
    passOp: dashed(passed),
  });
  return {
    format,
    depthWriteEnabled: job.depth_write,
    depthCompare: dashed(job.depth_compare),
    // Only triangles are moved, and of anything else WebGPU wants to hear nothing of it.
    ...(job.primitive === "triangle" && {
      depthBias: constant,
      depthBiasSlopeScale: slope,
      depthBiasClamp: clamp,
    }),
    ...(job.stencil && {
      stencilFront: side(job.stencil.front),
      stencilBack: side(job.stencil.back),
      stencilReadMask: job.stencil.read_mask,
      stencilWriteMask: job.stencil.write_mask,
    }),
  };
}

/** The format of the depths that a job draws to, and of the stencil values beside them. */
export const depthFormat = (job) => (job.stencil ? "depth32float-stencil8" : "depth32float");

function targetState(device, { format, blend, mask }) {
  const float32 = FLOAT32_TARGETS.includes(format);
  if (blend && float32 && !device.features.has("float32-blendable")) {
    throw new Refusal(`the WebGPU adapter cannot blend ${format}: it lacks float32-blendable`);
  }
  const lanes = mask === "none" ? [] : [...mask];
  const writeMask = lanes.reduce((bits, lane) => bits | LANES[lane], 0);
  if (!blend) return { format, writeMask };
  return { format, writeMask, blend: { color: equation(blend.color), alpha: equation(blend.alpha) } };
}

/** An equation in WebGPU's words. */
function equation({ source, destination, operation }) {
  return {
    operation: dashed(operation),
    srcFactor: dashed(source),
    dstFactor: dashed(destination),
  };
}

/** The slots' bindings by group, with an empty group for each unused number. */
export function groups(job) {
  const found = [];
  const add = (place, what) => {
    for (let group = found.length; group <= place.group; group++) found.push(new Map());
    found[place.group].set(place.binding, what);
  };
  job.blocks.forEach((slot, number) => add(slot.place, { block: slot, number }));
  job.buffers.forEach((slot, number) => add(slot.place, { storage: slot, number }));
  job.images.forEach((slot, number) => add(slot.place, { image: slot, number }));
  job.textures.forEach((slot, number) => {
    add(slot.texture, { texture: slot, number });
    if (slot.sampler) add(slot.sampler, { sampler: slot, number });
  });
  return found;
}

// `layout: "auto"` would leave out bindings that the shaders do not use. An explicit layout also
// makes it an error if a block is larger in the shader than in the job.
export function groupLayouts(device, job, visibility = BOTH_STAGES) {
  return groups(job).map((group) =>
    device.createBindGroupLayout({
      entries: [...group].map(([binding, what]) => ({
        binding,
        visibility,
        ...(what.block && { buffer: { minBindingSize: what.block.size } }),
        ...(what.storage && {
          buffer: {
            type: what.storage.written ? "storage" : "read-only-storage",
            minBindingSize: what.storage.stride,
          },
        }),
        ...(what.image && { storageTexture: { format: what.image.format } }),
        ...(what.texture && { texture: textureLayout(what.texture) }),
        ...(what.sampler && { sampler: samplerLayout(what.sampler) }),
      })),
    }),
  );
}
