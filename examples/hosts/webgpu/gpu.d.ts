// Constants of WebGPU that TypeScript's own types lack; the package @webgpu/types has them as well.

declare const GPUBufferUsage: Record<"COPY_DST" | "INDEX" | "VERTEX", number>;
declare const GPUTextureUsage: Record<"COPY_DST" | "TEXTURE_BINDING" | "RENDER_ATTACHMENT", number>;
