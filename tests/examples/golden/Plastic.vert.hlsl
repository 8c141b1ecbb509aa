// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.

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
    [[vk::location(2)]] float2 vertex_uv : VERTEX_UV;
};

struct VertexOutput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
    float4 clip_position : SV_Position;
};

VertexOutput main(VertexInput input) {
    float3 position = mul(object_to_world, float4(input.vertex_position, 1.0)).xyz;
    VertexOutput output;
    output.position = position;
    output.normal = mul(normal_matrix, input.vertex_normal).xyz;
    output.uv = input.vertex_uv;
    output.clip_position = mul(view_projection, float4(position, 1.0));
    return output;
}
