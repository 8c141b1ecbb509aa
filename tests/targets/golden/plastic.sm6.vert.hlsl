// Plastic: vertex shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

cbuffer View : register(b1, space0) {
    column_major float4x4 world_to_clip;
    float3 eye;  /// Where the camera stands, in world space
};

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
};

struct VertexInput {
    [[vk::location(0)]] float3 position : POSITION;
    [[vk::location(1)]] float3 normal : NORMAL;
    [[vk::location(2)]] float2 uv : UV;
};

struct VertexOutput {
    [[vk::location(0)]] float3 position : TEXCOORD0;
    [[vk::location(1)]] float4 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
    float4 clip_position : SV_Position;
};

VertexOutput main(VertexInput input) {
    // In world space, homogeneous
    float4 position = mul(object_to_world, float4(input.position, 1.0));
    VertexOutput output;
    output.position = position.xyz;
    output.normal = float4(mul(object_to_world, float4(input.normal, 0.0)).xyz, 0.5);
    output.uv = input.uv;
    output.clip_position = mul(world_to_clip, position);
    return output;
}
