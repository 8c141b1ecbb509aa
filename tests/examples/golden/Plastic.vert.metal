// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.

struct View {
    float4x4 view_projection;  /// World to clip space
    alignas(16) packed_float3 eye;  /// Where the viewer stands
};

struct Draw {
    float4x4 object_to_world;
};

struct DrawDerived {
    float3x4 normal_matrix;
};

struct VertexInput {
    float3 vertex_position [[attribute(0)]];
    float3 vertex_normal [[attribute(1)]];
    float2 vertex_uv [[attribute(2)]];
};

struct VertexOutput {
    float3 position [[user(location0)]];
    float3 normal [[user(location1)]];
    float2 uv [[user(location2)]];
    float4 clip_position [[position]];
};

vertex VertexOutput vs_main(
    VertexInput input [[stage_in]], constant View& view [[buffer(1)]], constant Draw& draw [[buffer(8)]],
    constant DrawDerived& draw_derived [[buffer(9)]]
) {
    const float3 position = (draw.object_to_world * float4(input.vertex_position, 1.0f)).xyz;
    VertexOutput output;
    output.position = position;
    output.normal = (draw_derived.normal_matrix * input.vertex_normal).xyz;
    output.uv = input.vertex_uv;
    output.clip_position = view.view_projection * float4(position, 1.0f);
    return output;
}
