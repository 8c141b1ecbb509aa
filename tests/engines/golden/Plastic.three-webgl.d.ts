// Plastic: a material of whole shaders for three.js's WebGLRenderer, by Burnish.

import { IUniform, RawShaderMaterial, Color, Texture, Vector3 } from "three";

export interface PlasticValues {
  /** Light from everywhere; linear */
  ambient_light?: Color;
  /** linear */
  sun_diffuse_color?: Color;
  /** linear */
  sun_specular_color?: Color;
  /** Where the light travels; length 1 */
  sun_direction?: Vector3;
  lamps?: Partial<{ diffuse_color: Color; specular_color: Color; place: Vector3 }>[];
  /** The number of `lamps` that shine; 0 to 8 */
  lamps_count?: number;
  /** linear */
  torch_diffuse_color?: Color;
  /** linear */
  torch_specular_color?: Color;
  /** On no surface that is drawn; no default: has to be set */
  torch_place?: Vector3;
  /** Where the light travels; length 1 */
  torch_axis?: Vector3;
  /** 0 to 1.5708; radians */
  torch_inner?: number;
  /** 0 to 1.5708; radians */
  torch_outer?: number;
  /** Base colour; linear */
  base?: Color;
  /** Highlight colour; linear */
  shine?: Color;
  /** Specular exponent; 1 to 512 */
  power?: number;
  /** Multiplies the base colour; its colours are decoded: give it `SRGBColorSpace` */
  albedo?: Texture;
}

export interface PlasticUniforms {
  [name: string]: IUniform;
  /** Light from everywhere; linear */
  readonly ambient_light: IUniform<Color>;
  /** linear */
  readonly sun_diffuse_color: IUniform<Color>;
  /** linear */
  readonly sun_specular_color: IUniform<Color>;
  /** Where the light travels; length 1 */
  readonly sun_direction: IUniform<Vector3>;
  readonly lamps: IUniform<{ diffuse_color: Color; specular_color: Color; place: Vector3 }[]>;
  /** The number of `lamps` that shine; 0 to 8 */
  readonly lamps_count: IUniform<number>;
  /** linear */
  readonly torch_diffuse_color: IUniform<Color>;
  /** linear */
  readonly torch_specular_color: IUniform<Color>;
  /** On no surface that is drawn; no default: has to be set */
  readonly torch_place: IUniform<Vector3>;
  /** Where the light travels; length 1 */
  readonly torch_axis: IUniform<Vector3>;
  /** 0 to 1.5708; radians */
  readonly torch_inner: IUniform<number>;
  /** 0 to 1.5708; radians */
  readonly torch_outer: IUniform<number>;
  /** Base colour; linear */
  readonly base: IUniform<Color>;
  /** Highlight colour; linear */
  readonly shine: IUniform<Color>;
  /** Specular exponent; 1 to 512 */
  readonly power: IUniform<number>;
  /** Multiplies the base colour; its colours are decoded: give it `SRGBColorSpace` */
  readonly albedo: IUniform<Texture | null>;
}

export class PlasticMaterial extends RawShaderMaterial {
  constructor(values?: PlasticValues);
  /** Those that the renderer sets, and those that are computed, are among them. */
  uniforms: PlasticUniforms;
  /** Sets uniforms by their names; of arrays as many elements as are given, which then count. */
  set(values: PlasticValues): this;
}
