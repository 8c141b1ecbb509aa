// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

/// base: Base colour
/// albedo: Multiplies the base colour
fn plastic_tint(uv: vec2f, base: vec3f, albedo: texture_2d<f32>, albedo_sampler: sampler) -> vec3f {
    return base * textureSample(albedo, albedo_sampler, uv).xyz;
}
