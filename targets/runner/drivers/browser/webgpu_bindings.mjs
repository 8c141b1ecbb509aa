// Creates the bind groups of a draw or of a dispatch, and what is bound through them.

import { bytes } from "./answers.mjs";
import { groups } from "./webgpu_pipeline.mjs";
import { makeSampler, makeTexture, viewOf } from "./webgpu_textures.mjs";

/** A buffer that contains exactly these bytes. */
export function makeBuffer(device, data, usage) {
  const buffer = device.createBuffer({ size: data.length, usage: usage | GPUBufferUsage.COPY_DST });
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}

/** The storage buffers, filled; those that a kernel writes can be read back. */
export function makeStorage(device, job, values, keep) {
  const { STORAGE, COPY_SRC } = GPUBufferUsage;
  return job.buffers.map(({ written }, at) =>
    keep(makeBuffer(device, bytes(values.buffers[at]), written ? STORAGE | COPY_SRC : STORAGE)),
  );
}

/** The bind groups with everything that a pipeline reads and writes. */
export function bindGroups(device, job, layouts, values, storages, keep, images = []) {
  const resource = ({ block, storage, image: written, texture, sampler, number }) => {
    if (block) {
      const data = bytes(values.blocks[number]);
      return { buffer: keep(makeBuffer(device, data, GPUBufferUsage.UNIFORM)) };
    }
    if (storage) return { buffer: storages[number] };
    if (written) return images[number].createView();
    if (texture) {
      const image = values.textures[number];
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
