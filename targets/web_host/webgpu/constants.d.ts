// The constants of WebGPU's specification, which TypeScript's own types lack.

type Constants<Name extends string> = { readonly [name in Name]: number };

declare const GPUBufferUsage: Constants<
  "MAP_READ" | "COPY_SRC" | "COPY_DST" | "INDEX" | "VERTEX" | "UNIFORM" | "STORAGE"
>;
declare const GPUTextureUsage: Constants<
  "COPY_SRC" | "COPY_DST" | "TEXTURE_BINDING" | "STORAGE_BINDING" | "RENDER_ATTACHMENT"
>;
declare const GPUMapMode: Constants<"READ">;
