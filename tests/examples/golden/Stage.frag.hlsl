// Stage: fragment shader, by Burnish.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Rig : register(b0, space1) {
    float3 ambient_light;  /// Light from everywhere
    float3 key_diffuse_color;
    float3 key_specular_color;
    float3 key_place;  /// On no surface that is drawn
    float3 key_axis;  /// Where the light travels
    float key_inner;
    float key_outer;
    float rig_pad_0;
    float rig_pad_1;
    float rig_pad_2;
    column_major float4x4 key_to_map;  /// What the map was drawn with
    float key_bias;  /// Against surfaces in their own shadow
    float key_spread;  /// Between the samples, in texels
};

cbuffer DerivedFromRig : register(b4, space2) {
    float key_falloff_cos;
    float key_falloff_inverse_width;
};

cbuffer Material : register(b0, space2) {
    float3 base;
};

Texture2D<float> key_shadow : register(t1, space1);
SamplerComparisonState key_shadow_sampler : register(s2, space1);

int2 texture_size(Texture2D<float> texels, int level) {
    uint width, height, levels;
    texels.GetDimensions(level, width, height, levels);
    return int2(width, height);
}

struct FragmentInput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
};

float4 main(FragmentInput input) : SV_Target0 {
    // Zero stays zero.
    float3 normal = input.normal * rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    float3 key_to_light = normalize(key_place - input.position);
    float normal_dot_key_to_light = dot(normal, key_to_light);
    float3 color_negated = -key_to_light;
    float inherited_key_falloff = smoothstep(
        0.0, 1.0, (dot(key_axis, color_negated) - key_falloff_cos) * key_falloff_inverse_width
    );
    float4 key_projected = mul(key_to_map, float4(input.position, 1.0));
    // Zero over zero, and anything else over zero, is zero: in all lanes, or in none.
    float3 key_seen = abs(key_projected.w) >= 1.1754944e-38
        ? key_projected.xyz / key_projected.w
        : float3(0.0, 0.0, 0.0);
    float2 key_centre = float2(0.5 + 0.5 * key_seen.x, 0.5 - 0.5 * key_seen.y);
    float2 key_texel = key_spread / float2(texture_size(key_shadow, 0));
    float key_lit_clamped = saturate(key_seen.z - key_bias);
    float key_lit_total = 0.0;
    for (int i = 0; i < 9; i++) {
        key_lit_total += key_shadow.SampleCmpLevelZero(
            key_shadow_sampler, key_centre + key_texel * float2(float(i % 3 - 1), float(i / 3 - 1)),
            key_lit_clamped
        );
    }
    float key_falloff = inherited_key_falloff * (key_lit_total / 9.0);
    float color_mirrored = 0.0;
    if (normal_dot_key_to_light > 0.0) {
        float3 to_eye = normalize(eye - input.position);
        color_mirrored = pow(saturate(dot(reflect(color_negated, normal), to_eye)), 24.0);
    }
    float3 color = base * ambient_light + (
        base * saturate(normal_dot_key_to_light) * (key_diffuse_color * key_falloff)
        + 0.2 * color_mirrored * (key_specular_color * key_falloff)
    );
    return float4(color, 1.0);
}
