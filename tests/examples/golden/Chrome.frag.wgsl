// Chrome: fragment shader, by Burnish.
// Polished metal that mirrors its surroundings, blurred where it is rough.

struct Rig {
    ambient_light: vec3f,  /// Light from everywhere
    sun_diffuse_color: vec3f,
    sun_specular_color: vec3f,
    sun_direction: vec3f,  /// Where the light travels
}

struct Material {
    tint: vec3f,  /// Reflectance, seen head on
    roughness: f32,  /// 0 is a mirror
    levels: f32,  /// Levels of the map, each blurred more
}

@group(1) @binding(0) var<uniform> rig: Rig;
@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(5) var surroundings: texture_cube<f32>;
@group(2) @binding(6) var surroundings_sampler: sampler;

struct FragmentInput {
    @location(0) position_shifted: vec3f,
    @location(1) normal: vec3f,
}

@fragment
fn main(input: FragmentInput) -> @location(0) vec4f {
    let to_eye = normalize(input.position_shifted);
    // Zero stays zero.
    let normal = input.normal * inverseSqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    let mirrored = reflect(-to_eye, normal);
    let share = material.tint + (1.0 - material.tint) * pow(1.0 - saturate(dot(normal, to_eye)), 5.0);
    let color = textureSampleLevel(
            surroundings, surroundings_sampler, mirrored, material.roughness * material.levels
        ).xyz * share
        + 0.1 * material.tint * saturate(dot(normal, -rig.sun_direction)) * rig.sun_diffuse_color;
    return vec4f(color, 1.0);
}
