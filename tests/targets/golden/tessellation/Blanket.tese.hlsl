// Blanket: evaluation shader, by Burnish.
// A blanket that is finer where it is wider.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Material : register(b0, space2) {
    float detail;
    float bump;  /// How far the middles of the triangles rise.
};

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
};

cbuffer DrawDerived : register(b1, space3) {
    column_major float4x3 normal_matrix;
};

struct EvaluationInput {
    [[vk::location(0)]] float3 object_position : TEXCOORD0;
    [[vk::location(1)]] float3 object_normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv_2 : TEXCOORD2;
};

struct EvaluationOutput {
    [[vk::location(0)]] float2 uv : TEXCOORD0;
    float4 clip_position : SV_Position;
};

struct PatchInput {
    float edge_levels[4] : SV_TessFactor;
    float inner_levels[2] : SV_InsideTessFactor;
};

[domain("quad")]
EvaluationOutput main(
    PatchInput patch, OutputPatch<EvaluationInput, 4> input, float2 patch_coordinate : SV_DomainLocation
) {
    // Before `object_to_world`
    float3 object_position = lerp(
        lerp(input[0].object_position, input[1].object_position, patch_coordinate.x),
        lerp(input[3].object_position, input[2].object_position, patch_coordinate.x), patch_coordinate.y
    );
    float3 inherited_position = mul(object_to_world, float4(object_position, 1.0)).xyz;
    float3 object_normal = lerp(
        lerp(input[0].object_normal, input[1].object_normal, patch_coordinate.x),
        lerp(input[3].object_normal, input[2].object_normal, patch_coordinate.x), patch_coordinate.y
    );
    float3 normal_upright = mul(normal_matrix, object_normal).xyz;
    // Zero stays zero.
    float3 normal = normal_upright * rsqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
    float3 position = inherited_position + bump * patch_coordinate.x * (1.0 - patch_coordinate.x) * normal;
    EvaluationOutput output;
    output.uv = lerp(
        lerp(input[0].uv_2, input[1].uv_2, patch_coordinate.x),
        lerp(input[3].uv_2, input[2].uv_2, patch_coordinate.x), patch_coordinate.y
    );
    output.clip_position = mul(view_projection, float4(position, 1.0));
    return output;
}
