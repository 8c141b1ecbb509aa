// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Plastic: vertex and fragment shaders, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct Lamp {
    alignas(16) packed_float3 place;
    float pad_0;
    alignas(16) packed_float3 diffuse;
    float pad_1;
};

struct View {
    float4x4 world_to_clip;
    alignas(16) packed_float3 eye;  /// Where the camera stands, in world space
};

struct Rig {
    alignas(16) packed_float3 sun_direction;
    int lamps_count;
    array<Lamp, 8> lamps;
};

struct DerivedFromRig {
    float sun_cos_outer;  /// cos(outer)
};

struct Material {
    alignas(16) packed_float3 base;  /// Base colour
    float power;  /// Specular exponent
};

struct Draw {
    float4x4 object_to_world;
};

struct VertexInput {
    float3 position [[attribute(0)]];
    float3 normal [[attribute(1)]];
    float2 uv [[attribute(2)]];
};

struct VertexOutput {
    float3 position [[user(location0)]];
    float4 normal [[user(location1)]];
    float2 uv [[user(location2)]];
    float4 clip_position [[position]];
};

vertex VertexOutput vs_main(
    VertexInput input [[stage_in]], constant View& view [[buffer(1)]], constant Draw& draw [[buffer(8)]]
) {
    // In world space, homogeneous
    const float4 position = draw.object_to_world * float4(input.position, 1.0f);
    VertexOutput output;
    output.position = position.xyz;
    output.normal = float4((draw.object_to_world * float4(input.normal, 0.0f)).xyz, 0.5f);
    output.uv = input.uv;
    output.clip_position = view.world_to_clip * position;
    return output;
}

struct FragmentInput {
    float3 position [[user(location0)]];
    float4 normal [[user(location1)]];
    float2 uv [[user(location2)]];
};

struct FragmentOutput {
    float4 color [[color(0)]];  /// Linear colour
};

/// What one light contributes.
float3 shade(constant Material& material, float3 to_light, float3 normal, float3 to_eye, float3 tint) {
    const float n_dot_l = dot(normal, to_light);
    float highlight = 0.0f;
    if (n_dot_l > 0.0f) {
        const float3 mirrored = reflect(-to_light, normal);
        highlight = precise::pow(saturate(dot(mirrored, to_eye)), material.power);
    }
    return tint * saturate(n_dot_l) + float3(highlight);
}

fragment FragmentOutput fs_main(
    FragmentInput input [[stage_in]], constant View& view [[buffer(1)]], constant Rig& rig [[buffer(2)]],
    constant DerivedFromRig& derived_from_rig [[buffer(7)]], constant Material& material [[buffer(3)]],
    texture2d<float> albedo [[texture(0)]], sampler albedo_sampler [[sampler(0)]]
) {
    const float3 normal = normalize(input.normal.xyz);
    const float3 to_eye = normalize(float3(view.eye) - input.position);
    // Base colour times the map
    const float3 tint = float3(material.base) * albedo.sample(albedo_sampler, input.uv).xyz;
    float3 from_lamps = float3(0.0f);
    for (int i = 0; i < min(rig.lamps_count, 8); i++) {
        const float3 to_light = normalize(float3(rig.lamps[i].place) - input.position);
        from_lamps += shade(material, to_light, normal, to_eye, tint) * float3(rig.lamps[i].diffuse);
    }
    const float3 color = (
        tint * 0.1f + shade(material, -float3(rig.sun_direction), normal, to_eye, tint) + from_lamps
    ) * derived_from_rig.sun_cos_outer;
    FragmentOutput output;
    output.color = float4(color, 1.0f);
    return output;
}
