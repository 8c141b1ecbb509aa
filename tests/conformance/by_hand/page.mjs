// Draws a material with plain WebGPU, as somebody might who has read docs/reflection.md and has
// nothing but the WGSL and the reflection. It has neither textures nor buffers nor derived values.

import { divided, levelOf } from "./pattern.mjs";

const KINDS = { f: "Float32", v: "Float32", i: "Int32", u: "Uint32" };
const FORMATS = { f: "float32", v: "float32", i: "sint32", u: "uint32" };
const SCREEN = "rgba8unorm";
const DEPTH = "depth32float";

/** The texels of an expansion or of patches, drawn as instances.
 * `values` are those of parameters. `mesh.primitives` has the numbers of the vertices of each
 * primitive or patch, and `mesh.attributes`, by the name of an input, the lanes at each vertex. */
export async function draw({ reflection, texts, values, mesh, width, height }) {
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const errors = [];
  device.addEventListener("uncapturederror", ({ error }) => errors.push(error.message));
  const { vertices, topology, tessellation } = reflection.draw;
  const pattern = tessellation && divided(tessellation, levelOf(tessellation, values));
  const points = { instance: mesh.primitives, vertex: pattern?.points };
  const inputs = ["instance", "vertex"].map((step) => inputsOf(reflection, step)).filter(Boolean);
  const backend = reflection.backends["wgsl:webgpu"];
  const stage = (name) => {
    const { file, entry_point: entryPoint } = backend.files.find(({ stage }) => stage === name);
    return { module: device.createShaderModule({ code: texts[file] }), entryPoint };
  };
  const pipeline = device.createRenderPipeline({
    layout: "auto",
    vertex: { ...stage("vertex"), buffers: inputs.map(({ layout }) => layout) },
    fragment: { ...stage("fragment"), targets: [{ format: SCREEN }] },
    primitive: { topology, frontFace: backend.front_face },
    depthStencil: { format: DEPTH, depthWriteEnabled: true, depthCompare: "less" },
  });
  const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
  const [screen, depth] = [SCREEN, DEPTH].map((format) =>
    device.createTexture({ format, size: [width, height], usage }));
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginRenderPass({
    colorAttachments: [{ view: screen.createView(), loadOp: "clear", storeOp: "store" }],
    depthStencilAttachment: {
      view: depth.createView(), depthClearValue: 1, depthLoadOp: "clear", depthStoreOp: "discard",
    },
  });
  pass.setPipeline(pipeline);
  const groups = Map.groupBy(reflection.blocks, ({ name }) => backend.blocks[name].group);
  for (const [group, blocks] of groups) {
    const entries = blocks.map((block) => {
      const data = filled(block, reflection.parameters, values);
      const resource = { buffer: bufferOf(device, data, GPUBufferUsage.UNIFORM) };
      return { binding: backend.blocks[block.name].binding, resource };
    });
    const layout = pipeline.getBindGroupLayout(group);
    pass.setBindGroup(group, device.createBindGroup({ layout, entries }));
  }
  inputs.forEach(({ rows, layout }, at) => {
    const data = interleaved(rows, layout, points[layout.stepMode], mesh);
    pass.setVertexBuffer(at, bufferOf(device, data, GPUBufferUsage.VERTEX));
  });
  if (pattern) {
    const indices = new Uint32Array(pattern.cells.flat());
    pass.setIndexBuffer(bufferOf(device, indices, GPUBufferUsage.INDEX), "uint32");
    pass.drawIndexed(indices.length, mesh.primitives.length);
  } else {
    pass.draw(vertices, mesh.primitives.length);
  }
  pass.end();
  const { MAP_READ, COPY_DST } = GPUBufferUsage;
  const copy = device.createBuffer({ size: 4 * width * height, usage: MAP_READ | COPY_DST });
  const rows = { buffer: copy, bytesPerRow: 4 * width };
  encoder.copyTextureToBuffer({ texture: screen }, rows, [width, height]);
  device.queue.submit([encoder.finish()]);
  await copy.mapAsync(GPUMapMode.READ);
  return { texels: Array.from(new Uint8Array(copy.getMappedRange())), errors };
}

function bufferOf(device, data, usage) {
  const { COPY_DST } = GPUBufferUsage;
  const buffer = device.createBuffer({ size: data.byteLength, usage: usage | COPY_DST });
  device.queue.writeBuffer(buffer, 0, data);
  return buffer;
}

/** The bytes of a uniform block. */
function filled({ name, size }, parameters, values) {
  const data = new DataView(new ArrayBuffer(size));
  for (const row of parameters.filter(({ block }) => block === name)) {
    const { kind, columns, column_stride: stride } = row.layout;
    const value = values[row.name] ?? row.default;
    (columns ? value : [value]).forEach((column, at) =>
      put(data, row.offset + (columns ? at * stride : 0), kind[0], [column].flat()));
  }
  return data;
}

function put(data, offset, kind, lanes) {
  lanes.forEach((lane, at) => data[`set${KINDS[kind]}`](offset + 4 * at, lane, true));
}

/** The vertex inputs that step alike, which lie in one buffer, and how. */
function inputsOf({ vertex_inputs: all }, stepMode) {
  const rows = all.filter(({ step }) => step === stepMode);
  let arrayStride = 0;
  const attributes = rows.map(({ representation, location: shaderLocation }) => {
    const lanes = Number(representation.match(/vec(\d)/)?.[1] ?? 1), offset = arrayStride;
    arrayStride += 4 * lanes;
    const format = FORMATS[representation[0]] + (lanes > 1 ? `x${lanes}` : "");
    return { shaderLocation, offset, format };
  });
  return rows.length && { rows, layout: { stepMode, arrayStride, attributes } };
}

/** The buffer of inputs: of the points of a pattern, or of the primitives of a mesh. */
function interleaved(rows, { arrayStride, attributes }, points, { attributes: given }) {
  const data = new DataView(new ArrayBuffer(points.length * arrayStride));
  points.forEach((point, number) => rows.forEach(({ representation, mesh }, at) => {
    const { name, corner, is_number, is_of_pattern } = mesh;
    const counted = () => [corner === null ? number : point[corner]];
    const lanes = is_of_pattern ? point : is_number ? counted() : given[name][point[corner]];
    put(data, number * arrayStride + attributes[at].offset, representation[0], lanes);
  }));
  return data;
}
