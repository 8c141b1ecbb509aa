// Tent: vertex shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

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
    [[vk::location(3)]] float3 shift : SHIFT;
};

struct VertexOutput {
    [[vk::location(0)]] float3 shift : TEXCOORD0;
    [[vk::location(1)]] float3 position : TEXCOORD1;
    [[vk::location(2)]] float3 normal : TEXCOORD2;
    [[vk::location(3)]] float2 uv_2 : TEXCOORD3;
};

VertexOutput main(VertexInput input) {
    float3 normal_upright = mul(normal_matrix, input.vertex_normal).xyz;
    VertexOutput output;
    output.shift = input.shift;
    output.position = mul(object_to_world, float4(input.vertex_position, 1.0)).xyz;
    output.normal = normal_upright * rsqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    output.uv_2 = input.vertex_uv;
    return output;
}
