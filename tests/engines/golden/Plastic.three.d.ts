// Plastic: a material for three.js, by Burnish.

import type {
  MeshPhysicalNodeMaterial,
  Node,
  Color,
  Texture,
} from "three/webgpu";

/** A value that may change at any time. */
export interface Settable<T> {
  value: T;
}

export interface PlasticParameters {
  /** Base colour */
  readonly base: Settable<Color>;
}

export interface PlasticTextures {
  /** Multiplies the base colour (Its colours are decoded: give it `SRGBColorSpace`.) */
  readonly albedo: Settable<Texture>;
}

export interface PlasticSlots {
  readonly tint: Node<"vec3">;
  /** Base colour */
  readonly base: Node<"vec3">;
}

export type PlasticValues = {
  base?: Color;
  albedo?: Texture;
};

export function makePlastic(values?: PlasticValues): {
  parameters: PlasticParameters;
  textures: PlasticTextures;
  slots: PlasticSlots;
};

export class PlasticMaterial extends MeshPhysicalNodeMaterial {
  constructor(values?: PlasticValues);
  readonly parameters: PlasticParameters;
  readonly textures: PlasticTextures;
  /** The value of each slot, for materials of your own. */
  readonly slots: PlasticSlots;
}
