// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

/// base: Base colour
/// albedo: Multiplies the base colour
float3 plastic_tint(float2 uv, float3 base, Texture2D<float4> albedo, SamplerState albedo_sampler) {
    return base * albedo.Sample(albedo_sampler, uv).xyz;
}
