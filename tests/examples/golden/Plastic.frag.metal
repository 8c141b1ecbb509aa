// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    alignas(16) packed_float3 diffuse_color;
    float pad_0;
    alignas(16) packed_float3 specular_color;
    float pad_1;
    alignas(16) packed_float3 place;
    float pad_2;
};

struct View {
    float4x4 view_projection;  /// World to clip space
    alignas(16) packed_float3 eye;  /// Where the viewer stands
};

struct Rig {
    alignas(16) packed_float3 ambient_light;  /// Light from everywhere
    alignas(16) packed_float3 sun_diffuse_color;
    alignas(16) packed_float3 sun_specular_color;
    alignas(16) packed_float3 sun_direction;  /// Where the light travels
    float rig_pad_0;
    array<Point, 8> lamps;
    int lamps_count;  /// The number of `lamps` that shine
    float rig_pad_1;
    float rig_pad_2;
    float rig_pad_3;
    alignas(16) packed_float3 torch_diffuse_color;
    alignas(16) packed_float3 torch_specular_color;
    alignas(16) packed_float3 torch_place;  /// On no surface that is drawn
    alignas(16) packed_float3 torch_axis;  /// Where the light travels
    float torch_inner;
    float torch_outer;
};

struct DerivedFromRig {
    float torch_falloff_cos;
    float torch_falloff_inverse_width;
};

struct Material {
    alignas(16) packed_float3 base;  /// Base colour
    alignas(16) packed_float3 shine;  /// Highlight colour
    float power;  /// Specular exponent
};

struct FragmentInput {
    float3 position [[user(location0)]];
    float3 normal [[user(location1)]];
    float2 uv [[user(location2)]];
};

struct FragmentOutput {
    float4 color [[color(0)]];
};

float3 lambert_phong(
    constant Material& material, float3 to_light, float3 diffuse, float3 specular, float3 normal, float3 tint,
    float3 to_eye
) {
    const float normal_dot_to_light = dot(normal, to_light);
    const float3 phong = float3(material.shine) * (
        normal_dot_to_light > 0.0f
        ? precise::pow(saturate(dot(reflect(-to_light, normal), to_eye)), material.power)
        : 0.0f
    ) * specular;
    return tint * saturate(normal_dot_to_light) * diffuse + phong;
}

fragment FragmentOutput fs_main(
    FragmentInput input [[stage_in]], constant View& view [[buffer(1)]], constant Rig& rig [[buffer(2)]],
    constant DerivedFromRig& derived_from_rig [[buffer(7)]], constant Material& material [[buffer(3)]],
    texture2d<float> albedo [[texture(0)]], sampler albedo_sampler [[sampler(0)]]
) {
    const float3 tint = float3(material.base) * albedo.sample(albedo_sampler, input.uv).xyz;
    // Zero stays zero.
    const float3 normal = input.normal * precise::rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38f));
    const float3 to_eye = normalize(float3(view.eye) - input.position);
    float3 color_total = float3(0.0f);
    for (int i = 0; i < min(rig.lamps_count, 8); i++) {
        const float3 lamps_to_light = normalize(float3(rig.lamps[i].place) - input.position);
        color_total += lambert_phong(
            material, lamps_to_light, float3(rig.lamps[i].diffuse_color), float3(rig.lamps[i].specular_color),
            normal, tint, to_eye
        );
    }
    const float3 torch_to_light = normalize(float3(rig.torch_place) - input.position);
    const float torch_falloff = smoothstep(
        0.0f, 1.0f,
        (dot(float3(rig.torch_axis), -torch_to_light) - derived_from_rig.torch_falloff_cos)
            * derived_from_rig.torch_falloff_inverse_width
    );
    const float3 color = tint * float3(rig.ambient_light)
        + lambert_phong(
            material, -float3(rig.sun_direction), float3(rig.sun_diffuse_color),
            float3(rig.sun_specular_color), normal, tint, to_eye
        )
        + color_total
        + lambert_phong(
            material, torch_to_light, float3(rig.torch_diffuse_color) * torch_falloff,
            float3(rig.torch_specular_color) * torch_falloff, normal, tint, to_eye
        );
    FragmentOutput output;
    output.color = float4(color, 1.0f);
    return output;
}
