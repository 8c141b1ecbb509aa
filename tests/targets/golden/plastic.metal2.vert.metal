// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct View {
    float4x4 world_to_clip;
    alignas(16) packed_float3 eye;  /// Where the camera stands, in world space
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
