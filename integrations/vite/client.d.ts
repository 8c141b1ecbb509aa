// Tells TypeScript what `import plastic from "./plastic.burnish"` is, and that there are bindings. To have it, name
// "vite-plugin-burnish/client" among the `types` of tsconfig.json.

declare module "*.burnish" {
  // Of a file with frames, a frame; of any other one, a material or a kernel.
  const content: {
    readonly [name: string]: import("vite-plugin-burnish").Shader & import("vite-plugin-burnish").Frame;
  };
  export default content;
}

// The binding, whose exports differ from file to file: `burnish bind --lang typescript` writes a
// file that has their types.
declare module "*.burnish?binding";
