// Stage: vertex shader, by Burnish.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
};

cbuffer DrawDerived : register(b1, space3) {
    column_major float4x3 normal_matrix;
};

struct VertexInput {
    [[vk::location(0)]] float3 vertex_position : VERTEX_POSITION;
    [[vk::location(1)]] float3 vertex_normal : VERTEX_NORMAL;
};

struct VertexOutput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
    float4 clip_position : SV_Position;
};

VertexOutput main(VertexInput input) {
    float3 position = mul(object_to_world, float4(input.vertex_position, 1.0)).xyz;
    VertexOutput output;
    output.position = position;
    output.normal = mul(normal_matrix, input.vertex_normal).xyz;
    output.clip_position = mul(view_projection, float4(position, 1.0));
    return output;
}
