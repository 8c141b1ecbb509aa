// CarPaint: fragment shader, by Burnish.
// Car paint: flakes scatter the light under a coat that is smooth, so one term is given another
// normal than the rest.

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
    paint: vec3f,  /// Colour under the coat
    flakes: f32,  /// How much the flakes stand off
}

@group(1) @binding(0) var<uniform> rig: Rig;
@group(1) @binding(1) var<uniform> rig_derived: RigDerived;
@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var grain: texture_2d<f32>;
@group(2) @binding(2) var grain_sampler: sampler;

struct FragmentInput {
    @location(0) position_shifted: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv_scaled: vec2f,
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    let normal = input.normal * inverseSqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    let grain_ = textureSample(grain, grain_sampler, input.uv_scaled);
    let normal_sum = normal + material.flakes * (2.0 * grain_.xyz - 1.0);
    let normal_ = normal_sum * inverseSqrt(max(dot(normal_sum, normal_sum), 1.1754944e-38));
    let sun_to_light = -rig.sun_direction;
    let normal_dot_sun_to_light = dot(normal_, sun_to_light);
    let to_eye = input.position_shifted * inverseSqrt(max(dot(input.position_shifted, input.position_shifted), 1.1754944e-38));
    var phong: vec3f = vec3f(0.0);
    if (normal_dot_sun_to_light > 0.0) {
        phong = material.paint * rig.sun_specular_color * pow(saturate(dot(reflect(rig.sun_direction, normal_), to_eye)), 12.0);
    }
    var phong_: vec3f = vec3f(0.0);
    if (dot(normal, sun_to_light) > 0.0) {
        phong_ = rig_derived.color_product * pow(saturate(dot(reflect(rig.sun_direction, normal), to_eye)), 180.0);
    }
    let color = material.paint * rig.ambient_light + (material.paint * rig.sun_diffuse_color * saturate(normal_dot_sun_to_light) + phong + phong_);
    return vec4f(color, 1.0);
}
