// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    float3 diffuse_color;
    float pad_0;
    float3 specular_color;
    float pad_1;
    float3 place;
    float pad_2;
};

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Rig : register(b0, space1) {
    float3 ambient_light;  /// Light from everywhere
    float3 sun_diffuse_color;
    float3 sun_specular_color;
    float3 sun_direction;  /// Where the light travels
    float rig_pad_0;
    Point lamps[8];
    int lamps_count;  /// The number of `lamps` that shine
    float rig_pad_1;
    float rig_pad_2;
    float rig_pad_3;
    float3 torch_diffuse_color;
    float3 torch_specular_color;
    float3 torch_place;  /// On no surface that is drawn
    float3 torch_axis;  /// Where the light travels
    float torch_inner;
    float torch_outer;
};

cbuffer DerivedFromRig : register(b4, space2) {
    float torch_falloff_cos;
    float torch_falloff_inverse_width;
};

cbuffer Material : register(b0, space2) {
    float3 base;  /// Base colour
    float3 shine;  /// Highlight colour
    float power;  /// Specular exponent
};

Texture2D<float4> albedo : register(t5, space2);
SamplerState albedo_sampler : register(s6, space2);

struct FragmentInput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
};

float3 lambert_phong(
    float3 to_light, float3 diffuse, float3 specular, float3 normal, float3 tint, float3 to_eye
) {
    float normal_dot_to_light = dot(normal, to_light);
    float3 phong = shine
        * (normal_dot_to_light > 0.0 ? pow(saturate(dot(reflect(-to_light, normal), to_eye)), power) : 0.0)
        * specular;
    return tint * saturate(normal_dot_to_light) * diffuse + phong;
}

float4 main(FragmentInput input) : SV_Target0 {
    float3 tint = base * albedo.Sample(albedo_sampler, input.uv).xyz;
    // Zero stays zero.
    float3 normal = input.normal * rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    float3 to_eye = normalize(eye - input.position);
    float3 color_total = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        float3 lamps_to_light = normalize(lamps[i].place - input.position);
        color_total += lambert_phong(
            lamps_to_light, lamps[i].diffuse_color, lamps[i].specular_color, normal, tint, to_eye
        );
    }
    float3 torch_to_light = normalize(torch_place - input.position);
    float torch_falloff = smoothstep(
        0.0, 1.0, (dot(torch_axis, -torch_to_light) - torch_falloff_cos) * torch_falloff_inverse_width
    );
    float3 color = tint * ambient_light
        + lambert_phong(-sun_direction, sun_diffuse_color, sun_specular_color, normal, tint, to_eye)
        + color_total
        + lambert_phong(
            torch_to_light, torch_diffuse_color * torch_falloff, torch_specular_color * torch_falloff, normal,
            tint, to_eye
        );
    return float4(color, 1.0);
}
