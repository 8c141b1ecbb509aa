// The documents that a host reads: a frame's package, its plan, and the reflections of its shaders.
// docs/hosts.md, docs/plans.md and docs/reflection.md explain them; here stands what the host uses.

/** What a host sets: a number, a list of lanes, columns or elements, or members by name. */
export type Value = number | boolean | null | Value[] | { [member: string]: Value };

/** A frame with everything that it draws: `frame_package` in Python makes it. */
export interface FramePackage {
  package: 1;
  plan: Plan;
  shaders: PackagedShader[];
  /** Width and height, until `resize` is called. */
  size: [number, number];
  camera: Camera;
  scene: Scene;
  /** The values of the plan's parameters, by name. */
  values: Record<string, Value>;
  /** What each of the plan's parameters is of the scene, by name, if it is something of it. */
  roles: Record<string, string>;
  /** The names that somebody has set, which the scene leaves alone. */
  given: string[];
  /** The pictures that the plan's host textures are, by name. */
  textures: Record<string, number>;
  /** The elements of the plan's host buffers in base64, by name. */
  buffers: Record<string, string>;
  pictures: Picture[];
}

/** A shader with its texts, and what its materials set. */
export interface PackagedShader {
  reflection: Reflection;
  /** By profile, such as `wgsl:webgpu`, and stage. */
  texts: Record<string, Record<string, ShaderText>>;
  values: Record<string, Value>;
  roles: Record<string, string>;
  textures: Record<string, number>;
  /** What each texture is of the look of a model, by name, if it is something of it. */
  texture_roles: Record<string, string>;
  buffers: Record<string, string>;
  /** Where the host divides patches: how they are divided. */
  pattern: Pattern | null;
}

export interface ShaderText { text: string; entry: string }

/** What looks at the scene. Both are values of the scene, by their roles. */
export interface Camera {
  /** World space to the clip space of a square picture: four columns. For a picture that is `a`
   * times as wide as high, the host divides the first row by `a`. */
  view_projection: number[][];
  eye: number[];
  [role: string]: Value;
}

export interface Scene { models: Model[]; meshes: Mesh[] }

export interface Model {
  material: string;
  /** The names by which steps draw it. */
  tags: string[];
  mesh: number;
  /** For each shader that draws it, by number, which of the mesh's `primitives` are drawn. */
  primitives: Record<string, number>;
  /** Values by role: `object_to_world`, bones, colours. */
  values: Record<string, Value>;
  /** Pictures by role. */
  textures: Record<string, number>;
}

/** Vertices and primitives; each vertex input has a stream of this name in `vertices` or
 * `instances`. */
export interface Mesh {
  vertices: Record<string, Stream>;
  instances: Record<string, Stream>;
  instance_count: number;
  primitives: Primitives[];
}

/** Numbers of vertices, so many for each primitive: little-endian uint32 in base64. */
export interface Primitives { corners: number; indices: string }

/** Little-endian numbers of 32 bits in base64. */
export interface Stream { type: "float" | "int" | "uint"; lanes: number; data: string }

/** What is drawn of each patch. */
export interface Pattern {
  /** The levels of the edges and the inside, for which it was made. */
  levels: number[];
  /** The vertex inputs that are of the pattern, by name. */
  vertices: Record<string, Stream>;
  indices: string;
}

/** Texels with all mip levels, each level in base64, layer by layer and row by row from the top. */
export interface Picture {
  format: GPUTextureFormat;
  dimension: Dimension;
  width: number;
  height: number;
  /** Layers, faces, or slices of the first level. */
  depth: number;
  levels: string[];
}

export type Dimension = "2d" | "2d_array" | "3d" | "cube";

// --- plans ---------------------------------------------------------------------------------------

export interface Plan {
  plan: 1;
  frame: string;
  /** The rig of lights. */
  rig: string;
  parameters: Parameter[];
  lights: LightRow[];
  host_textures: { name: string; dimension: Dimension; sample: string }[];
  host_buffers: BufferRow[];
  values: { representation: string; steps: Operation[] }[];
  textures: PlanTexture[];
  steps: Step[];
  kept: Kept[];
  outputs: Output[];
}

export interface PlanTexture {
  format: string;
  dimension: Dimension;
  size: { value: number | null; extent_of: string | null; level: number };
  layers: number;
  levels: number;
  uses: string[];
}

export type Step = DrawStep | RunStep | CopyStep;

export interface DrawStep {
  kind: "draw";
  name: string;
  only_first: boolean;
  targets: Target[];
  depth: Target | null;
  /** The numbers of values. */
  viewport: number | null;
  scissor: number | null;
  blend_constant: number | null;
  draws: Drawn[];
}

export interface Target {
  name: string;
  texture: number;
  layer: number | null;
  level: number;
  load: "load" | "clear";
  /** The number of the value that it is cleared to; null: transparent black, or a depth of 1. */
  clear: number | null;
  store: boolean;
  /** The stencil values beside depths, if there are any. */
  stencil?: { load: "load" | "clear"; store: boolean; clear: number };
}

export interface Drawn {
  models: string | null;
  vertices: number | null;
  light: string | null;
  uses: (Use & { material: string | null })[];
}

export interface Use { shader: number; inputs: Input[] }

export interface Source {
  value?: number;
  result?: string;
  texture?: number | null;
  host?: string;
  previous?: string;
}

export interface Input extends Source { name: string; initially?: Source | null }

export interface RunStep extends Use {
  kind: "run";
  name: string;
  only_first: boolean;
  images: { name: string; texture: number }[];
  buffers: { name: string; result: string }[];
}

export interface CopyStep {
  kind: "copy";
  only_first?: boolean;
  from: { texture: number };
  to: { texture: number };
}

export interface Kept { result: string; texture: number | null; previous: number | null }

export interface Output { name: string; result: string; texture: number | null }

// --- reflections ---------------------------------------------------------------------------------

export interface Reflection {
  format: 1;
  material: string;
  rig: string | null;
  blocks: { name: string; size: number }[];
  parameters: Parameter[];
  derived: Derived[];
  lights: LightRow[];
  buffers: BufferRow[];
  results: ResultRow[];
  extent: Operation[] | null;
  work_group: [number, number, number];
  textures: TextureRow[];
  samplers: { texture: string; state: SamplerState }[];
  vertex_inputs: VertexInput[];
  targets: TargetRow[];
  draw: Draw | null;
  render_state: RenderState;
  backends: Record<string, Backend>;
}

export interface Layout {
  stored: string;
  kind: "float" | "int" | "uint" | "bool";
  lanes: number;
  columns?: number;
  column_stride?: number;
  count?: number;
  stride?: number;
}

/** A value, and where its lanes are. */
export interface Placed {
  name: string;
  type?: string;
  representation: string;
  layout: Layout;
  members?: (Placed & { offset: number })[];
}

export interface Parameter extends Placed {
  type: string;
  range: [number, number] | null;
  default: Value;
  block: string | null;
  offset: number | null;
  count: string | null;
}

export interface Derived extends Placed { block: string; offset: number; steps: Operation[] }

/** One step of a computation: see "Derived values" in docs/reflection.md. */
export interface Operation {
  op: string;
  type: string;
  args: number[];
  parameter?: string;
  texture?: string;
  value?: Value;
  function?: string;
  lanes?: number[];
  member?: string;
  binder?: number;
  operator?: string;
  bound?: number;
}

export interface LightRow {
  name: string;
  capacity: number | null;
  count: string | null;
  parameters: string[];
}

export interface BufferRow extends Placed { stride: number; count: string; stages: string[] }

export interface ResultRow extends Placed {
  stride: number;
  count: Operation[];
  initial: number | null;
}

export interface TextureRow {
  name: string;
  dimension: Dimension;
  layout: {
    viewDimension: GPUTextureViewDimension;
    sampleType: GPUTextureSampleType;
    sampler: GPUSamplerBindingType | null;
  };
  stages: string[];
}

export interface SamplerState {
  filter: "linear" | "nearest";
  mip: "linear" | "nearest" | "none";
  wrap: "repeat" | "clamp" | "mirror";
  compare?: string;
}

export interface VertexInput {
  name: string;
  representation: string;
  location: number | null;
  step: "vertex" | "instance";
  mesh: {
    name: string;
    corner: number | null;
    is_number: boolean;
    is_of_pattern: boolean;
  } | null;
  buffer: { name: string; member: string } | null;
}

export interface Draw {
  primitive: string;
  corners: number;
  expanded_by: string | null;
  vertices: number | null;
  topology: "point" | "line" | "triangle";
  tessellation: {
    divided_by: string;
    levels: { edges: Operation[][]; inside: Operation[][] } | null;
  } | null;
  layers: { count: number; parameter: string | null } | null;
}

export interface TargetRow {
  name: string;
  format: string;
  blend: Blend | null;
  /** Some letters of `rgba`, or `none`. */
  mask: string;
}

/** How a target is blended: words of WebGPU, with `_` for `-`. */
export interface Blend { color: BlendEquation; alpha: BlendEquation }

export interface BlendEquation { source: string; destination: string; operation: string }

export interface RenderState {
  cull: "none" | "front" | "back";
  fill: "faces" | "lines";
  depth: {
    compare: string;
    write: boolean;
    bias: { constant: number; slope: number; clamp: number } | null;
  };
  stencil: {
    front: StencilSide;
    back: StencilSide;
    reference: number;
    read_mask: number;
    write_mask: number;
  } | null;
}

export interface StencilSide { compare: string; fail: string; depth_fail: string; pass: string }

export interface Place { identifier: string; group: number; binding: number }

export interface Backend {
  front_face: "ccw" | "cw";
  blocks: Record<string, Place>;
  buffers: Record<string, Place>;
  images: Record<string, Place>;
  textures: Record<string, Place>;
  samplers: Record<string, Place>;
  vertex_inputs: Record<string, { identifier: string }>;
  /** Uniforms of WebGL that are the height of what is drawn to. */
  host_uniforms: string[];
}

// --- frames --------------------------------------------------------------------------------------

/** A frame that is open: `openFrame` makes one. What cannot be done is an `Error` with a
 * sentence. */
export interface Frame {
  readonly plan: Plan;
  /** Set something of the frame, `sun.direction` or `lamps[2].place`; or else of all shaders that
   * have it, such as a material's colour. */
  set(name: string, value: Value): void;
  /** Look from elsewhere. What is left out stays as it is. */
  setCamera(camera: Partial<Camera>): void;
  /** The width and height of what the frame draws, as far as it says no other size. */
  resize(width: number, height: number): void;
  /** Draw the frame once; what it keeps goes on from the last time. */
  draw(): void;
  /** Put an output on the canvas, by default the first one that is a picture. */
  show(output?: string): void;
  /** The width and height of an output's first level. */
  sizeOf(output: string): [number, number];
  /** The numbers of an output's first level. */
  read(output: string): Promise<Pixels>;
  /** The elements of an output that is a buffer, as its row of `results` says how they lie. */
  readElements(output: string): Promise<Uint8Array<ArrayBuffer>>;
  /** Wait until all is drawn; an error tells what the API has refused of it. */
  finished(): Promise<void>;
  /** Give everything back that the frame has made. */
  dispose(): void;
}

/** Layer by layer and row by row from the top, four linear numbers a pixel. Lanes that the format
 * lacks are 0, 0, 1; depths are in the first lane. */
export interface Pixels { width: number; height: number; layers: number; texels: Float32Array }
