// PerVertex: vertex shader, by Burnish.
// Per vertex, after Gouraud: the colour is computed at the vertices and interpolated.

struct View {
    view_projection: mat4x4f,  /// World to clip space
    eye: vec3f,  /// Where the viewer stands
}

struct Rig {
    ambient_light: vec3f,  /// Light from everywhere
    sun_diffuse_color: vec3f,
    sun_specular_color: vec3f,
    sun_direction: vec3f,  /// Where the light travels
}

struct Material {
    kd: vec3f,
    p: f32,
}

struct Draw {
    object_to_world: mat4x4f,
}

struct DrawDerived {
    normal_matrix: mat3x4f,
}

@group(0) @binding(1) var<uniform> view: View;
@group(1) @binding(0) var<uniform> rig: Rig;
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
    let normal_upright = (draw_derived.normal_matrix * input.vertex_normal).xyz;
    // Zero stays zero.
    let normal = normal_upright * inverseSqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    let normal_dot_sun_to_light = dot(normal, -rig.sun_direction);
    var color_mirrored: f32 = 0.0;
    if (normal_dot_sun_to_light > 0.0) {
        let to_eye = normalize(view.eye - position);
        color_mirrored = pow(saturate(dot(reflect(rig.sun_direction, normal), to_eye)), material.p);
    }
    var output: VertexOutput;
    output.color = material.kd * rig.ambient_light + (
        material.kd * saturate(normal_dot_sun_to_light) * rig.sun_diffuse_color
        + 0.6 * color_mirrored * rig.sun_specular_color
    );
    output.clip_position = view.view_projection * vec4f(position, 1.0);
    return output;
}
