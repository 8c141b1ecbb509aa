// Confetti: vertex shader, by Burnish.
// Paper that somebody has strewn with squares.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Material : register(b0, space2) {
    float3 paper;
    int cells;  /// Squares across
    uint seed;
};

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
};

struct VertexInput {
    [[vk::location(0)]] float3 vertex_position : VERTEX_POSITION;
    [[vk::location(2)]] float2 vertex_uv : VERTEX_UV;
};

struct VertexOutput {
    [[vk::location(0)]] float2 place : TEXCOORD0;
    float4 clip_position : SV_Position;
};

VertexOutput main(VertexInput input) {
    float3 position = mul(object_to_world, float4(input.vertex_position, 1.0)).xyz;
    VertexOutput output;
    output.place = input.vertex_uv * float(cells);
    output.clip_position = mul(view_projection, float4(position, 1.0));
    return output;
}
