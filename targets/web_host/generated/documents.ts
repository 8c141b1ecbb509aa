// Generated from the JSON Schemas of packages, plans and reflections by the tests: do not edit.

/**
 * A value: a scalar, or nested arrays of a vector's lanes, a matrix's columns, an array's elements.
 */
export type Lanes = number | boolean | null | Lanes[];
/**
 * Stages that read it.
 */
export type Stages = string[];
/**
 * Steps that compute a value, operands before users, the last one being the value: `steps` of a reflection's derived values.
 */
export type PlanSteps = Step[];
/**
 * The textures that are waited for.
 */
export type PlanBarriers = PlanBarrier[];
/**
 * The buffers of results that are waited for.
 */
export type PlanBufferBarriers = PlanBufferBarrier[];
/**
 * What becomes of a stencil value; only the bits of `write_mask` change.
 */
export type StencilOperation =
  | "keep"
  | "zero"
  | "replace"
  | "invert"
  | "increment_clamp"
  | "decrement_clamp"
  | "increment_wrap"
  | "decrement_wrap";
/**
 * Values that the pipeline supplies.
 */
export type PipelineInputs = string[];
/**
 * By what one side is multiplied; `src` is what is drawn, `dst` what is there, and `constant` what the host sets for the whole pass.
 */
export type BlendFactor =
  | "zero"
  | "one"
  | "src"
  | "one_minus_src"
  | "src_alpha"
  | "one_minus_src_alpha"
  | "dst"
  | "one_minus_dst"
  | "dst_alpha"
  | "one_minus_dst_alpha"
  | "src_alpha_saturated"
  | "constant"
  | "one_minus_constant";
/**
 * What a host sets: a number, a list of lanes, columns or elements, or members by name.
 */
export type Value =
  | number
  | boolean
  | null
  | Value[]
  | {
      [k: string]: Value;
    };

/**
 * A frame with everything that a page draws of it.
 */
export interface FramePackage {
  /**
   * Version of this document's format. A host refuses versions that it does not know.
   */
  package: 1;
  plan: Plan;
  /**
   * The shaders, by the numbers of the plan.
   */
  shaders: PackagedShader[];
  /**
   * The pipelines of WebGPU that steps use; empty without texts for it.
   */
  pipelines: PipelineRow[];
  /**
   * The formats of the plan's textures, as WebGPU calls them. All APIs can draw to these; lanes of ten bits have eight, which are clamped and blended in the same way.
   */
  formats: GPUTextureFormat[];
  /**
   * Width and height, until somebody resizes the frame.
   *
   * @minItems 2
   * @maxItems 2
   */
  size: [number, number];
  camera: Camera;
  /**
   * The models of the scene.
   */
  models: Model[];
  /**
   * What draw calls get of meshes, by number.
   */
  geometries: Geometry[];
  /**
   * The values of the plan's parameters, by name.
   */
  values: {
    [k: string]: Value;
  };
  /**
   * What each of the plan's parameters is of the scene, by name, if it is something of it.
   */
  roles: {
    [k: string]: string;
  };
  /**
   * The names that somebody has set, which the scene leaves alone.
   */
  given: string[];
  /**
   * The pictures that the plan's host textures are, by name.
   */
  textures: {
    [k: string]: number;
  };
  /**
   * The elements of the plan's host buffers in base64, by name.
   */
  buffers: {
    [k: string]: string;
  };
  /**
   * The pictures, by number.
   */
  pictures: Picture[];
}
/**
 * What a host does to draw a frame: which textures it makes, and which steps it executes in which order. Each shader has a reflection of its own.
 */
export interface Plan {
  /**
   * Version of this document's format. A host refuses versions that it does not know.
   */
  plan: 1;
  /**
   * The frame.
   */
  frame: string;
  /**
   * The frame's doc comment; empty where there is none.
   */
  doc: string;
  source: PlanPlace;
  /**
   * The rig of lights under which models are drawn.
   */
  rig: string;
  /**
   * What the host sets for the whole frame, as in reflections. No block holds them. Those of the lights are among them, and are those of the same name in each shader, with or without the name of the rig before it; shaders get others through the values of inputs alone.
   */
  parameters: Parameter[];
  /**
   * The lights of the rig, as in reflections.
   */
  lights: Light[];
  /**
   * Textures that the host binds for the whole frame.
   */
  host_textures: PlanHostTexture[];
  /**
   * Storage buffers that the host binds for the whole frame.
   */
  host_buffers: Buffer[];
  /**
   * Where everything is declared that the host sets, by name.
   */
  sources: {
    [k: string]: PlanPlace;
  };
  /**
   * Models of the host's scene that passes draw.
   */
  models: PlanModels[];
  /**
   * The shaders; steps name them by their numbers here.
   */
  shaders: PlanShader[];
  /**
   * Numbers that the host computes once for each frame, before the first step, of the parameters, of those of the lights, and of the sizes of its textures; steps and textures name them by their numbers here.
   */
  values: PlanValue[];
  /**
   * The textures that the host makes, by number. Each serves one result after the other.
   */
  textures: PlanTexture[];
  /**
   * What the steps leave.
   */
  results: PlanResult[];
  /**
   * What the host does, in this order.
   */
  steps: (PlanDraw | PlanRun | PlanCopy)[];
  /**
   * What is waited for behind the last step and before the exchange of `kept`, so that the host can read the outputs and the next frame what is kept.
   */
  end: {
    barriers: PlanBarriers;
    buffer_barriers: PlanBufferBarriers;
  };
  /**
   * What the next frame reads. Behind the last step the host exchanges each texture (or, where the numbers are null, the result's buffer) with the previous one. Before the first frame, these textures are transparent black, or depths of 1.
   */
  kept: PlanKept[];
  /**
   * What the frame gives, to be read behind the last step and before the exchange of `kept`.
   */
  outputs: PlanOutput[];
}
/**
 * Where something is written; lines and columns count from 1.
 */
export interface PlanPlace {
  /**
   * The file, from the folder of the compiled one; the library's files begin with `std/`.
   */
  file: string;
  /**
   * The line.
   */
  line: number;
  /**
   * The column.
   */
  column: number;
  /**
   * The number of characters.
   */
  length: number;
}
/**
 * A declared parameter.
 */
export interface Parameter {
  /**
   * Name as the host says it, `lamps` or `torch.axis`.
   */
  name: string;
  /**
   * The type as written: `rgb`, `direction<world>`, `Lamp[8]`.
   */
  type: string;
  /**
   * The type on the machine: `float`, `vec3`, `Lamp[8]`.
   */
  representation: string;
  /**
   * Lowest and highest value that a host may set; null where the declaration gives none.
   *
   * @minItems 2
   * @maxItems 2
   */
  range: [number, number] | null;
  /**
   * Value before a host sets one; null where the declaration gives none.
   */
  default: Lanes;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
  /**
   * Which declaration of the library it is, `std.skinning.Skinned.bones`; null where it is none of them.
   */
  library: string | null;
  /**
   * What a program that shows scenes has for it, such as `world_to_clip` of the camera; null where it is the material's own affair.
   */
  role: string | null;
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * Block that holds it; null where the program reads nothing of that block.
   */
  block: string | null;
  /**
   * Bytes from the start of the block; null without a block.
   */
  offset: number | null;
  /**
   * Bytes of the stored value, padding inside it included.
   */
  size: number;
  layout: Layout;
  /**
   * Members of a struct or of an array's elements; empty otherwise.
   */
  members: Member[];
  /**
   * Parameter with the run-time number of elements in use; null where all are.
   */
  count: string | null;
}
/**
 * How lanes lie from the start of the value. A lane is 32 bits, little-endian; what does not apply to the type is absent.
 */
export interface Layout {
  /**
   * The stored type: bools as uints, 2- and 3-row matrices with columns of four rows (`mat3x4`), arrays as arrays of `vec4`. Of a table's member that of one element.
   */
  stored: string;
  /**
   * What a lane is written as; bools are uints 0 and 1. Absent for structs.
   */
  kind?: "float" | "int" | "uint";
  /**
   * Lanes of a scalar or vector, or of one column of a matrix, 4 bytes apart.
   */
  lanes?: number;
  /**
   * Columns of a matrix.
   */
  columns?: number;
  /**
   * Bytes from one column of a matrix to the next.
   */
  column_stride?: number;
  /**
   * Elements of an array; everything else describes one element.
   */
  count?: number;
  /**
   * Bytes from one element of an array to the next.
   */
  stride?: number;
}
/**
 * A member of a struct, or of the elements of an array of structs.
 */
export interface Member {
  /**
   * The member's name.
   */
  name: string;
  /**
   * The type as written: `rgb`, `direction<world>`, `Lamp[8]`.
   */
  type: string;
  /**
   * The type on the machine: `float`, `vec3`, `Lamp[8]`.
   */
  representation: string;
  /**
   * Lowest and highest value that a host may set; null where the declaration gives none.
   *
   * @minItems 2
   * @maxItems 2
   */
  range: [number, number] | null;
  /**
   * Value before a host sets one; null where the declaration gives none.
   */
  default: Lanes;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
  /**
   * Which declaration of the library it is, `std.skinning.Skinned.bones`; null where it is none of them.
   */
  library: string | null;
  /**
   * Bytes from the start of the struct.
   */
  offset: number;
  /**
   * Bytes of the stored value, padding inside it included.
   */
  size: number;
  layout: Layout;
  /**
   * Members of a struct inside this one.
   */
  members: Member[];
}
/**
 * A light, or an array of lights, of the rig.
 */
export interface Light {
  /**
   * Name in the rig.
   */
  name: string;
  /**
   * Largest number of lights of an array; null for a single light.
   */
  capacity: number | null;
  /**
   * Parameter with the number of lights in use; null where it is fixed.
   */
  count: string | null;
  /**
   * The array's parameter, or a single light's parameters, of whatever groups: each has a row in `parameters` with its block and offset.
   */
  parameters: string[];
}
/**
 * A texture of the host.
 */
export interface PlanHostTexture {
  /**
   * Its name.
   */
  name: string;
  /**
   * As it is declared.
   */
  type: string;
  /**
   * Its dimension.
   */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /**
   * What it holds.
   */
  sample: "float" | "depth" | "int" | "uint";
  /**
   * What it is until the host binds one.
   */
  default: string;
  /**
   * Its doc comment.
   */
  doc: string;
  /**
   * How often the host changes it.
   */
  group: string;
}
/**
 * A storage buffer, the same bytes on every backend.
 */
export interface Buffer {
  /**
   * Name as the host says it, `lanterns` or `torch.bulbs`.
   */
  name: string;
  /**
   * The type as written: `Lantern[]`.
   */
  type: string;
  /**
   * The type on the machine: `vec3[]`.
   */
  representation: string;
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * The parameter that says how many elements there are. A buffer without elements is bound with one of zeros.
   */
  count: string;
  /**
   * Bytes from one element to the next.
   */
  stride: number;
  layout: Layout;
  /**
   * Members of an element that is a struct.
   */
  members: Member[];
  /**
   * Stored structs that elements use, those inside others first.
   */
  structs: Struct[];
  stages: Stages;
  /**
   * Doc comment.
   */
  doc: string;
}
/**
 * A struct in stored form.
 */
export interface Struct {
  /**
   * The struct's name.
   */
  name: string;
  /**
   * Bytes, a multiple of 16.
   */
  size: number;
  /**
   * Members in order, padding included.
   */
  members: {
    /**
     * The member's name; padding is `pad_N`.
     */
    name: string;
    /**
     * Stored type.
     */
    type: string;
    /**
     * Bytes from the start of the struct.
     */
    offset: number;
    /**
     * Bytes.
     */
    size: number;
  }[];
}
/**
 * Models of the host's scene.
 */
export interface PlanModels {
  /**
   * Their name, which is a tag in the host's scene; all models of the scene are called `scene`.
   */
  name: string;
  /**
   * The materials that they may have. Every `uses` for them has a shader for each.
   */
  materials: string[];
  /**
   * The doc comment.
   */
  doc: string;
  source: PlanPlace;
}
/**
 * A shader.
 */
export interface PlanShader {
  /**
   * Its name.
   */
  name: string;
  /**
   * The file with its reflection.
   */
  reflection: string;
  /**
   * The pass; null of a kernel.
   */
  pass: string | null;
  /**
   * The rig; null of a kernel.
   */
  rig: string | null;
}
/**
 * A number, vector or matrix.
 */
export interface PlanValue {
  /**
   * Which numbers it consists of.
   */
  representation: string;
  steps: PlanSteps;
}
/**
 * One operation. `op` decides which further properties there are.
 */
export interface Step {
  /**
   * The operation.
   */
  op:
    | "parameter"
    | "constant"
    | "call"
    | "native"
    | "vector"
    | "splat"
    | "matrix"
    | "array"
    | "swizzle"
    | "index"
    | "member"
    | "select"
    | "fold"
    | "apply"
    | "bound"
    | "resource";
  /**
   * Type of the result.
   */
  type: string;
  /**
   * Numbers of earlier steps in the list.
   */
  args: number[];
  /**
   * Of `parameter`: its name.
   */
  parameter?: string;
  /**
   * Of `constant`: the value.
   */
  value?: Lanes;
  /**
   * Of `call` and `native`: the builtin's name.
   */
  function?: string;
  /**
   * Of `swizzle`: the lanes taken, in order.
   */
  lanes?: number[];
  /**
   * Of `member`: the member taken.
   */
  member?: string;
  /**
   * Of `resource`: the name of a texture, of which only the size is asked for.
   */
  texture?: string;
  /**
   * Of `bound`: which enclosing variable it is, counted outwards from 0. Outside of all bodies that is the number of the element.
   */
  binder?: number;
  /**
   * Of `fold`: how terms are combined.
   */
  operator?: "add" | "mul" | "min" | "max" | "and" | "or";
  /**
   * Of `fold`: the largest number of terms.
   */
  bound?: number;
}
/**
 * A texture.
 */
export interface PlanTexture {
  /**
   * A format of render targets or of depths, as passes name them: `rgba16f` are floats, `rgba8` numbers from 0 to 1.
   */
  format: string;
  /**
   * Its dimension.
   */
  dimension: "2d" | "2d_array" | "cube";
  size: PlanSize;
  /**
   * Layers, 6 of a cube.
   */
  layers: number;
  /**
   * Mip levels.
   */
  levels: number;
  /**
   * How many samples each texel has. A texture with several has one layer and one level, is drawn to, and is not read.
   */
  samples: 1 | 4;
  /**
   * What steps use it as, and the host or the next frame behind them; of the two textures of a row of `kept`, what either is used as.
   */
  uses: ("target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to")[];
  /**
   * Whether a row of `kept` names it. Contents of others are needed in the next frame only where a step with `only_first` drew them.
   */
  kept: boolean;
  /**
   * The results that it holds, one after the other.
   */
  results: string[];
}
/**
 * How large a texture is.
 */
export interface PlanSize {
  /**
   * The number of the value that says it, an `ivec2`; null where `extent_of` says it.
   */
  value: number | null;
  /**
   * The name of the step whose kernel says it instead, by the `extent` of its reflection; null where `value` says it.
   */
  extent_of: string | null;
  /**
   * How often both sides are halved then, rounded down, but not below 1.
   */
  level: number;
}
/**
 * What a step leaves.
 */
export interface PlanResult {
  /**
   * The step's name and that of its target.
   */
  name: string;
  /**
   * What it is.
   */
  kind: "texture" | "buffer";
  /**
   * The number of the texture that holds it; null of a buffer, which is the result's own, and of samples that are not resolved.
   */
  texture: number | null;
  /**
   * The step that makes it first.
   */
  first: number;
  /**
   * The last step of the frame that needs it. An output, what is kept, and what a step with `only_first` left are needed after the frame, too.
   */
  last: number;
  /**
   * Its doc comment.
   */
  doc: string;
  source: PlanPlace;
}
/**
 * A pass that is drawn.
 */
export interface PlanDraw {
  kind: "draw";
  /**
   * The step.
   */
  name: string;
  /**
   * The pass.
   */
  pass: string;
  barriers: PlanBarriers;
  buffer_barriers: PlanBufferBarriers;
  /**
   * Whether it is needed in the first frame only.
   */
  only_first: boolean;
  /**
   * Whether it draws on to all that the step before has drawn to, and waits for nothing else, so that a host can draw both in one render pass, without storing and loading in between.
   */
  continues?: boolean;
  /**
   * The targets, in the order of their locations.
   */
  targets: PlanTarget[];
  /**
   * The depths; null where the pass has none. Then there is no depth test, whatever `render_state` of its reflection says.
   */
  depth: null | PlanTarget;
  /**
   * The number of the value that says into which part of the targets the clip volume is drawn, in texels: an `ivec4` of left, top, width and height; null for all of it.
   */
  viewport: number | null;
  /**
   * The number of the value that says to which part of the targets is drawn, likewise; what lies outside of the targets is cut off.
   */
  scissor: number | null;
  /**
   * The number of the value, a `vec4`, that the factor `constant` means in all targets.
   */
  blend_constant: number | null;
  /**
   * What is drawn.
   */
  draws: PlanDrawn[];
  source: PlanPlace;
}
/**
 * From here on, a texture is used in another way. What was written before has to be there; `undefined` means that it has no contents yet.
 */
export interface PlanBarrier {
  /**
   * Whether the barrier stands in the first frame only.
   */
  only_first: boolean;
  /**
   * The texture.
   */
  texture: number;
  /**
   * How it was used.
   */
  from: "undefined" | "target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to";
  /**
   * How it is used.
   */
  to: "target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to";
}
/**
 * From here on, the buffer of a result is used in another way. What was written before has to be there, and what was read before has been read.
 */
export interface PlanBufferBarrier {
  /**
   * The result.
   */
  result: string;
  /**
   * How it was used; `undefined` means that its contents do not matter.
   */
  from: "undefined" | "written" | "read";
  /**
   * How it is used.
   */
  to: "written" | "read";
  /**
   * Whether the barrier stands in the first frame only.
   */
  only_first: boolean;
}
/**
 * What a target of the pass, or its depths, is drawn to.
 */
export interface PlanTarget {
  /**
   * The target of the pass, or `depth`.
   */
  name: string;
  /**
   * The result.
   */
  result: string;
  /**
   * Its texture.
   */
  texture: number;
  /**
   * The layer that is drawn to; null for all of them, as the reflection's `draw.layers` says.
   */
  layer: number | null;
  /**
   * The mip level.
   */
  level: number;
  /**
   * Whether what is there is kept or cleared.
   */
  load: "load" | "clear";
  /**
   * The number of the value that it is cleared to: a `vec4`, or a `float` of depths; null for transparent black, or a depth of 1. What the pass itself says is contained in it.
   */
  clear: number | null;
  /**
   * Whether anybody needs what is drawn.
   */
  store: boolean;
  /**
   * Where the mean of each texel's samples is written behind the step, of a texture with several; null if nobody reads it.
   */
  resolve: null | {
    /**
     * A texture with one sample, in which others find the result.
     */
    texture: number;
    /**
     * Its layer.
     */
    layer: number;
    /**
     * Its mip level.
     */
    level: number;
  };
  /**
   * The result that is there before and is drawn over.
   */
  over: string | null;
  /**
   * What becomes of the stencil values beside depths, if there are any.
   */
  stencil?: {
    /**
     * Whether what is there is kept or cleared.
     */
    load: "load" | "clear";
    /**
     * Whether a later step finds them.
     */
    store: boolean;
    /**
     * What they are cleared to.
     */
    clear: 0;
  };
}
/**
 * What is drawn, one draw behind the other.
 */
export interface PlanDrawn {
  /**
   * Models, in the order of the scene; null for vertices without vertex inputs.
   */
  models: string | null;
  /**
   * The number of the value that says how many vertices are drawn; null for models.
   */
  vertices: number | null;
  /**
   * The entry of the rig for each of whose lights all of this is drawn once: of an array, for as many as its `count` says. The shader has the parameters of a single light of this name, which both documents may call by the name of the rig, too: `Studio.lamps`.
   */
  light: string | null;
  /**
   * The shaders.
   */
  uses: PlanUse[];
}
/**
 * A shader for the models of one material.
 */
export interface PlanUse {
  /**
   * The material; null where nothing but a triangle is drawn.
   */
  material: string | null;
  /**
   * The number of the shader.
   */
  shader: number;
  /**
   * What the frame sets.
   */
  inputs: PlanInput[];
}
/**
 * An input of a shader that the frame sets.
 */
export interface PlanInput {
  /**
   * The parameter, texture or buffer, as the shader's reflection calls it.
   */
  name: string;
  /**
   * The number of a value.
   */
  value?: number;
  /**
   * A result.
   */
  result?: string;
  /**
   * The number of its texture; null of a buffer.
   */
  texture?: number | null;
  /**
   * A texture or buffer of the host.
   */
  host?: string;
  /**
   * A result as the last frame left it.
   */
  previous?: string;
  /**
   * What is read in the first frame instead; null for a texture without contents.
   */
  initially?: null | PlanRead;
}
/**
 * A result, or something of the host.
 */
export interface PlanRead {
  /**
   * A result.
   */
  result?: string;
  /**
   * The number of its texture; null of a buffer.
   */
  texture?: number | null;
  /**
   * A texture or buffer of the host.
   */
  host?: string;
}
/**
 * A kernel that is run.
 */
export interface PlanRun {
  kind: "run";
  /**
   * The step.
   */
  name: string;
  barriers: PlanBarriers;
  buffer_barriers: PlanBufferBarriers;
  /**
   * Whether it is needed in the first frame only.
   */
  only_first: boolean;
  /**
   * The number of the shader.
   */
  shader: number;
  /**
   * What the frame sets.
   */
  inputs: PlanInput[];
  /**
   * The images that it writes.
   */
  images: {
    /**
     * The kernel's name for it.
     */
    name: string;
    /**
     * The result.
     */
    result: string;
    /**
     * Its texture.
     */
    texture: number;
  }[];
  /**
   * The buffers that it writes.
   */
  buffers: {
    /**
     * The kernel's name for it.
     */
    name: string;
    /**
     * The result.
     */
    result: string;
  }[];
  source: PlanPlace;
}
/**
 * A copy of a whole texture, where a step draws over something that others still need as it was.
 */
export interface PlanCopy {
  kind: "copy";
  /**
   * Whether the first frame is enough.
   */
  only_first?: boolean;
  barriers: PlanBarriers;
  buffer_barriers: PlanBufferBarriers;
  from: PlanRead;
  to: PlanRead;
}
/**
 * Something that the next frame reads.
 */
export interface PlanKept {
  /**
   * The result.
   */
  result: string;
  /**
   * Its texture; null of a buffer.
   */
  texture: number | null;
  /**
   * The texture that has what the last frame left; null of a buffer.
   */
  previous: number | null;
}
/**
 * What the frame gives.
 */
export interface PlanOutput {
  /**
   * Its name.
   */
  name: string;
  /**
   * The result.
   */
  result: string;
  /**
   * Its texture; null of a buffer.
   */
  texture: number | null;
  /**
   * Its doc comment.
   */
  doc: string;
  source: PlanPlace;
}
/**
 * A shader with its texts, and what its materials set.
 */
export interface PackagedShader {
  reflection: Reflection;
  /**
   * By profile, such as `wgsl:webgpu`, and stage.
   */
  texts: {
    [k: string]: {
      [k: string]: ShaderText;
    };
  };
  /**
   * The values of its parameters, by name.
   */
  values: {
    [k: string]: Value;
  };
  /**
   * What each parameter is of the scene, by name, if it is something of it.
   */
  roles: {
    [k: string]: string;
  };
  /**
   * What its parameters of lights are of the plan's, by name. Behind an array of which one light is meant stands `[]`.
   */
  lights: {
    [k: string]: string;
  };
  /**
   * The pictures that its textures are, by name.
   */
  textures: {
    [k: string]: number;
  };
  /**
   * What each texture is of the look of a model, by name, if it is something of it.
   */
  texture_roles: {
    [k: string]: string;
  };
  /**
   * The elements of its storage buffers in base64, by name.
   */
  buffers: {
    [k: string]: string;
  };
  /**
   * Where the host divides patches: the levels of the edges and the inside for which the geometries were made.
   */
  levels: number[] | null;
  /**
   * Its pipeline in the words of WebGPU; null without texts for it.
   */
  webgpu: null | WebGpuPipeline;
}
/**
 * Everything a host has to know about one material under one pass and one rig.
 */
export interface Reflection {
  /**
   * Version of this document's format.
   */
  format: 1;
  /**
   * The material.
   */
  material: string;
  /**
   * The pass.
   */
  pass: string;
  /**
   * The rig.
   */
  rig: string;
  /**
   * The material's doc comment; empty where there is none.
   */
  doc: string;
  /**
   * What is the same for all materials and backends; a backend's own row says where its text differs.
   */
  conventions: {
    /**
     * Clip space of the material's meaning.
     */
    clip_space: "x right, y up, z in 0..w";
    /**
     * Handedness of world space.
     */
    handedness: "right";
    /**
     * Winding of front faces.
     */
    front_face: "ccw";
    /**
     * Texel at the origin of texture coordinates; v points down.
     */
    texture_origin: "top_left";
    /**
     * Vectors are columns, and matrices are stored column after column.
     */
    matrices: "column";
  };
  /**
   * Uniform blocks in binding order.
   */
  blocks: Block[];
  /**
   * Declared parameters in order of declaration.
   */
  parameters: Parameter[];
  /**
   * Values of the derived blocks.
   */
  derived: Derived[];
  /**
   * What the host promises by `nonzero`, besides ranges and directions.
   */
  promises: Promise[];
  /**
   * Lights of the rig.
   */
  lights: Light[];
  /**
   * Storage buffers in order of declaration.
   */
  buffers: Buffer[];
  /**
   * Storage buffers that a kernel writes, in order of declaration; none for a material.
   */
  results: Result[];
  /**
   * Of a kernel, steps that compute how many elements each of the results has, or the width and height of its images; null for a material.
   */
  extent: Step[] | null;
  /**
   * How many invocations of a kernel stand side by side in a work group, along x, y and z; null for a material.
   *
   * @minItems 3
   * @maxItems 3
   */
  work_group: [number, number, number] | null;
  /**
   * Textures in order of declaration.
   */
  textures: Texture[];
  /**
   * Sampler states, one for each texture that is not merely loaded.
   */
  samplers: Sampler[];
  draw: Draw;
  /**
   * Whether the position of a vertex is the same number, bit by bit, in all programs that compute it in the same way, so that their depths are equal. The texts say so.
   */
  invariant_position: boolean;
  /**
   * What the host sets of the pipeline, as the pass asks for it.
   */
  render_state: {
    /**
     * Which triangles are not drawn, by the side that is seen of them.
     */
    cull: "none" | "back" | "front";
    /**
     * How the corners of a triangle go around if its front is seen. What an API has to be told is the backend's `front_face`.
     */
    front: "counter_clockwise" | "clockwise";
    /**
     * What is drawn of a triangle: all of it, or its edges as lines.
     */
    fill: "faces" | "lines";
    /**
     * How many samples each pixel of the targets and of the depths has. With several, the targets are resolved at the end: each pixel becomes the mean of its samples.
     */
    samples: 1 | 4;
    /**
     * The depth test.
     */
    depth: {
      /**
       * What depths are before anything is drawn.
       */
      clear: number;
      /**
       * How the depth of a fragment, on the left, has to compare with the one that is there, so that it is drawn.
       */
      compare:
        | "never"
        | "less"
        | "equal"
        | "less_equal"
        | "greater"
        | "not_equal"
        | "greater_equal"
        | "always";
      /**
       * Whether the depths of the fragments that are drawn are kept.
       */
      write: boolean;
      /**
       * How far triangles are moved away from the eye before the test, as all APIs define it: slope * m + constant * r, where m is what the depth changes from one pixel to the next, and r a step of the format at the largest depth of the triangle. Null: not at all. Lines of a mesh are never moved.
       */
      bias: null | {
        /**
         * In steps of the format.
         */
        constant: number;
        /**
         * In times of the slope.
         */
        slope: number;
        /**
         * How far both together move at most, if it is positive, or at least, if it is negative; 0: any distance.
         */
        clamp: number;
      };
    };
    /**
     * The stencil test; null: there is none, and nothing is written.
     */
    stencil: null | Stencil;
  };
  /**
   * What is written of each vertex to one buffer, instead of drawing; null for a pass that draws, and for a kernel.
   */
  capture: null | Capture;
  /**
   * Vertex inputs.
   */
  vertex_inputs: VertexInput[];
  /**
   * What each stage reads of the pipeline itself, by stage: one row for each stage that there is.
   */
  pipeline_inputs: {
    [k: string]: PipelineInputs;
  };
  /**
   * Varyings.
   */
  varyings: Varying[];
  /**
   * Render targets; of a kernel over images, its images in order of declaration, which are the render targets of its full-screen pass.
   */
  targets: Target[];
  /**
   * Emitted profiles by name.
   */
  backends: {
    [k: string]: Backend;
  };
}
/**
 * A uniform block, the same bytes on every backend.
 */
export interface Block {
  /**
   * Name by which other parts of this document refer to it.
   */
  name: string;
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * Whether the host computes its contents from other parameters.
   */
  derived: boolean;
  /**
   * Whether the file says of it that the host owns it: names, offsets and binding are the host's.
   */
  extern: boolean;
  /**
   * Bytes, a multiple of 16.
   */
  size: number;
  stages: Stages;
  /**
   * Members in order, padding included; they leave no gap. A text does not write padding that all languages leave by themselves.
   */
  members: {
    /**
     * Suggested identifier; each backend says what it became.
     */
    name: string;
    /**
     * Stored type.
     */
    type: string;
    /**
     * Bytes from the start of the block.
     */
    offset: number;
    /**
     * Bytes.
     */
    size: number;
    /**
     * Parameter that it holds; null for padding.
     */
    parameter: string | null;
  }[];
  /**
   * Stored structs that members use, those inside others first.
   */
  structs: Struct[];
}
/**
 * A value that the host computes in double precision from stored parameters and rounds once; where `layout` has a `count`, one for each element of an array.
 */
export interface Derived {
  /**
   * Name in its block; of a table's member with the table's name before it, `lamps_derived.falloff_cos`.
   */
  name: string;
  /**
   * The type on the machine: `float`, `vec3`, `Lamp[8]`.
   */
  representation: string;
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * Block that holds it; null where the program reads nothing of that block.
   */
  block: string | null;
  /**
   * Bytes from the start of the block; null without a block.
   */
  offset: number | null;
  /**
   * Bytes of the stored value, padding inside it included.
   */
  size: number;
  layout: Layout;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
  /**
   * The computation, operands first; the last step is the value. Where `layout` has a `count` it is done for each element, whose number is the `bound` outside of bodies.
   */
  steps: Step[];
}
/**
 * A vector that is not zero wherever a shader uses it.
 */
export interface Promise {
  /**
   * The vector as a formula in Burnish.
   */
  value: string;
  /**
   * It is at least so long.
   */
  least_length: number;
  /**
   * The parameters that it depends on.
   */
  parameters: string[];
}
/**
 * A storage buffer that a kernel writes: each element once, or, if it is scattered to, as often as invocations choose it. What fills gaps is not written.
 */
export interface Result {
  /**
   * Name as the host says it, `lanterns` or `torch.bulbs`.
   */
  name: string;
  /**
   * The type as written: `Lantern[]`.
   */
  type: string;
  /**
   * The type on the machine: `vec3[]`.
   */
  representation: string;
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * Bytes from one element to the next.
   */
  stride: number;
  layout: Layout;
  /**
   * Members of an element that is a struct.
   */
  members: Member[];
  /**
   * Stored structs that elements use, those inside others first.
   */
  structs: Struct[];
  /**
   * Doc comment.
   */
  doc: string;
  /**
   * Steps that compute how many elements it has.
   */
  count: Step[];
  /**
   * How invocations join their values with elements; null if each writes its own.
   */
  scattered: "add" | "min" | "max" | "and" | "or" | null;
  /**
   * What each element has to be before the kernel runs, so that it then has what was scattered; null if that does not matter.
   */
  initial: number | null;
}
/**
 * A texture.
 */
export interface Texture {
  /**
   * Name as the host says it, `lamps` or `torch.axis`.
   */
  name: string;
  /**
   * Type as declared, such as `texture2d` or `depth_cube`.
   */
  type: string;
  /**
   * Dimension.
   */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /**
   * What it holds: colours, depths to compare with, or whole numbers. Whether colours are stored as sRGB is the format's business, and so the host's.
   */
  sample: "float" | "depth" | "int" | "uint";
  /**
   * What a WebGPU bind group layout says of it, in WebGPU's words.
   */
  layout: {
    /**
     * GPUTextureViewDimension.
     */
    viewDimension: "2d" | "2d-array" | "3d" | "cube";
    /**
     * GPUTextureSampleType; `unfilterable-float` where nothing filters, so that formats fit that cannot be filtered.
     */
    sampleType: "float" | "unfilterable-float" | "depth" | "sint" | "uint";
    /**
     * GPUSamplerBindingType; null where no sampler reads it.
     */
    sampler: "filtering" | "non-filtering" | "comparison" | null;
  };
  /**
   * Group the host updates together: `frame`, `view`, `rig`, `material`, `draw` or a user's own.
   */
  group: string;
  /**
   * What to bind before a host sets one, such as `white`.
   */
  default: string;
  stages: Stages;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
  /**
   * Which declaration of the library it is, as for parameters; null where it is none of them.
   */
  library: string | null;
  /**
   * Whether it is made by steps that a light brings to frames, such as its shadow map. Where there is no frame, a host that wants to see what they make binds a texture of its own.
   */
  brought: boolean;
}
/**
 * The state of the sampler that reads a texture.
 */
export interface Sampler {
  /**
   * The texture.
   */
  texture: string;
  /**
   * Its state: what is filtered and compared, and what lies beyond the edges.
   */
  state: {
    /**
     * How texels of a level are joined.
     */
    filter: "linear" | "nearest";
    /**
     * How levels are joined; `none`: only the first one is read.
     */
    mip: "linear" | "nearest" | "none";
    /**
     * What lies beyond the edges.
     */
    wrap: "repeat" | "clamp" | "mirror";
    /**
     * How a reference, on the left, has to compare with a depth; absent where none is compared.
     */
    compare?: "less" | "less_equal" | "greater" | "greater_equal";
  };
}
/**
 * What is drawn, and how.
 */
export interface Draw {
  /**
   * What the mesh consists of.
   */
  primitive: "point" | "line" | "triangle" | "line_adjacency" | "triangle_adjacency" | "patch";
  /**
   * How many vertices each of these has.
   */
  corners: number;
  /**
   * What turns each primitive into others: the geometry stage, or a draw of one instance for each; null where they are drawn as they are.
   */
  expanded_by: "geometry" | "instances" | null;
  /**
   * How many vertices a primitive, or a patch, turns into at most: of each instance, a list of triangles or lines; null where they are drawn as they are, or where the host makes the pattern. Where it makes the pattern and all parts of that are expanded, how many vertices each of these turns into.
   */
  vertices: number | null;
  /**
   * What the vertices of a draw call are, in turn: what the host tells the API.
   */
  topology: "point" | "line" | "triangle" | "line_adjacency" | "triangle_adjacency" | "patch";
  /**
   * The layers of the render targets; null where these are single pictures.
   */
  layers: {
    /**
     * How many there are.
     */
    count: number;
    /**
     * The parameter that says to which layer a draw belongs: there is one draw for each. Null where a single draw reaches all layers.
     */
    parameter: string | null;
  } | null;
  /**
   * How each patch is divided; null where there are none.
   */
  tessellation: null | Tessellation;
}
/**
 * How each patch of a mesh is divided.
 */
export interface Tessellation {
  /**
   * What is divided.
   */
  kind: "triangle" | "quad" | "isoline";
  /**
   * Which of a patch's control points are its corners. Those of a triangle have the weights x, y and z; those of a quad lie at (0, 0), (1, 0), (1, 1) and (0, 1); a line begins at the first one.
   */
  ends: number[];
  /**
   * How edges are divided: equally, or so that two of an even or odd number of steps are shorter.
   */
  spacing: "equal" | "fractional_even" | "fractional_odd";
  /**
   * What divides them: the tessellation stages, or a draw of one instance for each: its vertices are the points of a pattern that the host makes, or they find out by their numbers where they lie.
   */
  divided_by: "evaluation" | "instances";
  /**
   * The levels of that pattern; null where the texts compute them.
   */
  levels: {
    /**
     * For each edge the steps that compute its level: of a triangle those across from its ends, of a quad those at u = 0, v = 0, u = 1 and v = 1.
     */
    edges: Step[][];
    /**
     * Likewise for the inside; of a quad along u, and along v.
     */
    inside: Step[][];
  } | null;
}
/**
 * The stencil test of a pass. A host clears stencil values to 0.
 */
export interface Stencil {
  front: StencilSide;
  back: StencilSide;
  /**
   * What values are compared with, and what `replace` writes.
   */
  reference: number;
  /**
   * The bits that are compared.
   */
  read_mask: number;
  /**
   * The bits that are written.
   */
  write_mask: number;
}
/**
 * The test of triangles of which one side is seen; lines have no back.
 */
export interface StencilSide {
  /**
   * How the reference, on the left, has to compare with the value that is there, both masked by `read_mask`.
   */
  compare:
    | "never"
    | "less"
    | "equal"
    | "less_equal"
    | "greater"
    | "not_equal"
    | "greater_equal"
    | "always";
  /**
   * What becomes of the value where the comparison fails.
   */
  fail: StencilOperation;
  /**
   * Where only the depth test fails.
   */
  depth_fail: StencilOperation;
  /**
   * Where both let the fragment through.
   */
  pass: StencilOperation;
}
/**
 * Captured vertices: all values of a vertex without gaps, one vertex behind the other.
 */
export interface Capture {
  /**
   * What the captured vertices are: points, lines of two each, or triangles of three each.
   */
  primitive: "point" | "line" | "triangle";
  /**
   * How many vertices come of each primitive that is drawn, at most.
   */
  vertices: number;
  /**
   * Bytes of each vertex.
   */
  stride: number;
  /**
   * The result that has the vertices, where a kernel captures; null for a stream output.
   */
  buffer: string | null;
  /**
   * Where a kernel writes of each vertex, behind its values, whether it is there, 1 or 0: in bytes from where the vertex begins, which then has 4 bytes more. Null where all vertices are there, and for a stream output.
   */
  there: number | null;
  /**
   * The values, in order.
   */
  members: Captured[];
}
/**
 * A captured value.
 */
export interface Captured {
  /**
   * Its name.
   */
  name: string;
  /**
   * As declared.
   */
  type: string;
  /**
   * Its type without meaning: a number of 32 bits, or a vector of these.
   */
  representation: string;
  /**
   * Bytes from where the vertex begins.
   */
  offset: number;
  /**
   * Its doc comment; empty where there is none.
   */
  doc: string;
}
/**
 * A vertex input that the program reads.
 */
export interface VertexInput {
  /**
   * Name as declared; of a matrix's column with its number, `bend.0`.
   */
  name: string;
  /**
   * The type as written: `rgb`, `direction<world>`, `Lamp[8]`.
   */
  type: string;
  /**
   * The type on the machine: `float`, `vec3`, `Lamp[8]`.
   */
  representation: string;
  /**
   * Location; null where a buffer has its values.
   */
  location: number | null;
  /**
   * Where a kernel captures vertices, or corners need more than 16 vertex inputs, the storage buffer whose elements have its values, and the member that does; else null.
   */
  buffer: {
    /**
     * The buffer.
     */
    name: string;
    /**
     * The member of its elements.
     */
    member: string;
  } | null;
  /**
   * Whether each vertex has a value of its own, or each instance.
   */
  step: "vertex" | "instance";
  /**
   * The declared matrix that this is a column of, and which; null for others.
   */
  column: {
    /**
     * The matrix.
     */
    of: string;
    /**
     * From 0.
     */
    index: number;
  } | null;
  /**
   * Where each primitive of a mesh is drawn as an instance, what this is in the mesh; null elsewhere.
   */
  mesh: {
    /**
     * The vertex input as declared, or the number that the host counts.
     */
    name: string;
    /**
     * The corner of the primitive whose value it is, from 0, or of the pattern's triangle or line; null where a whole instance of the mesh has one value, or a point of the pattern.
     */
    corner: number | null;
    /**
     * Whether it is the number of a vertex, an instance or a primitive of the mesh.
     */
    is_number: boolean;
    /**
     * Whether it is where a point of the pattern lies in a patch.
     */
    is_of_pattern: boolean;
  } | null;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
}
/**
 * Values that cross from one stage to the next.
 */
export interface Varying {
  /**
   * Name of the slot.
   */
  name: string;
  /**
   * The type on the machine: `float`, `vec3`, `Lamp[8]`.
   */
  representation: string;
  /**
   * Location.
   */
  location: number;
  /**
   * Interpolation.
   */
  mode: "perspective" | "flat";
  /**
   * The stage that computes it, `vertex`.
   */
  from: string;
  /**
   * The stage that reads it, `fragment`.
   */
  to: string;
}
/**
 * A render target and the fixed-function state it wants.
 */
export interface Target {
  /**
   * Name in the pass.
   */
  name: string;
  /**
   * Type that is written.
   */
  representation: string;
  /**
   * Location.
   */
  location: number;
  /**
   * Pixel format, `rgba8`.
   */
  format: string;
  /**
   * How what is drawn is blended with what is there; null where it takes its place.
   */
  blend: {
    color: BlendEquation;
    alpha: BlendEquation;
  } | null;
  /**
   * Which lanes are written of those that the format has: some of `rgba`, in this order, or `none`.
   */
  mask: string;
  /**
   * What is there before anything is drawn, in four lanes; null where that is the host's affair.
   *
   * @minItems 4
   * @maxItems 4
   */
  clear: [number, number, number, number] | null;
  /**
   * Doc comment; empty where there is none.
   */
  doc: string;
}
/**
 * What is kept of two colours, or of two alphas: source * what is drawn, joined with destination * what is there. `subtract` takes the second product from the first; `min` and `max` have no factors, and both are `one`.
 */
export interface BlendEquation {
  source: BlendFactor;
  destination: BlendFactor;
  /**
   * How the products are joined.
   */
  operation: "add" | "subtract" | "reverse_subtract" | "min" | "max";
}
/**
 * What one profile's text says.
 */
export interface Backend {
  /**
   * Where the statements of each file come from, by file name.
   */
  source_maps: {
    [k: string]: SourceMap;
  };
  /**
   * Language of the text: `hlsl`, `glsl`, `wgsl` …
   */
  language: string;
  /**
   * Depth range of clip space that the text writes.
   */
  clip_depth: "0..1" | "-1..1";
  /**
   * What a host gives to OpenGL's `glClipControl`: its origin and its depth mode. Empty where a host does not call it.
   */
  clip_control: string[];
  /**
   * Whether the text negates clip y.
   */
  flip_y: boolean;
  /**
   * Winding that a host has to set as front, in the API's own terms.
   */
  front_face: "ccw" | "cw";
  /**
   * Which row of the picture comes first in the framebuffer's memory.
   */
  first_row: "top" | "bottom";
  /**
   * Emitted files.
   */
  files: {
    /**
     * The stage, such as `vertex`.
     */
    stage: string;
    /**
     * File name, relative to this document.
     */
    file: string;
    /**
     * Entry point in the file.
     */
    entry_point: string;
  }[];
  /**
   * Blocks by name.
   */
  blocks: {
    [k: string]: BlockBinding;
  };
  /**
   * Images that a kernel writes, by name; none where it is a full-screen pass, of which they are the render targets.
   */
  images: {
    [k: string]: Binding;
  };
  /**
   * Storage buffers by name.
   */
  buffers: {
    [k: string]: Binding;
  };
  /**
   * Textures by name; together with their samplers where the profile combines the two.
   */
  textures: {
    [k: string]: Binding;
  };
  /**
   * Samplers by the name of the texture; empty where the profile combines the two.
   */
  samplers: {
    [k: string]: Binding;
  };
  /**
   * Vertex inputs by name.
   */
  vertex_inputs: {
    [k: string]: VertexInputName;
  };
  /**
   * How a host captures vertices: as the text says, by the names of outputs that it gives before linking, by their semantics; null where the profile has no stream output.
   */
  stream_output: "text" | "names" | "semantics" | null;
  /**
   * The outputs that hold captured values, by name of the value: those that OpenGL is told before it links, or whose semantics Direct3D's stream output names. Empty where the profile has no stream output, or a kernel captures.
   */
  captures: {
    [k: string]: VertexInputName;
  };
  /**
   * Loose float uniforms that the host sets besides the blocks.
   */
  host_uniforms: string[];
}
/**
 * What in Burnish text each statement of an emitted file computes, or is there for.
 */
export interface SourceMap {
  /**
   * Burnish files by name, as given to the compiler; those of the library begin with `std/`.
   */
  sources: string[];
  /**
   * Rows of five numbers, in the order of the text: a line of it, then the number of a source counted from 0, the line and the column in it, and how many characters it is.
   */
  lines: [number, number, number, number, number][];
}
/**
 * Where a block is bound.
 */
export interface BlockBinding {
  /**
   * Name in the text.
   */
  identifier: string;
  /**
   * Bind group, descriptor set or register space; null where the host binds by name.
   */
  group: number | null;
  /**
   * Number within the group; null where the host binds by name.
   */
  binding: number | null;
  /**
   * What the language itself calls the binding, `b0` in HLSL; null where it has no word for it.
   */
  register: string | null;
  /**
   * Identifiers in the text by member name in the block.
   */
  members: {
    [k: string]: string;
  };
}
/**
 * Where a texture or sampler is bound.
 */
export interface Binding {
  /**
   * Name in the text.
   */
  identifier: string;
  /**
   * Bind group, descriptor set or register space; null where the host binds by name.
   */
  group: number | null;
  /**
   * Number within the group; null where the host binds by name.
   */
  binding: number | null;
  /**
   * What the language itself calls the binding, `b0` in HLSL; null where it has no word for it.
   */
  register: string | null;
}
/**
 * How a vertex input is called.
 */
export interface VertexInputName {
  /**
   * Name in the text.
   */
  identifier: string;
  /**
   * HLSL semantic; null elsewhere.
   */
  semantic: string | null;
}
/**
 * The text of a stage.
 */
export interface ShaderText {
  /**
   * The text.
   */
  text: string;
  /**
   * Its entry point.
   */
  entry: string;
}
/**
 * A pipeline in the words of WebGPU, but for its texts.
 */
export interface WebGpuPipeline {
  /**
   * What is bound, group by group; a group that is not used is empty.
   */
  groups: Slot[][];
  /**
   * The vertex buffers.
   */
  buffers: GPUVertexBufferLayout[];
  /**
   * What each target is drawn with.
   */
  targets: GPUColorTargetState[];
  /**
   * How primitives are drawn.
   */
  primitive: GPUPrimitiveState;
  /**
   * The tests of depths and stencil values, but for the format.
   */
  depthStencil: Omit<GPUDepthStencilState, "format">;
}
/**
 * What a shader reads or writes at one place of a group.
 */
export interface Slot {
  /**
   * What it is.
   */
  kind: "block" | "buffer" | "storage_texture" | "texture" | "sampler";
  /**
   * The reflection's name for it; of a sampler, that of its texture.
   */
  name: string;
  /**
   * Its number among those of its kind.
   */
  number: number;
  /**
   * Its place.
   */
  layout: GPUBindGroupLayoutEntry;
  /**
   * The state of a sampler.
   */
  sampler?: GPUSamplerDescriptor;
}
/**
 * A pipeline of a shader: the formats of what it draws to.
 */
export interface PipelineRow {
  /**
   * The number of the shader.
   */
  shader: number;
  /**
   * The formats of the targets; none of a kernel that is computed.
   */
  targets: GPUTextureFormat[];
  /**
   * The format of the depths; null where there are none.
   */
  depth: GPUTextureFormat | null;
}
/**
 * What looks at the scene. Both are values of the scene, by their roles.
 */
export interface Camera {
  /**
   * World space to the clip space of a square picture: four columns. For a picture that is `a` times as wide as high, the host divides the first row by `a`.
   */
  view_projection: number[][];
  /**
   * Where it stands.
   */
  eye: number[];
}
/**
 * A model of the scene.
 */
export interface Model {
  /**
   * Its material.
   */
  material: string;
  /**
   * The names by which steps draw it.
   */
  tags: string[];
  /**
   * What each shader that draws it gets of its mesh, by the shader's number.
   */
  geometries: {
    [k: string]: number;
  };
  /**
   * Values by role: `object_to_world`, bones, colours.
   */
  values: {
    [k: string]: Value;
  };
  /**
   * Pictures by role.
   */
  textures: {
    [k: string]: number;
  };
}
/**
 * What a draw call gets of a mesh. Numbers have 32 bits, and are little-endian and in base64. A vertex, or an instance, has the vertex inputs of the reflection that step with it, one behind the other, but for those that are in a buffer.
 */
export interface Geometry {
  /**
   * The inputs of all vertices; empty if there are none.
   */
  vertices: string;
  /**
   * The inputs of all instances; empty if there are none.
   */
  instances: string;
  /**
   * The numbers of the vertices that are drawn; null where they are drawn one after the other.
   */
  indices: string | null;
  /**
   * How many vertices are drawn of each instance.
   */
  count: number;
  /**
   * How many instances there are.
   */
  instance_count: number;
  /**
   * The elements of storage buffers that stand for vertex inputs, in base64, by the buffer's name.
   */
  elements: {
    [k: string]: string;
  };
}
/**
 * Texels with all mip levels.
 */
export interface Picture {
  /**
   * The format, as WebGPU calls it.
   */
  format: GPUTextureFormat;
  /**
   * The dimension.
   */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /**
   * The width.
   */
  width: number;
  /**
   * The height.
   */
  height: number;
  /**
   * Layers, faces, or slices of the first level.
   */
  depth: number;
  /**
   * Each level in base64, layer by layer and row by row from the top.
   */
  levels: string[];
}
