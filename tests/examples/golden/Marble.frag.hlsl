// Marble: fragment shader, by Burnish.
// Marble without a texture: veins where the noise is high. The functions come from a file beside
// this one, and others can use them as well.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Rig : register(b0, space1) {
    float3 ambient_light;  /// Light from everywhere
    float3 sun_diffuse_color;
    float3 sun_specular_color;
    float3 sun_direction;  /// Where the light travels
};

cbuffer Material : register(b0, space2) {
    float3 stone;
    float3 veins;
    float grain;  /// How many veins there are
};

struct FragmentInput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
};

float4 main(FragmentInput input) : SV_Target0 {
    float3 vein_product = input.position * grain;
    float vein_turbulence = 0.0;
    for (int i = 0; i < 4; i++) {
        float vein_octave = exp2(float(i));
        float3 vein_product_ = vein_product * vein_octave;
        float vein_product_2 = 0.5 * sin(vein_product_.x + 2.0 * sin(vein_product_.y))
            * sin(vein_product_.z + 2.0 * sin(vein_product_.x));
        vein_turbulence += (0.5 + vein_product_2) / (2.0 * vein_octave);
    }
    float vein = vein_turbulence >= 1.1754944e-38 ? pow(vein_turbulence, 3.0) : 0.0;
    float3 kd = stone + (veins - stone) * vein;
    // Zero stays zero.
    float3 normal = input.normal * rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    float normal_dot_sun_to_light = dot(normal, -sun_direction);
    float color_mirrored = 0.0;
    if (normal_dot_sun_to_light > 0.0) {
        float3 to_eye = normalize(eye - input.position);
        color_mirrored = pow(saturate(dot(reflect(sun_direction, normal), to_eye)), 80.0);
    }
    float3 color = kd * ambient_light + (
        kd * saturate(normal_dot_sun_to_light) * sun_diffuse_color + 0.5 * color_mirrored * sun_specular_color
    );
    return float4(color, 1.0);
}
