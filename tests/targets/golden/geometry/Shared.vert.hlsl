// Shared: vertex shader, by Burnish.
// Fins on some triangles, and some more on all.

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
    [[vk::location(0)]] float3 normal : TEXCOORD0;
    [[vk::location(1)]] float3 position : TEXCOORD1;
};

VertexOutput main(VertexInput input) {
    float3 normal_upright = mul(normal_matrix, input.vertex_normal).xyz;
    VertexOutput output;
    output.normal = normal_upright * rsqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    output.position = mul(object_to_world, float4(input.vertex_position, 1.0)).xyz;
    return output;
}
