// Plastic, for Unity: by Burnish. Never compiled by Unity's own compiler.
// Plastic after the classic three-term model.

#ifndef PLASTIC_OF_BURNISH
#define PLASTIC_OF_BURNISH

/// base: Base colour
/// albedo: Multiplies the base colour
float3 plastic_tint(float2 uv, float3 base, Texture2D<float4> albedo, SamplerState albedo_sampler) {
    return base * albedo.Sample(albedo_sampler, uv).xyz;
}

// The node's name is PlasticTint, and its precision Single.
// Its result goes to Base Color.
//   uv: the node UV
//   base: a property of the type rgb, usually (0.4621, 0.1301, 0.01229) (Base colour)
//   albedo: a texture, usually white, sRGB
void PlasticTint_float(float2 uv, float3 base, UnityTexture2D albedo, out float3 tint_out) {
    tint_out = plastic_tint(uv, base, albedo.tex, albedo.samplerstate);
}

#endif
