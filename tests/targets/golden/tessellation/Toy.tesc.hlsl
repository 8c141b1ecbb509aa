// Toy: control shader, by Burnish.

struct ControlInput {
    [[vk::location(1)]] float3 place : TEXCOORD1;
};

struct ControlOutput {
    [[vk::location(1)]] float3 place : TEXCOORD1;
};

struct PatchOutput {
    float edge_levels[3] : SV_TessFactor;
    float inner_levels[1] : SV_InsideTessFactor;
    [[vk::location(0)]] float edge_level_0 : TEXCOORD0;
};

PatchOutput levels_of_patch(InputPatch<ControlInput, 3> input) {
    float edge_level_0 = length(input[1].place - input[2].place);
    PatchOutput output;
    output.edge_level_0 = edge_level_0;
    output.edge_levels[0] = edge_level_0;
    output.edge_levels[1] = length(input[2].place - input[0].place);
    output.edge_levels[2] = length(input[0].place - input[1].place);
    output.inner_levels[0] = edge_level_0;
    return output;
}

[domain("tri")]
[partitioning("integer")]
[outputtopology("triangle_cw")]
[outputcontrolpoints(3)]
[patchconstantfunc("levels_of_patch")]
ControlOutput main(InputPatch<ControlInput, 3> input, uint point_index : SV_OutputControlPointID) {
    ControlOutput output;
    output.place = input[point_index].place;
    return output;
}
