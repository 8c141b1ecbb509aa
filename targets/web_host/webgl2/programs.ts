// Programs of WebGL 2, each linked once when a frame is opened.

import type { PackagedShader, SamplerRow } from "../generated/documents.js";
import type { Context, Gl } from "./context.js";
import { checkInterface } from "./interface.js";

export const PROFILE = "glsl:es300";

/** A program with the numbers at which it finds what it reads. */
export interface Program {
  gl: WebGLProgram;
  /** The name of the block at each binding. */
  blocks: string[];
  /** The texture of each unit, with its sampler; null where its texels are only loaded. */
  textures: { name: string; state: SamplerRow["state"] | null }[];
  /** The location of each vertex input that the program reads, by name. */
  inputs: Map<string, number>;
  /** Uniforms that are the height of what is drawn to. */
  heights: WebGLUniformLocation[];
}

/** WebGL links no program without a fragment shader, also where vertices are captured. */
const NO_FRAGMENTS = { text: "#version 300 es\nvoid main() {}\n" };

/** The programs of all shaders. The browser compiles them at the same time. */
export function linked({ gl }: Context, shaders: PackagedShader[]): Program[] {
  const started = shaders.map((shader) => start(gl, shader));
  return shaders.map((shader, at) => finished(gl, shader, started[at]));
}

function start(gl: Gl, { reflection, texts }: PackagedShader): WebGLProgram {
  const { vertex, fragment = reflection.capture && NO_FRAGMENTS } = texts[PROFILE] ?? {};
  if (!vertex || !fragment) {
    throw new Error(`WebGL 2 cannot draw ${reflection.material}: there is no text for ${PROFILE}`);
  }
  const program = gl.createProgram();
  const stages = [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const;
  for (const [kind, { text }] of stages) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  const { capture, backends } = reflection;
  if (capture) {
    const { captures } = backends[PROFILE];
    const names = capture.members.map(({ name }) => captures[name].identifier);
    gl.transformFeedbackVaryings(program, names, gl.INTERLEAVED_ATTRIBS);
  }
  gl.linkProgram(program);
  return program;
}

function finished(gl: Gl, { reflection }: PackagedShader, program: WebGLProgram): Program {
  const shaders = gl.getAttachedShaders(program)!;
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    const logs = shaders.map((each) => gl.getShaderInfoLog(each));
    const told = [...logs, gl.getProgramInfoLog(program)].filter(Boolean).join("\n");
    throw new Error(`the browser refuses a text of ${reflection.material}:\n${told}`);
  }
  shaders.forEach((each) => gl.deleteShader(each));
  checkInterface(gl, program, reflection, PROFILE);
  const { blocks, textures, ...others } = reflection.backends[PROFILE];
  const { vertex_inputs: inputs, host_uniforms: heights } = others;
  gl.useProgram(program);
  const bound = reflection.blocks.map(({ name }) => name).filter((name) => blocks[name]);
  bound.forEach((name, at) => {
    const index = gl.getUniformBlockIndex(program, blocks[name].identifier);
    // Else nothing reads it.
    if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, index, at);
  });
  const read = reflection.textures.filter(({ name }) => textures[name]);
  read.forEach(({ name }, unit) => {
    gl.uniform1i(gl.getUniformLocation(program, textures[name].identifier), unit);
  });
  const located = Object.entries(inputs).map(([name, { identifier }]) =>
    [name, gl.getAttribLocation(program, identifier)] as const,
  );
  return {
    gl: program,
    blocks: bound,
    textures: read.map(({ name, layout }) => {
      const row = reflection.samplers.find((each) => each.texture === name);
      return { name, state: layout.sampler === null ? null : row!.state };
    }),
    inputs: new Map(located.filter(([, location]) => location >= 0)),
    heights: heights.flatMap((name) => gl.getUniformLocation(program, name) ?? []),
  };
}
