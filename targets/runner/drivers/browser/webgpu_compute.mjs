// Runs the dispatches of a kernel, and reads back what they have written.

import { base64, bytes } from "./answers.mjs";
import { makeBuffer } from "./webgpu_draw.mjs";
import { COMPUTE_STAGE, groupLayouts, groups, makeModule } from "./webgpu_pipeline.mjs";
import { makeSampler, makeTexture, viewOf } from "./webgpu_textures.mjs";

const WORKGROUP = 64;

/** What each dispatch of a job writes. */
export async function runKernel(device, { pipeline: job, dispatches }) {
  const layouts = groupLayouts(device, job, COMPUTE_STAGE);
  const { text, entry } = job.stages.compute;
  const pipeline = await device.createComputePipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: layouts }),
    compute: { module: await makeModule(device, "compute", text), entryPoint: entry },
  });
  const written = [];
  for (const dispatch of dispatches) {
    written.push(await run(device, job, pipeline, layouts, dispatch));
  }
  return { written };
}

async function run(device, job, pipeline, layouts, dispatch) {
  const resources = [];
  const keep = (resource) => (resources.push(resource), resource);
  try {
    const buffers = storage(device, job, dispatch, keep);
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    bindGroups(device, job, layouts, dispatch, buffers, keep).forEach((group, at) =>
      pass.setBindGroup(at, group),
    );
    pass.dispatchWorkgroups(Math.ceil(dispatch.count / WORKGROUP));
    pass.end();
    const results = buffers.filter((_, at) => job.buffers[at].written);
    const copies = results.map((buffer) => keep(copyBack(device, encoder, buffer)));
    device.queue.submit([encoder.finish()]);
    await Promise.all(copies.map((copy) => copy.mapAsync(GPUMapMode.READ)));
    const sizes = job.buffers.filter((slot) => slot.written).map((slot) => slot.stride);
    return copies.map((copy, at) =>
      base64(new Uint8Array(copy.getMappedRange()).slice(0, dispatch.count * sizes[at])),
    );
  } finally {
    resources.forEach((resource) => resource.destroy());
  }
}

function storage(device, job, dispatch, keep) {
  const given = dispatch.buffers.values();
  return job.buffers.map((slot) => {
    if (!slot.written) {
      return keep(makeBuffer(device, bytes(given.next().value), GPUBufferUsage.STORAGE));
    }
    const size = Math.max(dispatch.count, 1) * slot.stride;
    const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC;
    return keep(device.createBuffer({ size, usage }));
  });
}

function copyBack(device, encoder, buffer) {
  const usage = GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ;
  const copy = device.createBuffer({ size: buffer.size, usage });
  encoder.copyBufferToBuffer(buffer, 0, copy, 0, buffer.size);
  return copy;
}

function bindGroups(device, job, layouts, dispatch, buffers, keep) {
  const resource = ({ block, storage, texture, sampler, number }) => {
    if (block) {
      const data = bytes(dispatch.blocks[number]);
      return { buffer: keep(makeBuffer(device, data, GPUBufferUsage.UNIFORM)) };
    }
    if (storage) return { buffer: buffers[number] };
    if (texture) {
      const image = dispatch.textures[number];
      return viewOf(keep(makeTexture(device, image)), image);
    }
    return makeSampler(device, sampler);
  };
  return groups(job).map((group, at) =>
    device.createBindGroup({
      layout: layouts[at],
      entries: [...group].map(([binding, what]) => ({ binding, resource: resource(what) })),
    }),
  );
}
