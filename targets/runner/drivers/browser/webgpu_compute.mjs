// Runs the dispatches of a kernel, and reads back what they have written.

import { base64, Refusal } from "./answers.mjs";
import { bindGroups, makeStorage } from "./webgpu_bindings.mjs";
import { copyBack as copyTexels, withoutPadding } from "./webgpu_draw.mjs";
import { COMPUTE_STAGE, groupLayouts, makeModule } from "./webgpu_pipeline.mjs";

/** What each dispatch of a job writes. */
export async function runKernel(device, { pipeline: job, work_group: sides, dispatches }) {
  const layouts = groupLayouts(device, job, COMPUTE_STAGE);
  const { text, entry } = job.stages.compute;
  const pipeline = await device.createComputePipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: layouts }),
    compute: { module: await makeModule(device, "compute", text), entryPoint: entry },
  });
  const written = [];
  for (const dispatch of dispatches) {
    const groups = dispatch.extent.map((length, axis) => Math.ceil(length / sides[axis]));
    checkGroups(device, groups);
    written.push(await run(device, job, pipeline, layouts, groups, dispatch));
  }
  return { written };
}

function checkGroups(device, groups) {
  const most = device.limits.maxComputeWorkgroupsPerDimension;
  const count = Math.max(...groups);
  if (count > most) {
    throw new Refusal(
      `${count} work groups along one axis, and the device runs at most ${most} at once: ` +
        "compute fewer elements, or declare larger work groups",
    );
  }
}

async function run(device, job, pipeline, layouts, groups, dispatch) {
  const resources = [];
  const keep = (resource) => (resources.push(resource), resource);
  try {
    const buffers = makeStorage(device, job, dispatch, keep);
    const images = job.images.map(({ format }) => keep(makeImage(device, format, dispatch)));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    bindGroups(device, job, layouts, dispatch, buffers, keep, images).forEach((group, at) =>
      pass.setBindGroup(at, group),
    );
    pass.dispatchWorkgroups(...groups);
    pass.end();
    const results = buffers.filter((_, at) => job.buffers[at].written);
    const copies = results.map((buffer) => keep(copyBack(device, encoder, buffer)));
    const texels = images.map((image) => keep(copyTexels(device, encoder, image)));
    device.queue.submit([encoder.finish()]);
    await Promise.all([...copies, ...texels].map((copy) => copy.mapAsync(GPUMapMode.READ)));
    return {
      buffers: copies.map((copy) => base64(new Uint8Array(copy.getMappedRange()))),
      images: texels.map((copy, at) =>
        base64(withoutPadding(new Uint8Array(copy.getMappedRange()), images[at])),
      ),
    };
  } finally {
    resources.forEach((resource) => resource.destroy());
  }
}

function makeImage(device, format, { extent }) {
  const usage = GPUTextureUsage.STORAGE_BINDING | GPUTextureUsage.COPY_SRC;
  return device.createTexture({ format, size: extent, usage });
}

function copyBack(device, encoder, buffer) {
  const usage = GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ;
  const copy = device.createBuffer({ size: buffer.size, usage });
  encoder.copyBufferToBuffer(buffer, 0, copy, 0, buffer.size);
  return copy;
}
