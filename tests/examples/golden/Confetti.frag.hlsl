// Confetti: fragment shader, by Burnish.
// Paper that somebody has strewn with squares.

cbuffer Material : register(b0, space2) {
    float3 paper;
    int cells;  /// Squares across
    uint seed;
};

struct FragmentInput {
    [[vk::location(0)]] float2 place : TEXCOORD0;
};

/// Mixes the bits of a number until each depends on all of them.
uint scattered(uint n) {
    uint twisted = (n ^ (n >> 15u)) * 2146121005u;
    return (twisted ^ (twisted >> 15u)) * 2221713035u;
}

float4 safe_unpack_unorm4x8(uint p) {
    return float4(uint4(p, p >> 8u, p >> 16u, p >> 24u) & uint4(255u, 255u, 255u, 255u)) / 255.0;
}

float4 main(FragmentInput input) : SV_Target0 {
    // Clamped to the floats that an `int` holds.
    int column = int(clamp(floor(input.place.x), -2147483600.0, 2147483500.0));
    // Clamped to the floats that an `int` holds.
    int row = int(clamp(floor(input.place.y), -2147483600.0, 2147483500.0));
    uint drawn = scattered(asuint((column & 255) | ((row & 255) << 8u)) ^ (seed << 16u));
    float4 chance = safe_unpack_unorm4x8(drawn);
    float2 centre = lerp(float2(0.25, 0.25), float2(0.75, 0.75), chance.xy);
    bool inside = all(abs(frac(input.place) - centre) < (0.08 + 0.14 * chance.z).xx);
    float3 color;
    if (inside && chance.w > 0.3) {
        float3 tint = safe_unpack_unorm4x8(scattered(drawn)).xyz;
        color = tint * tint;
    } else {
        color = paper;
    }
    return float4(color, 1.0);
}
