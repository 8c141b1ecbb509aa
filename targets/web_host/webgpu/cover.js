// Draws over a whole picture with a fragment shader that reads the texels of a texture.

const CORNERS = `
@group(0) @binding(0) var texels: texture_2d<f32>;
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}`;

/**
 * A pipeline that draws to these targets, or depths.
 * @param {GPUDevice} gpu
 * @param {string} text
 * @param {GPUColorTargetState[]} targets
 * @param {GPUDepthStencilState} [depthStencil]
 * @returns {GPURenderPipeline}
 */
export function coverPipeline(gpu, text, targets, depthStencil) {
  const texture = /** @type {const} */ ({ sampleType: "unfilterable-float" });
  const group = gpu.createBindGroupLayout({ entries: [{ binding: 0, visibility: 2, texture }] });
  const module = gpu.createShaderModule({ code: CORNERS + text });
  return gpu.createRenderPipeline({
    layout: gpu.createPipelineLayout({ bindGroupLayouts: [group] }),
    vertex: { module },
    fragment: { module, targets },
    ...(depthStencil && { depthStencil }),
  });
}

/**
 * @param {GPUDevice} gpu
 * @param {GPURenderPipeline} pipeline
 * @param {GPUTextureView} texels
 * @param {GPURenderPassDescriptor} descriptor
 */
export function cover(gpu, pipeline, texels, descriptor) {
  const encoder = gpu.createCommandEncoder();
  const pass = encoder.beginRenderPass(descriptor);
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, gpu.createBindGroup({
    layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: texels }],
  }));
  pass.draw(3);
  pass.end();
  gpu.queue.submit([encoder.finish()]);
}
