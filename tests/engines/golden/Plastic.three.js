// Plastic: a material for three.js, by Burnish.
// Plastic after the classic three-term model.

import {
  MeshPhysicalNodeMaterial,
  CodeNode,
  FunctionNode,
  Node,
  Color,
  DataUtils,
  HalfFloatType,
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  RepeatWrapping,
} from "three/webgpu";
import {
  sampler,
  texture,
  uniform,
  uv,
} from "three/tsl";

/** Code in two languages, of which the backend of a renderer takes its own. */
const inLanguage = (codes, builder) => (builder.renderer.backend.isWebGPUBackend ? codes.wgsl : codes.glsl);

class Code extends CodeNode {
  constructor(codes) {
    super(codes.wgsl);
    this.codes = codes;
  }

  generate(builder) {
    this.code = inLanguage(this.codes, builder);
    return super.generate(builder);
  }
}

class Call extends FunctionNode {
  constructor(codes, includes) {
    super(codes.wgsl, []);
    this.codes = codes;
    this.needed = includes;
  }

  getIncludes(builder) {
    return inLanguage(this.needed, builder);
  }

  getNodeFunction(builder) {
    this.code = inLanguage(this.codes, builder);
    return super.getNodeFunction(builder);
  }
}

/** A texture as an argument, which GLSL calls by other types than WGSL. */
class Argument extends Node {
  constructor(node) {
    super("texture");
    this.node = node;
  }

  generate(builder) {
    return this.node.build(builder, "property");
  }
}

const halves = (numbers) => new Uint16Array(numbers.map((number) => DataUtils.toHalfFloat(number)));
// Textures without any linear filter get no sampler.
const filters = { magFilter: LinearFilter, minFilter: LinearFilter };
const ready = (made) => Object.assign(made, { type: HalfFloatType, needsUpdate: true, ...filters });
const texel = (...numbers) => ready(new DataTexture(halves(numbers), 1, 1));


/** How textures are read. */
const sampling = {
  albedo: { wrapS: RepeatWrapping, wrapT: RepeatWrapping, magFilter: LinearFilter, minFilter: LinearMipmapLinearFilter },
};

// ---- Functions

const call_tint = new Call({
  wgsl: `/// base: Base colour
/// albedo: Multiplies the base colour
fn plastic_tint(uv: vec2f, base: vec3f, albedo: texture_2d<f32>, albedo_sampler: sampler) -> vec3f {
    return base * textureSample(albedo, albedo_sampler, uv).xyz;
}
`,
  glsl: `/// base: Base colour
/// albedo: Multiplies the base colour
vec3 plastic_tint(vec2 uv, vec3 base, sampler2D albedo) {
    return base * texture(albedo, uv).xyz;
}
`,
}, {
  wgsl: [],
  glsl: [],
});

const call_base = new Call({
  wgsl: `/// Base colour
/// base: Base colour
fn plastic_base(base: vec3f) -> vec3f {
    return base;
}
`,
  glsl: `/// Base colour
/// base: Base colour
vec3 plastic_base(vec3 base) {
    return base;
}
`,
}, {
  wgsl: [],
  glsl: [],
});

// ---- The material

/** Makes the parameters, the textures and the slots of one material. */
export function makePlastic(values = {}) {
  const parameters = {
    base: uniform(new Color().setRGB(0.4620769996544071, 0.1301364766903643, 0.012286488356915872)), // Base colour
  };
  const textures = {
    albedo: texture(texel(1, 1, 1, 1)), // Multiplies the base colour (Its colours are decoded: give it `SRGBColorSpace`.)
  };
  const settable = { ...parameters, ...textures };
  for (const [name, value] of Object.entries(values)) {
    if (!(name in settable)) {
      throw new Error(`Plastic has no parameter or texture ${name}`);
    }
    if (value === undefined || value === null) continue; // It keeps its default.
    if (name in sampling) Object.assign(value, sampling[name]);
    settable[name].value = value;
  }
  const given_uv = uv();
  const slot_tint = call_tint.call({ uv: given_uv, base: parameters.base, albedo: new Argument(textures.albedo), albedo_sampler: sampler(textures.albedo) });
  const slot_base = call_base.call({ base: parameters.base });
  const slots = {
    tint: slot_tint,
    base: slot_base,
  };
  return { parameters, textures, slots };
}

export class PlasticMaterial extends MeshPhysicalNodeMaterial {
  constructor(values = {}) {
    super();
    this.#made = makePlastic(values);
    this.#nodes = this.#connect();
  }

  #made;

  #connect() {
    const { parameters, textures, slots } = this.#made;
    this.parameters = parameters;
    this.textures = textures;
    this.slots = slots;
    this.colorNode = slots.tint;
    return { colorNode: this.colorNode };
  }

  #nodes;

  /** A copy, as of `clone()`, has parameters of its own; textures and nodes of yours are shared. */
  copy(source) {
    const { parameters, textures, slots } = this;
    super.copy(source);
    Object.assign(this, { parameters, textures, slots }); // What is copied is the other's.
    if (!(#nodes in source)) return this;
    for (const [name, node] of Object.entries(this.#nodes)) if (source[name] === source.#nodes[name]) this[name] = node;
    for (const [name, { value }] of Object.entries(source.parameters)) this.parameters[name].value = value.clone?.() ?? value;
    for (const [name, { value }] of Object.entries(source.textures)) this.textures[name].value = value;
    return this;
  }
}
