// Toy: evaluation shader, by Burnish.

struct EvaluationInput {
    [[vk::location(1)]] float3 place : TEXCOORD1;
};

struct EvaluationOutput {
    [[vk::location(0)]] float4 varying : TEXCOORD0;
    float4 clip_position : SV_Position;
};

struct PatchInput {
    float edge_levels[3] : SV_TessFactor;
    float inner_levels[1] : SV_InsideTessFactor;
    [[vk::location(0)]] float edge_level_0 : TEXCOORD0;
};

[domain("tri")]
EvaluationOutput main(
    PatchInput patch, OutputPatch<EvaluationInput, 3> input, float3 patch_weights : SV_DomainLocation
) {
    float4 joined = float4(
        input[0].place * patch_weights.x
            + input[1].place * patch_weights.y
            + input[2].place * patch_weights.z,
        patch.edge_level_0
    );
    EvaluationOutput output;
    output.varying = joined;
    output.clip_position = joined;
    return output;
}
