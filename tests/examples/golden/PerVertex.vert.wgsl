// PerVertex: vertex shader, by Burnish.
// Per vertex, after Gouraud: the colour is computed at the vertices and interpolated.

struct View {
    view_projection: mat4x4f,  /// World to clip space
    eye: vec3f,  /// Where the viewer stands
}

struct Rig {
    ambient_light: vec3f,  /// Light from everywhere
    rig_pad_0: f32,
    sun_diffuse_color: vec3f,
    rig_pad_1: f32,
    sun_specular_color: vec3f,
    rig_pad_2: f32,
    sun_direction: vec3f,  /// Where the light travels
}

struct RigDerived {
    color_product: vec3f,
}

struct Material {
    kd: vec3f,
    p: f32,
}

struct Draw {
    object_to_world: mat4x4f,
}

struct DrawDerived {
    normal_matrix: array<vec4f, 3>,
}

@group(0) @binding(0) var<uniform> view: View;
@group(1) @binding(0) var<uniform> rig: Rig;
@group(1) @binding(1) var<uniform> rig_derived: RigDerived;
@group(2) @binding(0) var<uniform> material: Material;
@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(1) var<uniform> draw_derived: DrawDerived;

struct VertexInput {
    @location(0) vertex_position: vec3f,
    @location(1) vertex_normal: vec3f,
}

struct VertexOutput {
    @location(0) color: vec3f,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn main(input: VertexInput) -> VertexOutput {
    let position = (draw.object_to_world * vec4f(input.vertex_position, 1.0)).xyz;
    let normal_product = mat3x3f(draw_derived.normal_matrix[0].xyz, draw_derived.normal_matrix[1].xyz, draw_derived.normal_matrix[2].xyz) * input.vertex_normal;
    let normal = normal_product * inverseSqrt(max(dot(normal_product, normal_product), 1.1754944e-38));
    let normal_dot_sun_to_light = dot(normal, -rig.sun_direction);
    var phong: vec3f = vec3f(0.0);
    if (normal_dot_sun_to_light > 0.0) {
        let to_eye_difference = view.eye - position;
        let to_eye = to_eye_difference * inverseSqrt(max(dot(to_eye_difference, to_eye_difference), 1.1754944e-38));
        phong = rig_derived.color_product * pow(saturate(dot(reflect(rig.sun_direction, normal), to_eye)), material.p);
    }
    var output: VertexOutput;
    output.color = material.kd * rig.ambient_light + (material.kd * rig.sun_diffuse_color * saturate(normal_dot_sun_to_light) + phong);
    output.clip_position = view.view_projection * vec4f(position, 1.0);
    return output;
}
