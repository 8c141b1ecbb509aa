// CarPaint: fragment shader, by Burnish.
// Car paint: flakes scatter the light under a coat that is smooth, so one term is given another
// normal than the rest.

struct Rig {
    ambient_light: vec3f,  /// Light from everywhere
    sun_diffuse_color: vec3f,
    sun_specular_color: vec3f,
    sun_direction: vec3f,  /// Where the light travels
}

struct Material {
    paint: vec3f,  /// Colour under the coat
    flakes: f32,  /// How much the flakes stand off
}

@group(1) @binding(0) var<uniform> rig: Rig;
@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(5) var grain: texture_2d<f32>;
@group(2) @binding(6) var grain_sampler: sampler;

struct FragmentInput {
    @location(0) position_shifted: vec3f,
    @location(1) inherited_normal: vec3f,
    @location(2) uv_scaled: vec2f,
}

/// Zero stays zero.
fn safe_normalize(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1.1754944e-38));
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    let inherited_normal = safe_normalize(input.inherited_normal);
    let grain_ = textureSample(grain, grain_sampler, input.uv_scaled);
    let normal = safe_normalize(inherited_normal + material.flakes * (2.0 * grain_.xyz - 1.0));
    let sun_to_light = -rig.sun_direction;
    let normal_dot_sun_to_light = dot(normal, sun_to_light);
    let to_eye = normalize(input.position_shifted);
    let lambert_phong = material.paint * saturate(normal_dot_sun_to_light) * rig.sun_diffuse_color
        + material.paint * select(
            0.0, pow(saturate(dot(reflect(rig.sun_direction, normal), to_eye)), 12.0),
            normal_dot_sun_to_light > 0.0
        ) * rig.sun_specular_color;
    let lambert_phong_phong = lambert_phong
        + 0.8 * select(
            0.0, pow(saturate(dot(reflect(rig.sun_direction, inherited_normal), to_eye)), 180.0),
            dot(inherited_normal, sun_to_light) > 0.0
        ) * rig.sun_specular_color;
    let color = material.paint * rig.ambient_light + lambert_phong_phong;
    return vec4f(color, 1.0);
}
