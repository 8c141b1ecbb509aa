// Plastic: a material of whole shaders for three.js's WebGLRenderer, by Burnish.
// Plastic after the classic three-term model.
// A geometry needs position (vec3), normal (vec3), uv (vec2).

import {
  GLSL3,
  RawShaderMaterial,
  Color,
  DataTexture,
  DataUtils,
  DoubleSide,
  HalfFloatType,
  LessDepth,
  LinearFilter,
  LinearMipmapLinearFilter,
  Matrix4,
  NoBlending,
  RepeatWrapping,
  SRGBColorSpace,
  Vector3,
} from "three";

const vertexShader = `precision highp float;
precision highp int;
precision highp sampler2D;
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.

uniform mat4 view_projection;  /// World to clip space
uniform vec3 cameraPosition;  /// Where the viewer stands

uniform mat4 modelMatrix;

uniform mat3 normal_matrix;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;

void main() {
    vec3 position_ = (modelMatrix * vec4(position, 1.0)).xyz;
    v_position = position_;
    v_normal = vec4(normal_matrix * normal, 0.0).xyz;
    v_uv = uv;
    gl_Position = view_projection * vec4(position_, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
`;

const fragmentShader = `precision highp float;
precision highp int;
precision highp sampler2D;
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    vec3 diffuse_color;
    float pad_0;
    vec3 specular_color;
    float pad_1;
    vec3 place;
    float pad_2;
};

uniform mat4 view_projection;  /// World to clip space
uniform vec3 cameraPosition;  /// Where the viewer stands

uniform vec3 ambient_light;  /// Light from everywhere
uniform vec3 sun_diffuse_color;
uniform vec3 sun_specular_color;
uniform vec3 sun_direction;  /// Where the light travels
uniform Point lamps[8];
uniform int lamps_count;  /// The number of \`lamps\` that shine
uniform vec3 torch_diffuse_color;
uniform vec3 torch_specular_color;
uniform vec3 torch_place;  /// On no surface that is drawn
uniform vec3 torch_axis;  /// Where the light travels
uniform float torch_inner;
uniform float torch_outer;

uniform float torch_falloff_cos;
uniform float torch_falloff_inverse_width;

uniform vec3 base;  /// Base colour
uniform vec3 shine;  /// Highlight colour
uniform float power;  /// Specular exponent

uniform sampler2D albedo;

uniform bool encodes_color;  /// True where the first target shows colours as sRGB, as a canvas does

in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;

layout(location = 0) out vec4 out_color;

vec3 lambert_phong(vec3 to_light, vec3 diffuse, vec3 specular, vec3 normal_, vec3 tint, vec3 to_eye) {
    float normal_dot_to_light = dot(normal_, to_light);
    vec3 phong = shine * (
        normal_dot_to_light > 0.0
        ? pow(clamp(dot(reflect(-to_light, normal_), to_eye), 0.0, 1.0), power)
        : 0.0
    ) * specular;
    return tint * clamp(normal_dot_to_light, 0.0, 1.0) * diffuse + phong;
}

void main() {
    vec3 tint = base * texture(albedo, v_uv).xyz;
    // Zero stays zero.
    vec3 normal_ = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    vec3 to_eye = normalize(cameraPosition - v_position);
    vec3 color_total = vec3(0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        vec3 lamps_to_light = normalize(lamps[i].place - v_position);
        color_total += lambert_phong(
            lamps_to_light, lamps[i].diffuse_color, lamps[i].specular_color, normal_, tint, to_eye
        );
    }
    vec3 torch_to_light = normalize(torch_place - v_position);
    float torch_falloff = smoothstep(
        0.0, 1.0, (dot(torch_axis, -torch_to_light) - torch_falloff_cos) * torch_falloff_inverse_width
    );
    vec3 color_ = tint * ambient_light
        + lambert_phong(-sun_direction, sun_diffuse_color, sun_specular_color, normal_, tint, to_eye)
        + color_total
        + lambert_phong(
            torch_to_light, torch_diffuse_color * torch_falloff, torch_specular_color * torch_falloff,
            normal_, tint, to_eye
        );
    out_color = vec4(color_, 1.0);
    if (encodes_color) {
        vec3 linear_color = clamp(out_color.rgb, 0.0, 1.0);
        out_color.rgb = mix(
            1.055 * pow(linear_color, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear_color,
            lessThan(linear_color, vec3(0.0031308))
        );
    }
}
`;

const halves = (numbers) => new Uint16Array(numbers.map((number) => DataUtils.toHalfFloat(number)));
const ready = (made) => Object.assign(made, { type: HalfFloatType, needsUpdate: true });
const texel = (...numbers) => ready(new DataTexture(halves(numbers), 1, 1));

/** How textures are read. */
const sampling = {
  albedo: { wrapS: RepeatWrapping, wrapT: RepeatWrapping, magFilter: LinearFilter, minFilter: LinearMipmapLinearFilter },
};

/** The uniforms: what a user sets, what the renderer knows, and what follows from these. */
const uniforms = () => ({
  view_projection: { value: new Matrix4().fromArray([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]) }, // World to clip space
  cameraPosition: { value: new Vector3(0, 0, 5) }, // Where the viewer stands
  ambient_light: { value: new Color().setRGB(0.1, 0.1, 0.1) }, // Light from everywhere; linear
  sun_diffuse_color: { value: new Color().setRGB(1, 1, 1) }, // linear
  sun_specular_color: { value: new Color().setRGB(1, 1, 1) }, // linear
  sun_direction: { value: new Vector3(0, -1, 0) }, // Where the light travels; length 1
  lamps: { value: Array.from({ length: 8 }, () => ({ diffuse_color: new Color().setRGB(1, 1, 1), specular_color: new Color().setRGB(1, 1, 1), place: new Vector3() })) },
  lamps_count: { value: 0 }, // The number of `lamps` that shine; 0 to 8
  torch_diffuse_color: { value: new Color().setRGB(1, 1, 1) }, // linear
  torch_specular_color: { value: new Color().setRGB(1, 1, 1) }, // linear
  torch_place: { value: new Vector3() }, // On no surface that is drawn; no default: has to be set
  torch_axis: { value: new Vector3(0, -1, 0) }, // Where the light travels; length 1
  torch_inner: { value: 0.3490658503988659 }, // 0 to 1.5708; radians
  torch_outer: { value: 0.5235987755982988 }, // 0 to 1.5708; radians
  base: { value: new Color().setRGB(0.4620769996544071, 0.1301364766903643, 0.012286488356915872) }, // Base colour; linear
  shine: { value: new Color().setRGB(1, 1, 1) }, // Highlight colour; linear
  power: { value: 48 }, // Specular exponent; 1 to 512
  modelMatrix: { value: new Matrix4().fromArray([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]) },
  torch_falloff_cos: { value: 0 },
  torch_falloff_inverse_width: { value: 0 },
  normal_matrix: { value: new Float32Array(9) },
  albedo: { value: Object.assign(texel(1, 1, 1, 1), sampling.albedo) }, // Multiplies the base colour; its colours are decoded: give it `SRGBColorSpace`
  encodes_color: { value: false }, // on a canvas
});

/** Arrays, with the uniform that has the number of the elements in use. */
const counters = { lamps: "lamps_count" };

/** World to clip space, where depths are from 0 to 1: the shader makes those of WebGL of them. */
const setWorldToClip = (matrix, camera) => {
  const { elements } = matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  for (let row = 2; row < 16; row += 4) elements[row] = 0.5 * (elements[row] + elements[row + 1]);
};

/** A value of its own for a copy of a material; textures are shared. */
const copied = (value) => {
  if (ArrayBuffer.isView(value)) return value.slice();
  if (Array.isArray(value)) return value.map(copied);
  if (typeof value !== "object" || value === null || value.isTexture) return value;
  if (value.clone) return value.clone();
  return Object.fromEntries(Object.entries(value).map(([name, each]) => [name, copied(each)]));
};

function quotient(x, y) {
  return Math.abs(y) < 2 ** -126 ? 0 : x / y;
}

/** What follows from Rig. */
function deriveStudioRig(u) {
  const torchOuter = u.torch_outer.value;
  const torchFalloffCos = Math.cos(torchOuter);
  u.torch_falloff_cos.value = torchFalloffCos;
  const difference = Math.cos(Math.min(u.torch_inner.value, torchOuter)) - torchFalloffCos;
  u.torch_falloff_inverse_width.value = Math.abs(difference) >= 2 ** -64 ? quotient(1, difference) : 2 ** 64;
}

/** What follows from Draw. */
function deriveDraw(u) {
  const objectToWorld0X = u.modelMatrix.value.elements[0];
  const objectToWorld0Y = u.modelMatrix.value.elements[1];
  const objectToWorld0Z = u.modelMatrix.value.elements[2];
  const objectToWorld1X = u.modelMatrix.value.elements[4];
  const objectToWorld1Y = u.modelMatrix.value.elements[5];
  const objectToWorld1Z = u.modelMatrix.value.elements[6];
  const objectToWorld2X = u.modelMatrix.value.elements[8];
  const objectToWorld2Y = u.modelMatrix.value.elements[9];
  const objectToWorld2Z = u.modelMatrix.value.elements[10];
  const product = objectToWorld1Y * objectToWorld2Z;
  const product2 = objectToWorld1X * objectToWorld2Z;
  const product3 = objectToWorld1X * objectToWorld2Y;
  const determinant = objectToWorld0X * (product + objectToWorld1Z * -objectToWorld2Y) + objectToWorld0Y * -(product2 + objectToWorld1Z * -objectToWorld2X) + objectToWorld0Z * (product3 + objectToWorld1Y * -objectToWorld2X);
  const choice = Math.abs(determinant) >= 2 ** -126 ? quotient(1, determinant) : 0;
  u.normal_matrix.value[0] = (product - objectToWorld1Z * objectToWorld2Y) * choice;
  u.normal_matrix.value[1] = (objectToWorld1Z * objectToWorld2X - product2) * choice;
  u.normal_matrix.value[2] = (product3 - objectToWorld1Y * objectToWorld2X) * choice;
  u.normal_matrix.value[3] = (objectToWorld2Y * objectToWorld0Z - objectToWorld2Z * objectToWorld0Y) * choice;
  u.normal_matrix.value[4] = (objectToWorld2Z * objectToWorld0X - objectToWorld2X * objectToWorld0Z) * choice;
  u.normal_matrix.value[5] = (objectToWorld2X * objectToWorld0Y - objectToWorld2Y * objectToWorld0X) * choice;
  u.normal_matrix.value[6] = (objectToWorld0Y * objectToWorld1Z - objectToWorld0Z * objectToWorld1Y) * choice;
  u.normal_matrix.value[7] = (objectToWorld0Z * objectToWorld1X - objectToWorld0X * objectToWorld1Z) * choice;
  u.normal_matrix.value[8] = (objectToWorld0X * objectToWorld1Y - objectToWorld0Y * objectToWorld1X) * choice;
}

export class PlasticMaterial extends RawShaderMaterial {
  #frame = -1;
  #camera = null;

  constructor(values = {}) {
    super({
      name: "Plastic",
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: uniforms(),
      side: DoubleSide,
      forceSinglePass: true,
      depthTest: true,
      depthFunc: LessDepth,
      depthWrite: true,
      blending: NoBlending,
    });
    this.set(values);
  }

  /** Sets uniforms by their names; of arrays as many elements as are given, which then count. */
  set(values) {
    for (const [name, value] of Object.entries(values)) {
      if (!(name in this.uniforms)) throw new Error(`Plastic has no uniform ${name}`);
      const uniform = this.uniforms[name];
      if (name in counters && Array.isArray(uniform.value)) {
        if (value.length > uniform.value.length) {
          throw new RangeError(`${name} takes at most ${uniform.value.length} elements, not ${value.length}`);
        }
        value.forEach((element, number) => {
          const old = uniform.value[number];
          if (old.copy) old.copy(element);
          else Object.assign(old, element);
        });
        if (counters[name] !== null) this.uniforms[counters[name]].value = value.length;
        continue;
      }
      if (value?.isTexture && name in sampling) {
        Object.assign(value, sampling[name]);
        if (value.version > 0) value.needsUpdate = true;
      }
      uniform.value = value;
    }
    return this;
  }

  copy(source) {
    super.copy(source);
    for (const [name, { value }] of Object.entries(source.uniforms)) this.uniforms[name].value = copied(value);
    return this;
  }

  onBeforeRender(renderer, scene, camera, geometry, object) {
    const u = this.uniforms;
    const { frame } = renderer.info.render;
    if (frame !== this.#frame || camera !== this.#camera) {
      this.#frame = frame;
      this.#camera = camera;
      setWorldToClip(u.view_projection.value, camera);
      u.cameraPosition.value.setFromMatrixPosition(camera.matrixWorld);
      deriveStudioRig(u);
      u.encodes_color.value = renderer.getRenderTarget() === null && renderer.outputColorSpace === SRGBColorSpace;
    }
    u.modelMatrix.value = object.matrixWorld;
    deriveDraw(u);
    this.uniformsNeedUpdate = true;
  }
}
