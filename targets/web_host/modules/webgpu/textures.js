// Textures of WebGPU: those that frames draw to, and pictures of the host.
import { bytesOf, halved, hasStencil, isDepth, lanesOf } from "../bytes.js";
/** What kernels can store to. */
const STORABLE = /^(rgba8unorm|rgba16float|(r|rg|rgba)32float)$/;
export function makeTexture({ gpu }, size) {
    const { format, width, height, layers, levels, samples, uses } = size;
    const texture = gpu.createTexture({
        format,
        size: [width, height, layers],
        mipLevelCount: levels,
        sampleCount: samples,
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_SRC | GPUTextureUsage.COPY_DST |
            GPUTextureUsage.RENDER_ATTACHMENT |
            (uses.includes("image") && STORABLE.test(format) ? GPUTextureUsage.STORAGE_BINDING : 0),
    });
    // WebGPU makes every texture zero; depths begin as far away as can be.
    if (isDepth(format))
        clearDepths(gpu, texture);
    return { gpu: texture, sides: [width, height] };
}
export function layerOf(texture, layer, level) {
    return texture.createView({
        dimension: "2d", baseArrayLayer: layer, arrayLayerCount: 1, baseMipLevel: level,
        mipLevelCount: 1,
    });
}
/** The view by which a shader reads a whole texture. */
export function viewOf({ gpu }, dimension) {
    return gpu.createView({ dimension, aspect: isDepth(gpu.format) ? "depth-only" : "all" });
}
export function makePicture(device, picture) {
    const { dimension, width, height, depth, levels } = picture;
    const format = picture.format;
    if (format === "rgba32float" && !device.gpu.features.has("float32-filterable")) {
        throw new Error("this device cannot filter pictures of floats: it lacks float32-filterable");
    }
    const texture = device.gpu.createTexture({
        format,
        dimension: dimension === "3d" ? "3d" : "2d",
        size: [width, height, depth],
        mipLevelCount: levels.length,
        usage: GPUTextureUsage.TEXTURE_BINDING |
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
function writeTexels({ gpu }, texture, bytes, mipLevel, size) {
    const [lanes, bytesPerLane] = lanesOf(texture.format);
    const layout = { bytesPerRow: size[0] * lanes * bytesPerLane, rowsPerImage: size[1] };
    gpu.queue.writeTexture({ texture, mipLevel }, bytes, layout, size);
}
// --- depths --------------------------------------------------------------------------------------
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
function clearDepths(gpu, texture) {
    const encoder = gpu.createCommandEncoder();
    for (let level = 0; level < texture.mipLevelCount; level++) {
        for (let layer = 0; layer < texture.depthOrArrayLayers; layer++) {
            encoder.beginRenderPass(depthPass(texture, layer, level)).end();
        }
    }
    gpu.queue.submit([encoder.finish()]);
}
const DEPTHS = `
@group(0) @binding(0) var<storage, read> depths: array<f32>;
@vertex fn corner(@builtin(vertex_index) i: u32, @builtin(instance_index) first: u32) -> Corner {
  return Corner(vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1), first);
}
struct Corner { @builtin(position) at: vec4f, @location(0) @interpolate(flat) first: u32 }
@fragment fn depth(corner: Corner) -> @builtin(frag_depth) f32 {
  return depths[corner.first + u32(corner.at.y) * WIDTHu + u32(corner.at.x)];
}`;
/** WebGPU cannot copy to textures of 32-bit depths, so they are drawn, layer by layer. */
function drawDepths(device, texture, bytes, level, [width, height, layers]) {
    const { gpu } = device;
    const module = gpu.createShaderModule({ code: DEPTHS.replace("WIDTH", `${width}`) });
    const pipeline = gpu.createRenderPipeline({
        layout: "auto",
        vertex: { module },
        fragment: { module, targets: [] },
        depthStencil: { format: texture.format, depthWriteEnabled: true, depthCompare: "always" },
    });
    const depths = device.buffer(bytes, GPUBufferUsage.STORAGE);
    const group = gpu.createBindGroup({
        layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer: depths } }],
    });
    const encoder = gpu.createCommandEncoder();
    for (let layer = 0; layer < layers; layer++) {
        const pass = encoder.beginRenderPass(depthPass(texture, layer, level));
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.draw(3, 1, 0, layer * width * height);
        pass.end();
    }
    gpu.queue.submit([encoder.finish()]);
    depths.destroy();
}
