// What shaders read and write at the places of their bind groups.

import { formatOf } from "../bytes.js";
import type { Binding, PackagedShader } from "../generated/documents.js";
import type { Bound } from "../renderer.js";
import { viewOf, type Texture } from "./textures.js";

export const PROFILE = "wgsl:webgpu";

/** What a draw, or a kernel, has for a shader. */
export interface Given extends Bound<Texture, GPUBuffer> {
  block(name: string): GPUBindingResource;
  sampler(texture: string): GPUSampler;
  images: Texture[];
}

/** A place, with what WebGPU has to know of it, and what is bound there. */
export interface Slot {
  layout: GPUBindGroupLayoutEntry;
  resource(given: Given): GPUBindingResource;
}

/** What a shader reads and writes, by group; a group that is not used is empty. The layout that
 * WebGPU infers would leave out bindings that a text does not use. */
export function slotsOf({ reflection, texts }: PackagedShader): Slot[][] {
  const { blocks, buffers, images, textures, samplers } = reflection.backends[PROFILE];
  // The bits of GPUShaderStage, which TypeScript's own types lack.
  const visibility = texts[PROFILE]?.compute ? 4 : 3;
  const found: Slot[][] = [];
  const add = (
    place: Pick<Binding, "group" | "binding"> | undefined, layout: object,
    resource: Slot["resource"],
  ) => {
    if (!place) return;
    while (found.length <= place.group!) found.push([]);
    const entry = { binding: place.binding!, visibility, ...layout };
    found[place.group!].push({ layout: entry, resource });
  };
  for (const { name } of reflection.blocks) {
    add(blocks[name], { buffer: {} }, (given) => given.block(name));
  }
  for (const { name } of [...reflection.buffers, ...reflection.results]) {
    const isRead = reflection.buffers.some((row) => row.name === name);
    const type = isRead ? "read-only-storage" : "storage";
    add(buffers[name], { buffer: { type } }, (given) => ({ buffer: of(given, "buffers", name) }));
  }
  reflection.targets.forEach(({ name, format }, number) => {
    const storageTexture = { format: formatOf(format) };
    add(images[name], { storageTexture }, ({ images }) => viewOf(images[number], "2d"));
  });
  for (const { name, layout: { viewDimension, sampleType, sampler } } of reflection.textures) {
    add(textures[name], { texture: { viewDimension, sampleType } }, (given) =>
      viewOf(of(given, "textures", name), viewDimension),
    );
    add(samplers[name], { sampler: { type: sampler } }, (given) => given.sampler(name));
  }
  return found;
}

/** Something that a shader reads. */
function of<Kind extends "textures" | "buffers">(given: Given, kind: Kind, name: string) {
  const found = given[kind].get(name);
  if (found === undefined) throw new Error(`nobody gives ${given.values.name} its \`${name}\``);
  return found as NonNullable<ReturnType<Given[Kind]["get"]>>;
}
