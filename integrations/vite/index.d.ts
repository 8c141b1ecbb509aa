// The types of the plugin, and of what importing a material gives.

import type { Plugin } from "vite";

export interface Options {
  /** The languages to write, as `burnish targets` lists them; by default WGSL and GLSL for WebGL 2. */
  targets?: readonly string[];
  /** More words of the command line of `burnish compile`, such as `["--rig", "Night"]`. */
  options?: readonly string[];
  /** The program; by default that of the variable BURNISH, or `burnish`. */
  program?: string;
}

export default function burnish(options?: Options): Plugin;

/** The texts for one target, by their stage; `all` is one with all stages. */
export interface Texts {
  readonly vertex?: string;
  readonly fragment?: string;
  readonly compute?: string;
  readonly all?: string;
}

/** A material or a kernel. */
export interface Shader {
  /** The texts by their target: `wgsl`, `glsl:es300`. */
  readonly texts: { readonly [target: string]: Texts };
  /** What a host has to bind where: `burnish docs reflection`. */
  readonly reflection: { readonly [key: string]: unknown };
}

/** A frame. */
export interface Frame {
  /** The steps by which it is drawn: `burnish docs plans`. */
  readonly plan: { readonly [key: string]: unknown };
  /** Its shaders, in the order of the plan's `shaders`. */
  readonly shaders: readonly Shader[];
}
