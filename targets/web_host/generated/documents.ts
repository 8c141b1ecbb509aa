// Generated from the records of documents (compiler/documents, documents.py) by the tests: do not edit.

/** An attachment: a texture that a target of the pass, or its depths, is drawn to. */
export interface AttachmentRow {
  /** The target of the pass, or `depth`. */
  name: string;
  /** The result. */
  result: string;
  /** Texture. */
  texture: number;
  /** The layer that is drawn to; null for all, as the reflection's `draw.layers` says. */
  layer: number | null;
  /** The mip level. */
  level: number;
  /** Start of the step: keep the contents, or clear them. */
  load: "load" | "clear";
  /**
   * Number of the value that it is cleared to: a `vec4`, or a `float` of depths. Null for
   * transparent black, or a depth of 1. The value of the pass itself is contained in it.
   */
  clear: number | null;
  /** True if anybody reads the result. */
  store: boolean;
  /**
   * Texture to which the mean of each texel's samples is written behind the step. It is that of an
   * attachment with several samples; null if nobody reads it.
   */
  resolve: ResolveRow | null;
  /** The result that is there before and is drawn over. */
  over: string | null;
  /** Handling of the stencil values beside depths; null if there are none. */
  stencil: StencilLoad | null;
}

/** One profile's texts. */
export interface BackendRow {
  /** The origin of the statements of each file, by file name. */
  source_maps: Record<string, SourceMapRow>;
  /** Language of the text: `hlsl`, `glsl`, `wgsl` … */
  language: string;
  /** Depth range of clip space that the text writes. */
  clip_depth: "0..1" | "-1..1";
  /**
   * The arguments that a host gives to OpenGL's `glClipControl`: its origin and its depth mode.
   * Empty where a host does not call it.
   */
  clip_control: string[];
  /** True if the text negates clip y. */
  flip_y: boolean;
  /** Winding that a host has to set as front, in the API's own terms. */
  front_face: "ccw" | "cw";
  /** The row of the picture that comes first in the framebuffer's memory. */
  first_row: "top" | "bottom";
  /** Emitted files. */
  files: FileRow[];
  /** Blocks by name. */
  blocks: Record<string, BlockBindingRow>;
  /**
   * Images that a kernel writes, by name. There are none where the kernel is a full-screen pass,
   * whose render targets they are.
   */
  images: Record<string, BindingRow>;
  /** Storage buffers by name. */
  buffers: Record<string, BindingRow>;
  /** Textures by name; together with their samplers where the profile combines the two. */
  textures: Record<string, BindingRow>;
  /** Samplers by the name of the texture; empty where the profile combines the two. */
  samplers: Record<string, BindingRow>;
  /** Vertex inputs by name. */
  vertex_inputs: Record<string, VertexInputNameRow>;
  /**
   * The way in which a host captures vertices. `text`: as the text says. `names`: by the names of
   * outputs that it gives before linking. `semantics`: by their semantics. Null where the profile
   * has no stream output.
   */
  stream_output: "text" | "names" | "semantics" | null;
  /**
   * The outputs that hold captured values, by name of the value. OpenGL is told them before it
   * links, or Direct3D's stream output names their semantics. Empty where the profile has no stream
   * output, or a kernel captures.
   */
  captures: Record<string, VertexInputNameRow>;
  /** Loose float uniforms that the host sets besides the blocks. */
  host_uniforms: string[];
}

/**
 * A change of a texture's use from here on. Earlier writes have to be complete; `undefined` means
 * that the texture has no contents yet.
 */
export interface BarrierRow {
  /** True if the barrier stands in the first frame only. */
  only_first: boolean;
  /** The texture. */
  texture: number;
  /** Use before. */
  before: "undefined" | "target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to";
  /** Use from here on. */
  after: "target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to";
}

/** The binding of a texture or sampler. */
export interface BindingRow {
  /** Name in the text. */
  identifier: string;
  /** Bind group, descriptor set or register space; null where the host binds by name. */
  group: number | null;
  /** Number within the group; null where the host binds by name. */
  binding: number | null;
  /** Name of the binding in the language itself, `b0` in HLSL; null where it has none. */
  register: string | null;
}

/** The blending of a target. */
export interface Blend {
  color: BlendEquation;
  alpha: BlendEquation;
}

/**
 * The equation of two colours, or of two alphas: `source * src operation destination * dst`. Where
 * the operation has no factors, both are `one`, as WebGPU wants them.
 */
export interface BlendEquation {
  /**
   * The factor of the colour that is drawn. `src` is the colour that is drawn, `dst` the one in the
   * target, and `constant` the one that the host sets for the whole pass.
   */
  source: "zero" | "one" | "src" | "one_minus_src" | "src_alpha" | "one_minus_src_alpha" | "dst" | "one_minus_dst" | "dst_alpha" | "one_minus_dst_alpha" | "src_alpha_saturated" | "constant" | "one_minus_constant";
  /** The factor of the colour in the target. */
  destination: "zero" | "one" | "src" | "one_minus_src" | "src_alpha" | "one_minus_src_alpha" | "dst" | "one_minus_dst" | "dst_alpha" | "one_minus_dst_alpha" | "src_alpha_saturated" | "constant" | "one_minus_constant";
  /** The operation that joins the products: `subtract` takes the second one from the first. */
  operation: "add" | "subtract" | "reverse_subtract" | "min" | "max";
}

/** The binding of a block. */
export interface BlockBindingRow {
  /** Name in the text. */
  identifier: string;
  /** Bind group, descriptor set or register space; null where the host binds by name. */
  group: number | null;
  /** Number within the group; null where the host binds by name. */
  binding: number | null;
  /** Name of the binding in the language itself, `b0` in HLSL; null where it has none. */
  register: string | null;
  /** Identifiers in the text by member name in the block. */
  members: Record<string, string>;
}

/** One member. */
export interface BlockMember {
  /** Suggested identifier; each backend says its final name. */
  name: string;
  /** Stored type. */
  type: string;
  /** Bytes from the start of the block. */
  offset: number;
  /** Bytes. */
  size: number;
  /** Parameter that it holds; null for padding. */
  parameter: string | null;
}

/** A uniform block, the same bytes on every backend. */
export interface BlockRow {
  /** Name by which other parts of this document refer to it. */
  name: string;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /** True if the host computes its contents from other parameters. */
  derived: boolean;
  /** True if the file says that the host owns it: names, offsets and binding are the host's. */
  extern: boolean;
  /** Bytes, a multiple of 16. */
  size: number;
  /** Stages that read it. */
  stages: string[];
  /**
   * A digest of the members, with their types and offsets, and of the structs. Blocks with one id
   * have the same bytes for the same values, in whatever material.
   */
  layout_id: string;
  /**
   * Members in order, padding included; they leave no gap. A text does not write padding that all
   * languages leave by themselves.
   */
  members: BlockMember[];
  /** Stored structs that members use, those inside others first. */
  structs: StructRow[];
}

/** A variable of a body: of `fold` the number of the term, of `apply` an argument. */
export interface BoundStep {
  op: "bound";
  /** Type of the result. */
  type: string;
  args: [];
  /**
   * The enclosing variable, counted outwards from 0. Outside of all bodies, this is the number of
   * the element.
   */
  binder: number;
}

/**
 * A change of a result's buffer's use from here on. Earlier writes and reads have to be complete.
 */
export interface BufferBarrierRow {
  /** The result. */
  result: string;
  /** Use before; `undefined` means that its contents do not matter. */
  before: "undefined" | "written" | "read";
  /** Use from here on. */
  after: "written" | "read";
  /** True if the barrier stands in the first frame only. */
  only_first: boolean;
}

/** A storage buffer, the same bytes on every backend. */
export interface BufferRow {
  /** Name as the host says it, `lanterns` or `torch.bulbs`. */
  name: string;
  /** The type as written: `Lantern[]`. */
  type: string;
  /** The type on the machine: `vec3[]`. */
  representation: string;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /**
   * The parameter that says how many elements there are. A buffer without elements is bound with
   * one of zeros.
   */
  count: string;
  /** Bytes from one element to the next. */
  stride: number;
  layout: LayoutRow;
  /** Members of an element that is a struct. */
  members: MemberRow[];
  /** Stored structs that elements use, those inside others first. */
  structs: StructRow[];
  /** Stages that read it. */
  stages: string[];
  /** Doc comment. */
  doc: string;
}

/** The call of a builtin, as Burnish defines it, or as hardware does. */
export interface CallStep {
  op: "call" | "native";
  /** Type of the result. */
  type: string;
  /** The builtin's arguments. */
  args: number[];
  /** The builtin's name. */
  function: string;
}

/** What looks at the scene. Both are values of the scene, by their roles. */
export interface CameraRow {
  /**
   * World space to the clip space of a square picture: four columns. For a picture that is `a`
   * times as wide as high, the host divides the first row by `a`.
   */
  view_projection: number[][];
  /** Where it stands. */
  eye: number[];
}

/** Captured vertices: all values of a vertex without gaps, one vertex behind the other. */
export interface CaptureRow {
  /** Captured primitives: points, lines of two vertices each, or triangles of three each. */
  primitive: "point" | "line" | "triangle";
  /** Largest number of vertices for each primitive that is drawn. */
  vertices: number;
  /** Bytes of each vertex. */
  stride: number;
  /** The result that has the vertices, where a kernel captures; null for a stream output. */
  buffer: string | null;
  /**
   * Offset of a flag behind the values of a vertex, in bytes from where the vertex begins. The flag
   * is 1 if the vertex is there, and 0 if not; the vertex then has 4 bytes more. A kernel writes
   * it. Null where all vertices are there, and for a stream output.
   */
  there: number | null;
  /** The values, in order. */
  members: CapturedRow[];
}

/** A captured value. */
export interface CapturedRow {
  /** Name of the value. */
  name: string;
  /** Type as declared. */
  type: string;
  /** Type without meaning: a number of 32 bits, or a vector of these. */
  representation: string;
  /** Bytes from where the vertex begins. */
  offset: number;
  /** Doc comment; empty where there is none. */
  doc: string;
}

/**
 * Parts that are put together. Numbers and vectors make a vector, columns a matrix, and elements an
 * array. For `apply`, the parts are a body and then the values of its variables.
 */
export interface ComposedStep {
  op: "vector" | "matrix" | "array" | "apply";
  /** Type of the result. */
  type: string;
  /** The parts. */
  args: number[];
}

/** A number, a vector or a matrix. */
export interface ConstantStep {
  op: "constant";
  /** Type of the result. */
  type: string;
  args: [];
  /** The value. */
  value: Lanes;
}

/**
 * The conventions of all materials and backends. A backend's own row says where its text differs.
 */
export interface Conventions {
  /** Clip space of the material's meaning. */
  clip_space: "x right, y up, z in 0..w";
  /** Handedness of world space. */
  handedness: "right";
  /** Winding of front faces. */
  front_face: "ccw";
  /** Texel at the origin of texture coordinates; v points down. */
  texture_origin: "top_left";
  /** Vectors are columns, and matrices are stored column after column. */
  matrices: "column";
}

/** One end of a copy. */
export interface CopyEnd {
  /** The result. */
  result: string;
  /** The number of its texture. */
  texture: number;
}

/** A copy of a whole texture, before a step draws over a result that others need as it was. */
export interface CopyStep {
  kind: "copy";
  /** The textures that are waited for. */
  barriers: BarrierRow[];
  /** The buffers of results that are waited for. */
  buffer_barriers: BufferBarrierRow[];
  /** Source of the copy. */
  copied: CopyEnd;
  /** Destination of the copy. */
  into: CopyEnd;
  /** True if the first frame is enough. */
  only_first: boolean;
}

/** The depth test: its comparison, whether depths are kept, and the depth bias before it. */
export interface DepthState {
  /**
   * The comparison of a fragment's depth, on the left, with the one in the attachment. The fragment
   * is drawn if it holds.
   */
  compare: "never" | "less" | "equal" | "less_equal" | "greater" | "not_equal" | "greater_equal" | "always";
  /** True if the depths of the fragments that are drawn are kept. */
  write: boolean;
  /** The depth of all pixels before anything is drawn. */
  clear: number;
  /**
   * A constant bias, in steps of the format at the farthest corner of the face. Lines of a mesh are
   * never moved.
   */
  bias: number;
  /** A bias as a multiple of the depth's change from one pixel to the next. */
  slope_bias: number;
  /** The limit of both together: an upper one if positive, a lower one if negative; 0 for none. */
  bias_clamp: number;
}

/**
 * A value that the host computes in double precision from stored parameters and rounds once. Where
 * `layout` has a `count`, there is one for each element of an array.
 */
export interface DerivedRow {
  /**
   * Name in its block. For a table's member, the table's name stands before it,
   * `lamps_derived.falloff_cos`.
   */
  name: string;
  /** The type on the machine: `float`, `vec3`, `Lamp[8]`. */
  representation: string;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /** Block that holds it; null where the program reads nothing of that block. */
  block: string | null;
  /** Bytes from the start of the block; null without a block. */
  offset: number | null;
  /** Bytes of the stored value, padding inside it included. */
  size: number;
  layout: LayoutRow;
  /** Doc comment; empty where there is none. */
  doc: string;
  /**
   * The computation, operands first; the last step is the value. Where `layout` has a `count` it is
   * done for each element, whose number is the `bound` outside of bodies.
   */
  steps: (ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[];
}

/** The draw call, and the primitives that it draws. */
export interface DrawRow {
  /** Primitives of the mesh. */
  primitive: "point" | "line" | "triangle" | "line_adjacency" | "triangle_adjacency" | "patch";
  /** Number of vertices of each of these primitives. */
  corners: number;
  /**
   * The means of expansion: the geometry stage, or a draw of one instance for each primitive. Null
   * where primitives are drawn as they are.
   */
  expanded_by: "geometry" | "instances" | null;
  /**
   * Largest number of vertices that a primitive, or a patch, turns into. For each instance, this is
   * a list of triangles or lines. Null where they are drawn as they are, or where the host makes
   * the pattern. Where it makes the pattern and all parts of that are expanded, it is the number
   * for each of these parts.
   */
  vertices: number | null;
  /** Primitives of a draw call's vertices, in turn, for the host to tell the API. */
  topology: "point" | "line" | "triangle" | "line_adjacency" | "triangle_adjacency" | "patch";
  /** The layers of the render targets; null where these are single pictures. */
  layers: LayersRow | null;
  /** Division of each patch; null where there are none. */
  tessellation: TessellationRow | null;
}

/** A pass that is drawn. */
export interface DrawStep {
  kind: "draw";
  /** The step. */
  name: string;
  /** The pass. */
  pass: string;
  /** The textures that are waited for. */
  barriers: BarrierRow[];
  /** The buffers of results that are waited for. */
  buffer_barriers: BufferBarrierRow[];
  /** True if it is needed in the first frame only. */
  only_first: boolean;
  /** The targets, in the order of their locations. */
  targets: AttachmentRow[];
  /**
   * The depths; null where the pass has none. Then there is no depth test, whatever `render_state`
   * of its reflection says.
   */
  depth: AttachmentRow | null;
  /**
   * Number of the value that says into which part of the targets the clip volume is drawn. It is an
   * `ivec4` of left, top, width and height, in texels; null for all of the targets.
   */
  viewport: number | null;
  /**
   * Number of the value that says which part of the targets is drawn to, likewise. A part outside
   * of the targets is cut off.
   */
  scissor: number | null;
  /** The number of the value, a `vec4`, that the factor `constant` means in all targets. */
  blend_constant: number | null;
  /** The draws. */
  draws: DrawnRow[];
  source: PlaceRow;
  /**
   * True if it draws on to all attachments of the step before, and waits for nothing else. A host
   * can then draw both in one render pass, without storing and loading in between.
   */
  continues: boolean;
}

/** The draws, one behind the other. */
export interface DrawnRow {
  /** Models, in the order of the scene; null for vertices without vertex inputs. */
  models: string | null;
  /** The number of the value that says how many vertices are drawn; null for models. */
  vertices: number | null;
  /**
   * The entry of the rig for each of whose lights all of this is drawn once. For an array, it is
   * drawn for as many lights as its `count` says. The shader has the parameters of a single light
   * of this name, which both documents may call by the name of the rig, too: `Studio.lamps`.
   */
  light: string | null;
  /** The shaders. */
  uses: UseRow[];
}

/** The elements of a storage buffer. */
export interface ElementsRow {
  /** The buffer. */
  name: string;
  /** Its elements, in base64. */
  data: string;
}

/** One stage's text. */
export interface FileRow {
  /** The stage, such as `vertex`. */
  stage: string;
  /** File name, relative to this document. */
  file: string;
  /** Entry point in the file. */
  entry_point: string;
}

/** Terms that are combined one after the other. */
export interface FoldStep {
  op: "fold";
  /** Type of the result. */
  type: string;
  /** Number of terms, the value to begin with, and the body that is a term. */
  args: [number, number, number];
  /** Operator that combines the terms. */
  operator: "add" | "mul" | "min" | "max" | "and" | "or";
  /** The largest number of terms. */
  bound: number;
}

/**
 * All that a host does to draw a frame: its textures, and the steps that it executes in order. Each
 * shader has a reflection of its own.
 */
export interface FramePlan {
  /** Version of this document's format. A host refuses versions that it does not know. */
  plan: 2;
  /** The frame. */
  frame: string;
  /** The frame's doc comment; empty where there is none. */
  doc: string;
  source: PlaceRow;
  /** The rig of lights under which models are drawn. */
  rig: string;
  /**
   * Parameters that the host sets for the whole frame, as in reflections. No block holds them.
   * Those of the lights are among them, and are those of the same name in each shader, with or
   * without the name of the rig before it; shaders get others through the values of inputs alone.
   */
  parameters: ParameterRow[];
  /** The lights of the rig, as in reflections. */
  lights: LightRow[];
  /** Textures that the host binds for the whole frame. */
  host_textures: HostTextureRow[];
  /** Storage buffers that the host binds for the whole frame. */
  host_buffers: BufferRow[];
  /** Declarations of everything that the host sets, by name. */
  sources: Record<string, PlaceRow>;
  /** Models of the host's scene that passes draw. */
  models: ModelsRow[];
  /** The shaders; steps name them by their numbers here. */
  shaders: ShaderRow[];
  /**
   * Numbers that the host computes once for each frame, before the first step. It computes them
   * from the parameters, from those of the lights, and from the sizes of its textures. Steps and
   * textures name them by their numbers here.
   */
  values: ValueRow[];
  /** The textures that the host makes, by number. Each serves one result after the other. */
  textures: FrameTextureRow[];
  /** Results of the steps. */
  results: FrameResultRow[];
  /** The steps of the host, in this order. */
  steps: (DrawStep | RunStep | CopyStep)[];
  /**
   * The barriers behind the last step and before the exchange of `kept`. The host can then read the
   * outputs, and the next frame the kept textures and buffers.
   */
  end: WaitingRow;
  /**
   * Results that the next frame reads. Behind the last step the host exchanges each texture (or,
   * where the numbers are null, the result's buffer) with the previous one. Before the first frame,
   * these textures are transparent black, or depths of 1.
   */
  kept: KeptRow[];
  /** Outputs of the frame, to be read behind the last step and before the exchange of `kept`. */
  outputs: OutputRow[];
}

/** A result of a step. */
export interface FrameResultRow {
  /** The step's name and that of its target. */
  name: string;
  /** Kind of the result. */
  kind: "texture" | "buffer";
  /**
   * Number of the texture that holds it. Null for a buffer, which is the result's own, and for
   * samples that are not resolved.
   */
  texture: number | null;
  /** The step that makes it first. */
  first: number;
  /**
   * The last step of the frame that needs it. An output, a kept result, and a result of a step with
   * `only_first` are needed after the frame, too.
   */
  last: number;
  /** Doc comment. */
  doc: string;
  source: PlaceRow;
}

/** A texture. */
export interface FrameTextureRow {
  /**
   * A format of render targets or of depths, as passes name them. `rgba16f` are floats, `rgba8`
   * numbers from 0 to 1.
   */
  format: string;
  /** Dimension. */
  dimension: "2d" | "2d_array" | "cube";
  size: SizeRow;
  /** Layers, 6 of a cube. */
  layers: number;
  /** Mip levels. */
  levels: number;
  /**
   * Number of samples of each texel. A texture with several has one layer and one level, is drawn
   * to, and is not read.
   */
  samples: 1 | 4;
  /**
   * Uses of the texture by steps, and by the host or the next frame behind them. For the two
   * textures of a row of `kept`, these are the uses of either.
   */
  uses: ("target" | "depth" | "image" | "sampled" | "copied_from" | "copied_to")[];
  /**
   * True if a row of `kept` names it. Contents of others are needed in the next frame only where a
   * step with `only_first` drew them.
   */
  kept: boolean;
  /** The results that it holds, one after the other. */
  results: string[];
}

/**
 * What a draw call gets of a mesh. Numbers have 32 bits, and are little-endian and in base64. A
 * vertex, or an instance, has the vertex inputs of the reflection that step with it, one behind the
 * other, but for those that are in a buffer.
 */
export interface GeometryRow {
  /** The inputs of all vertices; empty if there are none. */
  vertices: string;
  /** The inputs of all instances; empty if there are none. */
  instances: string;
  /** The numbers of the vertices that are drawn; null where they are drawn one after the other. */
  indices: string | null;
  /** How many vertices are drawn of each instance. */
  count: number;
  /** How many instances there are. */
  instance_count: number;
  /** The elements of storage buffers that stand for vertex inputs. */
  elements: ElementsRow[];
}

/** A texture or a buffer of the host. */
export interface HostSource {
  kind: "host";
  /** Name of the texture or buffer. */
  host: string;
}

/** A texture of the host. */
export interface HostTextureRow {
  /** Name of the texture. */
  name: string;
  /** Type as declared. */
  type: string;
  /** Dimension. */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /** Kind of its values. */
  sample: "float" | "depth" | "int" | "uint";
  /** Texture until the host binds one. */
  default: string;
  /** Doc comment. */
  doc: string;
  /** Parameter group, which says how often the host changes it. */
  group: string;
}

/**
 * The storage buffer whose elements have its values, and their member that has them. There is one
 * where a kernel captures vertices, or corners need more than 16 vertex inputs; otherwise null.
 */
export interface InBuffer {
  /** The buffer. */
  name: string;
  /** The member of its elements. */
  member: string;
}

/** An element of an array, a column of a matrix or a lane of a vector. */
export interface IndexStep {
  op: "index";
  /** Type of the result. */
  type: string;
  /** The array, and the number of the element. */
  args: [number, number];
}

/** An input of a shader that the frame sets. */
export interface InputRow {
  /** The parameter, texture or buffer, as the shader's reflection calls it. */
  name: string;
  /** Source of its value. */
  source: ValueSource | ResultSource | HostSource | PreviousSource;
}

/** A texture or a buffer that the next frame reads. */
export interface KeptRow {
  /** The result. */
  result: string;
  /** Texture; null of a buffer. */
  texture: number | null;
  /** Number of the texture that has the result of the last frame; null for a buffer. */
  previous: number | null;
}

/**
 * A value: a scalar, or nested arrays of a vector's lanes, a matrix's columns, an array's elements.
 */
export type Lanes = number | boolean | null | Lanes[];

/** The layers of the render targets; null where these are single pictures. */
export interface LayersRow {
  /** Number of layers. */
  count: number;
  /**
   * Parameter that says to which layer a draw belongs: there is one draw for each. Null where a
   * single draw reaches all layers.
   */
  parameter: string | null;
}

/**
 * The layout of lanes from the start of the value. A lane is 32 bits, little-endian; fields that do
 * not apply to the type are absent.
 */
export interface LayoutRow {
  /**
   * The stored type. Bools are uints, 2- and 3-row matrices have columns of four rows (`mat3x4`),
   * and arrays are arrays of `vec4`. For a table's member, it is the type of one element.
   */
  stored: string;
  /** Kind of the lanes; bools are uints 0 and 1. Absent for structs. */
  kind?: "float" | "int" | "uint";
  /** Lanes of a scalar or vector, or of one column of a matrix, 4 bytes apart. */
  lanes?: number;
  /** Columns of a matrix. */
  columns?: number;
  /** Bytes from one column of a matrix to the next. */
  column_stride?: number;
  /** Elements of an array; everything else describes one element. */
  count?: number;
  /** Bytes from one element of an array to the next. */
  stride?: number;
}

/** A light, or an array of lights, of the rig. */
export interface LightRow {
  /** Name in the rig. */
  name: string;
  /** The declaration of the light: `Lantern`. */
  kind: string;
  /** Declaration of the library that it is, `std.lights.Lantern`; null for others. */
  library: string | null;
  /** Doc comment of the rig's entry; empty where there is none. */
  doc: string;
  /** Largest number of lights of an array; null for a single light. */
  capacity: number | null;
  /** Parameter with the number of lights in use; null where it is fixed. */
  count: string | null;
  /**
   * The array's parameter, or a single light's parameters, of whatever groups. Each has a row in
   * `parameters` with its block and offset.
   */
  parameters: string[];
}

/** The declared matrix that this is a column of, and which; null for others. */
export interface MatrixColumn {
  /** The matrix. */
  of: string;
  /** Number of the column, from 0. */
  index: number;
}

/** A member of a struct, or of the elements of an array of structs. */
export interface MemberRow {
  /** The member's name. */
  name: string;
  /** The type as written: `rgb`, `direction<world>`, `Lamp[8]`. */
  type: string;
  /** The type on the machine: `float`, `vec3`, `Lamp[8]`. */
  representation: string;
  /** Lowest and highest value that a host may set; null where the declaration gives none. */
  range: [number, number] | null;
  /** Value before a host sets one; null where the declaration gives none. */
  default: Lanes;
  /** Doc comment; empty where there is none. */
  doc: string;
  /** Declaration of the library that it is, `std.skinning.Skinned.bones`; null for others. */
  library: string | null;
  /** Bytes from the start of the struct. */
  offset: number;
  /** Bytes of the stored value, padding inside it included. */
  size: number;
  layout: LayoutRow;
  /** Members of a struct inside this one. */
  members: MemberRow[];
}

/** A member of a struct. */
export interface MemberStep {
  op: "member";
  /** Type of the result. */
  type: string;
  /** The struct. */
  args: [number];
  /** Name of the member. */
  member: string;
}

/** The meaning of this in the mesh, if each primitive is drawn as an instance; else null. */
export interface MeshInputRow {
  /** The vertex input as declared, or the number that the host counts. */
  name: string;
  /**
   * Number of the corner whose value it is, from 0. It is a corner of the primitive, or of the
   * pattern's triangle or line. Null where a whole instance of the mesh has one value, or a point
   * of the pattern.
   */
  corner: number | null;
  /** True if it is the number of a vertex, an instance or a primitive of the mesh. */
  is_number: boolean;
  /** True if it is the place of a point of the pattern in a patch. */
  is_of_pattern: boolean;
}

/** A model of the scene. */
export interface ModelRow {
  /** Its material. */
  material: string;
  /** The names by which steps draw it. */
  tags: string[];
  /** What each shader that draws it gets of its mesh, by the shader's number. */
  geometries: Record<string, number>;
  /** Values by role: `object_to_world`, bones, colours. */
  values: Record<string, Value>;
  /** Pictures by role. */
  textures: Record<string, number>;
}

/** Models of the host's scene. */
export interface ModelsRow {
  /** Tag of these models in the host's scene; all models of the scene are called `scene`. */
  name: string;
  /** The materials that they may have. Every `uses` for them has a shader for each. */
  materials: string[];
  /** The doc comment. */
  doc: string;
  source: PlaceRow;
}

/** An output of the frame. */
export interface OutputRow {
  /** Name of the output. */
  name: string;
  /** The result. */
  result: string;
  /** Texture; null of a buffer. */
  texture: number | null;
  /** Doc comment. */
  doc: string;
  source: PlaceRow;
}

/** A frame with everything that a page draws of it. */
export interface Package {
  /** Version of this document's format. A host refuses versions that it does not know. */
  package: 2;
  plan: FramePlan;
  /** The shaders, by the numbers of the plan. */
  shaders: PackagedShader[];
  /** The pipelines of WebGPU that steps use; empty without texts for it. */
  pipelines: PipelineRow[];
  /**
   * The formats of the plan's textures, as WebGPU calls them. All APIs can draw to these; lanes of
   * ten bits have eight, which are clamped and blended in the same way.
   */
  formats: GPUTextureFormat[];
  /** Width and height, until somebody resizes the frame. */
  size: [number, number];
  camera: CameraRow;
  /** The models of the scene. */
  models: ModelRow[];
  /** What draw calls get of meshes, by number. */
  geometries: GeometryRow[];
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
  /** The pictures, by number. */
  pictures: PictureRow[];
}

/** A shader with its texts, and what its materials set. */
export interface PackagedShader {
  reflection: Reflection;
  /** By profile, such as `wgsl:webgpu`, and stage. */
  texts: Record<string, Record<string, ShaderTextRow>>;
  /** The values of its parameters, by name. */
  values: Record<string, Value>;
  /** What each parameter is of the scene, by name, if it is something of it. */
  roles: Record<string, string>;
  /**
   * What its parameters of lights are of the plan's, by name. Behind an array of which one light is
   * meant stands `[]`.
   */
  lights: Record<string, string>;
  /** The pictures that its textures are, by name. */
  textures: Record<string, number>;
  /** What each texture is of the look of a model, by name, if it is something of it. */
  texture_roles: Record<string, string>;
  /** The elements of its storage buffers in base64, by name. */
  buffers: Record<string, string>;
  /**
   * Where the host divides patches: the levels of the edges and the inside for which the geometries
   * were made.
   */
  levels: number[] | null;
  /** Its pipeline in the words of WebGPU; null without texts for it. */
  webgpu: WebGPUPipeline | null;
}

/** A declared parameter. */
export interface ParameterRow {
  /** Name as the host says it, `lamps` or `torch.axis`. */
  name: string;
  /** The type as written: `rgb`, `direction<world>`, `Lamp[8]`. */
  type: string;
  /** The type on the machine: `float`, `vec3`, `Lamp[8]`. */
  representation: string;
  /** Lowest and highest value that a host may set; null where the declaration gives none. */
  range: [number, number] | null;
  /** Value before a host sets one; null where the declaration gives none. */
  default: Lanes;
  /** Doc comment; empty where there is none. */
  doc: string;
  /** Declaration of the library that it is, `std.skinning.Skinned.bones`; null for others. */
  library: string | null;
  /**
   * Meaning for a program that shows scenes, such as `world_to_clip` of the camera. Null where it
   * is the material's own affair.
   */
  role: string | null;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /** Block that holds it; null where the program reads nothing of that block. */
  block: string | null;
  /** Bytes from the start of the block; null without a block. */
  offset: number | null;
  /** Bytes of the stored value, padding inside it included. */
  size: number;
  layout: LayoutRow;
  /** Members of a struct or of an array's elements; empty otherwise. */
  members: MemberRow[];
  /** Parameter with the run-time number of elements in use; null where all are. */
  count: string | null;
}

/** The value of a parameter. */
export interface ParameterStep {
  op: "parameter";
  /** Type of the result. */
  type: string;
  args: [];
  /** Name of the parameter. */
  parameter: string;
}

/** The levels of that pattern; null where the texts compute them. */
export interface PatchLevels {
  /**
   * For each edge, the steps that compute its level. The edges of a triangle are those across from
   * its ends; those of a quad are at u = 0, v = 0, u = 1 and v = 1.
   */
  edges: ((ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[])[];
  /** The steps that compute the levels of the inside; of a quad along u, and along v. */
  inside: ((ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[])[];
}

/** Texels with all mip levels. */
export interface PictureRow {
  /** The format, as WebGPU calls it. */
  format: GPUTextureFormat;
  /** The dimension. */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /** The width. */
  width: number;
  /** The height. */
  height: number;
  /** Layers, faces, or slices of the first level. */
  depth: number;
  /** Each level in base64, layer by layer and row by row from the top. */
  levels: string[];
}

/** A pipeline of a shader: the formats of what it draws to. */
export interface PipelineRow {
  /** The number of the shader. */
  shader: number;
  /** The formats of the targets; none of a kernel that is computed. */
  targets: GPUTextureFormat[];
  /** The format of the depths; null where there are none. */
  depth: GPUTextureFormat | null;
}

/** The place in a file where something is written; lines and columns count from 1. */
export interface PlaceRow {
  /** The file, from the folder of the compiled one; the library's files begin with `std/`. */
  file: string;
  /** The line. */
  line: number;
  /** The column. */
  column: number;
  /** The number of characters. */
  length: number;
}

/** A result of a step of the last frame. */
export interface PreviousSource {
  kind: "previous";
  /** The result. */
  previous: string;
  /** The number of the texture that has it now; null of a buffer. */
  texture: number | null;
  /** Source in the first frame; null for a texture without contents. */
  initially: ResultSource | HostSource | null;
}

/** A vector that is not zero wherever a shader uses it. */
export interface PromiseRow {
  /** The vector as a formula in Burnish. */
  value: string;
  /** Least length of the vector. */
  least_length: number;
  /** The parameters that it depends on. */
  parameters: string[];
}

/** Everything a host has to know about one material under one pass and one rig. */
export interface Reflection {
  /** Version of this document's format. */
  format: 2;
  /** The material. */
  material: string;
  /** The pass. */
  pass: string;
  /** The rig. */
  rig: string;
  /** The material's doc comment; empty where there is none. */
  doc: string;
  /**
   * The conventions of all materials and backends. A backend's own row says where its text differs.
   */
  conventions: Conventions;
  /** Uniform blocks in binding order. */
  blocks: BlockRow[];
  /** Declared parameters in order of declaration. */
  parameters: ParameterRow[];
  /** Values of the derived blocks. */
  derived: DerivedRow[];
  /** Promises of the host by `nonzero`, besides ranges and directions. */
  promises: PromiseRow[];
  /** Lights of the rig. */
  lights: LightRow[];
  /** Storage buffers in order of declaration. */
  buffers: BufferRow[];
  /** Storage buffers that a kernel writes, in order of declaration; none for a material. */
  results: ResultRow[];
  /**
   * Steps that compute the number of elements of each of a kernel's results. For images, they
   * compute the width and height. Null for a material.
   */
  extent: (ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[] | null;
  /** Size of a kernel's work group in invocations, along x, y and z; null for a material. */
  work_group: [number, number, number] | null;
  /** Textures in order of declaration. */
  textures: TextureRow[];
  /** Sampler states, one for each texture that is not merely loaded. */
  samplers: SamplerRow[];
  draw: DrawRow;
  /**
   * True if the position of a vertex is invariant. It is then the same number, bit by bit, in all
   * programs that compute it in the same way, so that their depths are equal. The texts say so.
   */
  invariant_position: boolean;
  /** State of the pipeline that the host sets, as the pass asks for it. */
  render_state: RenderStateRow;
  /**
   * Values of each vertex that are written to one buffer, instead of drawing. Null for a pass that
   * draws, and for a kernel.
   */
  capture: CaptureRow | null;
  /** Vertex inputs. */
  vertex_inputs: VertexInputRow[];
  /** Inputs that the pipeline itself supplies, by stage: one row for each stage that there is. */
  pipeline_inputs: Record<string, string[]>;
  /** Varyings. */
  varyings: VaryingRow[];
  /**
   * Render targets. For a kernel over images, they are its images in order of declaration, which
   * are the render targets of its full-screen pass.
   */
  targets: TargetRow[];
  /** Emitted profiles by name. */
  backends: Record<string, BackendRow>;
}

/** The state of the pipeline that the host sets, as the pass asks for it. */
export interface RenderStateRow {
  /** Triangles that are not drawn, by the side that is seen of them. */
  cull: "none" | "back" | "front";
  /**
   * Order of the corners of a triangle whose front is seen. An API has to be told the backend's
   * `front_face`.
   */
  front: "counter_clockwise" | "clockwise";
  /** Part of a triangle that is drawn: all of it, or its edges as lines. */
  fill: "faces" | "lines";
  /**
   * Number of samples of each pixel of the targets and of the depths. With several, the targets are
   * resolved at the end: each pixel becomes the mean of its samples.
   */
  samples: 1 | 4;
  /** The depth test. */
  depth: DepthState;
  /**
   * The stencil test; null: there is none, and nothing is written. A host clears stencil values to
   * 0.
   */
  stencil: StencilState | null;
}

/** The texture to which the mean of each texel's samples is written behind the step. */
export interface ResolveRow {
  /** A texture with one sample, in which others find the result. */
  texture: number;
  /** Layer. */
  layer: number;
  /** Mip level. */
  level: number;
}

/** A texture, of which only the size is asked for. */
export interface ResourceStep {
  op: "resource";
  /** Type of the texture. */
  type: string;
  args: [];
  /** Name of the texture. */
  texture: string;
}

/**
 * A storage buffer that a kernel writes. It writes each element once or, if it scatters to the
 * buffer, as often as invocations choose the element. Padding is not written.
 */
export interface ResultRow {
  /** Name as the host says it, `lanterns` or `torch.bulbs`. */
  name: string;
  /** The type as written: `Lantern[]`. */
  type: string;
  /** The type on the machine: `vec3[]`. */
  representation: string;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /** Bytes from one element to the next. */
  stride: number;
  layout: LayoutRow;
  /** Members of an element that is a struct. */
  members: MemberRow[];
  /** Stored structs that elements use, those inside others first. */
  structs: StructRow[];
  /** Doc comment. */
  doc: string;
  /** Steps that compute how many elements it has. */
  count: (ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[];
  /** Operator by which invocations join values with elements; null if each writes its own. */
  scattered: "add" | "min" | "max" | "and" | "or" | null;
  /**
   * Value of each element before the kernel runs, so that it then has the joined ones alone. Null
   * if that does not matter.
   */
  initial: number | null;
}

/** A result of a step of this frame. */
export interface ResultSource {
  kind: "result";
  /** The result. */
  result: string;
  /** The number of its texture; null of a buffer. */
  texture: number | null;
}

/** A kernel that is run. */
export interface RunStep {
  kind: "run";
  /** The step. */
  name: string;
  /** The textures that are waited for. */
  barriers: BarrierRow[];
  /** The buffers of results that are waited for. */
  buffer_barriers: BufferBarrierRow[];
  /** True if it is needed in the first frame only. */
  only_first: boolean;
  /** The kernel, and its inputs that the frame sets. */
  use: UseRow;
  /** The images that it writes. */
  images: WrittenImage[];
  /** The buffers that it writes. */
  buffers: WrittenBuffer[];
  source: PlaceRow;
}

/** The state of the sampler that reads a texture. */
export interface SamplerRow {
  /** The texture. */
  texture: string;
  /** The state: filters, comparison, and the texels beyond the edges. */
  state: SamplerState;
}

/** The state of a sampler: its filters, its comparison, and the texels beyond the edges. */
export interface SamplerState {
  /** Filter between the texels of a level. */
  filter: "linear" | "nearest";
  /** Filter between levels; `none`: only the first one is read. */
  mip: "linear" | "nearest" | "none";
  /** Texels beyond the edges. */
  wrap: "repeat" | "clamp" | "mirror";
  /** Comparison of a reference, on the left, with a depth; null where none is compared. */
  compare: "less" | "less_equal" | "greater" | "greater_equal" | null;
}

/** One of two values. */
export interface SelectStep {
  op: "select";
  /** Type of the result. */
  type: string;
  /** A bool, the value if it is true, and the value if it is false. */
  args: [number, number, number];
}

/** A shader. */
export interface ShaderRow {
  /** Name of the shader. */
  name: string;
  /** The file with its reflection. */
  reflection: string;
  /** The pass; null of a kernel. */
  pass: string | null;
  /** The rig; null of a kernel. */
  rig: string | null;
}

/** The text of a stage. */
export interface ShaderTextRow {
  /** The text. */
  text: string;
  /** Its entry point. */
  entry: string;
}

/** The size of a texture. */
export interface SizeRow {
  /** The number of the value that says it, an `ivec2`; null where `extent_of` says it. */
  value: number | null;
  /**
   * Name of the step whose kernel says the size, by the `extent` of its reflection. Null where
   * `value` says it.
   */
  extent_of: string | null;
  /** Number of times that both sides are halved then, rounded down, but not below 1. */
  level: number;
}

/** What a shader reads or writes at one place of a group. */
export interface SlotRow {
  /** What it is. */
  kind: "block" | "buffer" | "storage_texture" | "texture" | "sampler";
  /** The reflection's name for it; of a sampler, that of its texture. */
  name: string;
  /** Its number among those of its kind. */
  number: number;
  /** Its place. */
  layout: GPUBindGroupLayoutEntry;
  /** The state of a sampler. */
  sampler?: GPUSamplerDescriptor;
}

/** The text in Burnish that each statement of an emitted file computes, or is there for. */
export interface SourceMapRow {
  /** Burnish files by name, as given to the compiler; those of the library begin with `std/`. */
  sources: string[];
  /**
   * Rows of five numbers, in the order of the text. They are a line of the text, then the number of
   * a source counted from 0, the line and the column in it, and the number of characters.
   */
  lines: ([number, number, number, number, number])[];
}

/** A vector whose lanes are all one number. */
export interface SplatStep {
  op: "splat";
  /** Type of the result. */
  type: string;
  /** The number. */
  args: [number];
}

/** The handling of the stencil values beside depths, if there are any. */
export interface StencilLoad {
  /** Start of the step: keep the values, or clear them. */
  load: "load" | "clear";
  /** True if a later step reads them. */
  store: boolean;
  /** Value that they are cleared to. */
  clear: 0;
}

/** The stencil test of faces seen from one side, and the changes of the values. */
export interface StencilSide {
  /** The comparison of the reference, on the left, with the value, both masked. */
  compare: "never" | "less" | "equal" | "less_equal" | "greater" | "not_equal" | "greater_equal" | "always";
  /** The operation where that comparison fails. */
  fail_op: "keep" | "zero" | "replace" | "invert" | "increment_clamp" | "decrement_clamp" | "increment_wrap" | "decrement_wrap";
  /** The operation where only the depth test fails. */
  depth_fail_op: "keep" | "zero" | "replace" | "invert" | "increment_clamp" | "decrement_clamp" | "increment_wrap" | "decrement_wrap";
  /** The operation where both tests let the fragment through. */
  pass_op: "keep" | "zero" | "replace" | "invert" | "increment_clamp" | "decrement_clamp" | "increment_wrap" | "decrement_wrap";
}

/** The stencil test, for either side. */
export interface StencilState {
  front: StencilSide;
  /** Lines have no back. */
  back: StencilSide;
  /** The number that values are compared with, and that `replace` writes. */
  reference: number;
  /** The bits that are compared. */
  read_mask: number;
  /** The bits that are written. */
  write_mask: number;
}

/** One member. */
export interface StructMember {
  /** The member's name; padding is `pad_N`. */
  name: string;
  /** Stored type. */
  type: string;
  /** Bytes from the start of the struct. */
  offset: number;
  /** Bytes. */
  size: number;
}

/** A struct in stored form. */
export interface StructRow {
  /** The struct's name. */
  name: string;
  /** Bytes, a multiple of 16. */
  size: number;
  /** Members in order, padding included. */
  members: StructMember[];
}

/** A swizzle: some lanes of a vector. */
export interface SwizzleStep {
  op: "swizzle";
  /** Type of the result. */
  type: string;
  /** The vector. */
  args: [number];
  /** The lanes taken, in order. */
  lanes: number[];
}

/** A render target and the fixed-function state it wants. */
export interface TargetRow {
  /** Name in the pass. */
  name: string;
  /** Type that is written. */
  representation: string;
  /** Location. */
  location: number;
  /** Pixel format, `rgba8`. */
  format: string;
  /**
   * Encoding of colours. The shader writes linear light. `srgb`: the hardware encodes it, and who
   * shows the bytes as a picture shows them as they are. `linear`: nobody has encoded it, and who
   * shows or saves it as a picture encodes it first, or it looks too dark.
   */
  encoding: "linear" | "srgb";
  /** Blending with the colour in the target; null where the new one takes its place. */
  blend: Blend | null;
  /**
   * Lanes that are written of those that the format has. Some of `rgba`, in this order, or `none`.
   */
  mask: string;
  /** Value before anything is drawn, in four lanes; null where that is the host's affair. */
  clear: [number, number, number, number] | null;
  /** Doc comment; empty where there is none. */
  doc: string;
}

/** The division of each patch of a mesh. */
export interface TessellationRow {
  /** Kind of patch. */
  kind: "triangle" | "quad" | "isoline";
  /**
   * The control points of a patch that are its corners. Those of a triangle have the weights x, y
   * and z; those of a quad lie at (0, 0), (1, 0), (1, 1) and (0, 1); a line begins at the first
   * one.
   */
  ends: number[];
  /** Spacing of the steps of edges: equal, or with two shorter ones of an even or odd number. */
  spacing: "equal" | "fractional_even" | "fractional_odd";
  /**
   * The means of division: the tessellation stages, or a draw of one instance for each patch. The
   * vertices of an instance are the points of a pattern that the host makes, or they compute their
   * places from their numbers.
   */
  divided_by: "evaluation" | "instances";
  /** The levels of that pattern; null where the texts compute them. */
  levels: PatchLevels | null;
}

/** The entry of a WebGPU bind group layout for the texture, in WebGPU's words. */
export interface TextureLayout {
  /** GPUTextureViewDimension. */
  viewDimension: "2d" | "2d-array" | "3d" | "cube";
  /**
   * GPUTextureSampleType. It is `unfilterable-float` where nothing filters, so that formats fit
   * that cannot be filtered.
   */
  sampleType: "float" | "unfilterable-float" | "depth" | "sint" | "uint";
  /** GPUSamplerBindingType; null where no sampler reads it. */
  sampler: "filtering" | "non-filtering" | "comparison" | null;
}

/** A texture. */
export interface TextureRow {
  /** Name as the host says it, `lamps` or `torch.axis`. */
  name: string;
  /** Type as declared, such as `texture2d` or `depth_cube`. */
  type: string;
  /** Dimension. */
  dimension: "2d" | "2d_array" | "3d" | "cube";
  /**
   * Content: colours, depths to compare with, or whole numbers. The format says whether colours are
   * stored as sRGB, which is the host's affair.
   */
  sample: "float" | "depth" | "int" | "uint";
  /** The entry of a WebGPU bind group layout for the texture, in WebGPU's words. */
  layout: TextureLayout;
  /**
   * Parameter group, which the host updates together. It is `frame`, `view`, `rig`, `material`,
   * `draw` or a user's own.
   */
  group: string;
  /** Texture to bind before a host sets one, such as `white`. */
  default: string;
  /** Stages that read it. */
  stages: string[];
  /** Doc comment; empty where there is none. */
  doc: string;
  /** Declaration of the library that it is, as for parameters; null where it is none of them. */
  library: string | null;
  /**
   * True if it is made by steps that a light brings to frames, such as its shadow map. Where there
   * is no frame, a host that wants to see the result binds a texture of its own.
   */
  brought: boolean;
}

/** A shader for the models of one material. */
export interface UseRow {
  /** The material; null where vertices without models are drawn, and of a kernel. */
  material: string | null;
  /** The number of the shader. */
  shader: number;
  /** Inputs that the frame sets. */
  inputs: InputRow[];
}

/**
 * What a host sets: a number, a list of lanes, columns or elements, or members by name; null for
 * what nobody has set.
 */
export type Value = number | boolean | null | Value[] | { [key: string]: Value };

/** A number, vector or matrix. */
export interface ValueRow {
  /** Type without meaning: the numbers of the value. */
  representation: string;
  /** Steps that compute it, operands before users; the last one is the value. */
  steps: (ParameterStep | ConstantStep | ResourceStep | BoundStep | CallStep | ComposedStep | SplatStep | SwizzleStep | MemberStep | IndexStep | SelectStep | FoldStep)[];
}

/** A number that the host computes. */
export interface ValueSource {
  kind: "value";
  /** The number of the value. */
  value: number;
}

/** Values that cross from one stage to the next. */
export interface VaryingRow {
  /** Name of the slot. */
  name: string;
  /** The type on the machine: `float`, `vec3`, `Lamp[8]`. */
  representation: string;
  /** Location. */
  location: number;
  /** Interpolation. `corner`: there is none, since the next stage reads each corner. */
  mode: "perspective" | "flat" | "corner";
  /** The stage that computes it, `vertex`. */
  from_stage: string;
  /** The stage that reads it, `fragment`. */
  to_stage: string;
}

/** The name of a vertex input. */
export interface VertexInputNameRow {
  /** Name in the text. */
  identifier: string;
  /** HLSL semantic; null elsewhere. */
  semantic: string | null;
}

/** A vertex input that the program reads. */
export interface VertexInputRow {
  /** Name as declared; of a matrix's column with its number, `bend.0`. */
  name: string;
  /** The type as written: `rgb`, `direction<world>`, `Lamp[8]`. */
  type: string;
  /** The type on the machine: `float`, `vec3`, `Lamp[8]`. */
  representation: string;
  /** Location; null where a buffer has its values. */
  location: number | null;
  /**
   * The storage buffer whose elements have its values, and their member that has them. There is one
   * where a kernel captures vertices, or corners need more than 16 vertex inputs; otherwise null.
   */
  buffer: InBuffer | null;
  /** The step of its values: one for each vertex, or one for each instance. */
  step: "vertex" | "instance";
  /** The declared matrix that this is a column of, and which; null for others. */
  column: MatrixColumn | null;
  /** The meaning of this in the mesh, if each primitive is drawn as an instance; else null. */
  mesh: MeshInputRow | null;
  /** Doc comment; empty where there is none. */
  doc: string;
}

/**
 * The barriers behind the last step and before the exchange of `kept`. The host can then read the
 * outputs, and the next frame the kept textures and buffers.
 */
export interface WaitingRow {
  /** The textures that are waited for. */
  barriers: BarrierRow[];
  /** The buffers of results that are waited for. */
  buffer_barriers: BufferBarrierRow[];
}

/** A pipeline in the words of WebGPU, but for its texts. */
export interface WebGPUPipeline {
  /** What is bound, group by group; a group that is not used is empty. */
  groups: SlotRow[][];
  /** The vertex buffers. */
  buffers: GPUVertexBufferLayout[];
  /** What each target is drawn with. */
  targets: GPUColorTargetState[];
  /** How primitives are drawn. */
  primitive: GPUPrimitiveState;
  /** The tests of depths and stencil values, but for the format. */
  depthStencil: Omit<GPUDepthStencilState, "format">;
}

/** A buffer. */
export interface WrittenBuffer {
  /** The kernel's name for it. */
  name: string;
  /** The result. */
  result: string;
}

/** An image. */
export interface WrittenImage {
  /** The kernel's name for it. */
  name: string;
  /** The result. */
  result: string;
  /** Texture. */
  texture: number;
}
