// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

/// base: Base colour
/// albedo: Multiplies the base colour
float3 plastic_tint(float2 uv, float3 base, texture2d<float> albedo, sampler albedo_sampler) {
    return base * albedo.sample(albedo_sampler, uv).xyz;
}
