// Plastic: vertex and fragment shaders, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct Lamp {
    place: vec3f,
    pad_0: f32,
    diffuse: vec3f,
    pad_1: f32,
}

struct View {
    world_to_clip: mat4x4f,
    eye: vec3f,  /// Where the camera stands, in world space
}

struct Rig {
    sun_direction: vec3f,
    lamps_count: i32,
    lamps: array<Lamp, 8>,
}

struct DerivedFromRig {
    sun_cos_outer: f32,  /// cos(outer)
}

struct Material {
    base: vec3f,  /// Base colour
    power: f32,  /// Specular exponent
}

struct Draw {
    object_to_world: mat4x4f,
}

@group(0) @binding(1) var<uniform> view: View;
@group(1) @binding(0) var<uniform> rig: Rig;
@group(2) @binding(4) var<uniform> derived_from_rig: DerivedFromRig;
@group(2) @binding(0) var<uniform> material: Material;
@group(3) @binding(0) var<uniform> draw: Draw;
@group(2) @binding(5) var albedo: texture_2d<f32>;
@group(2) @binding(6) var albedo_sampler: sampler;

struct VertexInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
}

struct VertexOutput {
    @location(0) position: vec3f,
    @location(1) normal: vec4f,
    @location(2) uv: vec2f,
    @builtin(position) clip_position: vec4f,
}

@vertex
fn vs_main(input: VertexInput) -> VertexOutput {
    // In world space, homogeneous
    let position = draw.object_to_world * vec4f(input.position, 1.0);
    var output: VertexOutput;
    output.position = position.xyz;
    output.normal = vec4f((draw.object_to_world * vec4f(input.normal, 0.0)).xyz, 0.5);
    output.uv = input.uv;
    output.clip_position = view.world_to_clip * position;
    return output;
}

struct FragmentInput {
    @location(0) position: vec3f,
    @location(1) normal: vec4f,
    @location(2) uv: vec2f,
}

/// What one light contributes.
fn shade(to_light: vec3f, normal: vec3f, to_eye: vec3f, tint: vec3f) -> vec3f {
    let n_dot_l = dot(normal, to_light);
    var highlight: f32 = 0.0;
    if (n_dot_l > 0.0) {
        let mirrored = reflect(-to_light, normal);
        highlight = pow(saturate(dot(mirrored, to_eye)), material.power);
    }
    return tint * saturate(n_dot_l) + vec3f(highlight);
}

@fragment
fn fs_main(input: FragmentInput) -> @location(0) vec4f {
    let normal = normalize(input.normal.xyz);
    let to_eye = normalize(view.eye - input.position);
    // Base colour times the map
    let tint = material.base * textureSample(albedo, albedo_sampler, input.uv).xyz;
    var from_lamps: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < min(rig.lamps_count, 8); i++) {
        let to_light = normalize(rig.lamps[i].place - input.position);
        from_lamps += shade(to_light, normal, to_eye, tint) * rig.lamps[i].diffuse;
    }
    let color = (tint * 0.1 + shade(-rig.sun_direction, normal, to_eye, tint) + from_lamps)
        * derived_from_rig.sun_cos_outer;
    return vec4f(color, 1.0);
}
