// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct Lamp {
    float3 place;
    float pad_0;
    float3 diffuse;
    float pad_1;
};

cbuffer View : register(b1, space0) {
    column_major float4x4 world_to_clip;
    float3 eye;  /// Where the camera stands, in world space
};

cbuffer Rig : register(b0, space1) {
    float3 sun_direction;
    int lamps_count;
    Lamp lamps[8];
};

cbuffer DerivedFromRig : register(b4, space2) {
    float sun_cos_outer;  /// cos(outer)
};

cbuffer Material : register(b0, space2) {
    float3 base;  /// Base colour
    float power;  /// Specular exponent
};

Texture2D<float4> albedo : register(t5, space2);
SamplerState albedo_sampler : register(s6, space2);

struct FragmentInput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float4 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
};

/// What one light contributes.
float3 shade(float3 to_light, float3 normal, float3 to_eye, float3 tint) {
    float n_dot_l = dot(normal, to_light);
    float highlight = 0.0;
    if (n_dot_l > 0.0) {
        float3 mirrored = reflect(-to_light, normal);
        highlight = pow(saturate(dot(mirrored, to_eye)), power);
    }
    return tint * saturate(n_dot_l) + highlight.xxx;
}

float4 main(FragmentInput input) : SV_Target0 {
    float3 normal = normalize(input.normal.xyz);
    float3 to_eye = normalize(eye - input.position);
    // Base colour times the map
    float3 tint = base * albedo.Sample(albedo_sampler, input.uv).xyz;
    float3 from_lamps = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        float3 to_light = normalize(lamps[i].place - input.position);
        from_lamps += shade(to_light, normal, to_eye, tint) * lamps[i].diffuse;
    }
    float3 color = (tint * 0.1 + shade(-sun_direction, normal, to_eye, tint) + from_lamps) * sun_cos_outer;
    return float4(color, 1.0);
}
