// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    diffuse_color: vec3f,
    pad_0: f32,
    specular_color: vec3f,
    pad_1: f32,
    place: vec3f,
    pad_2: f32,
}

struct View {
    view_projection: mat4x4f,  /// World to clip space
    eye: vec3f,  /// Where the viewer stands
}

struct Rig {
    ambient_light: vec3f,  /// Light from everywhere
    sun_diffuse_color: vec3f,
    sun_specular_color: vec3f,
    sun_direction: vec3f,  /// Where the light travels
    rig_pad_0: f32,
    lamps: array<Point, 8>,
    lamps_count: i32,  /// The number of `lamps` that shine
    rig_pad_1: f32,
    rig_pad_2: f32,
    rig_pad_3: f32,
    torch_diffuse_color: vec3f,
    torch_specular_color: vec3f,
    torch_place: vec3f,  /// On no surface that is drawn
    torch_axis: vec3f,  /// Where the light travels
    torch_inner: f32,
    torch_outer: f32,
}

struct DerivedFromRig {
    torch_falloff_cos: f32,
    torch_falloff_inverse_width: f32,
}

struct Material {
    base: vec3f,  /// Base colour
    shine: vec3f,  /// Highlight colour
    power: f32,  /// Specular exponent
}

@group(0) @binding(1) var<uniform> view: View;
@group(1) @binding(0) var<uniform> rig: Rig;
@group(2) @binding(4) var<uniform> derived_from_rig: DerivedFromRig;
@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(5) var albedo: texture_2d<f32>;
@group(2) @binding(6) var albedo_sampler: sampler;

struct FragmentInput {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
}

fn lambert_phong(
    to_light: vec3f, diffuse: vec3f, specular: vec3f, normal: vec3f, tint: vec3f, to_eye: vec3f
) -> vec3f {
    let normal_dot_to_light = dot(normal, to_light);
    let phong = material.shine * select(
        0.0, pow(saturate(dot(reflect(-to_light, normal), to_eye)), material.power), normal_dot_to_light > 0.0
    ) * specular;
    return tint * saturate(normal_dot_to_light) * diffuse + phong;
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    let tint = material.base * textureSample(albedo, albedo_sampler, input.uv).xyz;
    // Zero stays zero.
    let normal = input.normal * inverseSqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    let to_eye = normalize(view.eye - input.position);
    var color_total: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < min(rig.lamps_count, 8); i++) {
        let lamps_to_light = normalize(rig.lamps[i].place - input.position);
        color_total += lambert_phong(
            lamps_to_light, rig.lamps[i].diffuse_color, rig.lamps[i].specular_color, normal, tint, to_eye
        );
    }
    let torch_to_light = normalize(rig.torch_place - input.position);
    let torch_falloff = smoothstep(
        0.0, 1.0,
        (dot(rig.torch_axis, -torch_to_light) - derived_from_rig.torch_falloff_cos)
            * derived_from_rig.torch_falloff_inverse_width
    );
    let color = tint * rig.ambient_light
        + lambert_phong(
            -rig.sun_direction, rig.sun_diffuse_color, rig.sun_specular_color, normal, tint, to_eye
        )
        + color_total
        + lambert_phong(
            torch_to_light, rig.torch_diffuse_color * torch_falloff, rig.torch_specular_color * torch_falloff,
            normal, tint, to_eye
        );
    return vec4f(color, 1.0);
}
