// Blanket: control shader, by Burnish.
// A blanket that is finer where it is wider.

cbuffer Material : register(b0, space2) {
    float detail;
    float bump;  /// How far the middles of the triangles rise.
};

struct ControlInput {
    [[vk::location(0)]] float3 object_position : TEXCOORD0;
    [[vk::location(1)]] float3 object_normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv_2 : TEXCOORD2;
};

struct ControlOutput {
    [[vk::location(0)]] float3 object_position : TEXCOORD0;
    [[vk::location(1)]] float3 object_normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv_2 : TEXCOORD2;
};

struct PatchOutput {
    float edge_levels[4] : SV_TessFactor;
    float inner_levels[2] : SV_InsideTessFactor;
};

PatchOutput levels_of_patch(InputPatch<ControlInput, 4> input) {
    float edge_level_0 = max(
        1.0 + detail * abs(input[0].uv_2.x - input[3].uv_2.x),
        1.0 + detail * abs(input[3].uv_2.x - input[0].uv_2.x)
    );
    float edge_level_1 = max(
        1.0 + detail * abs(input[0].uv_2.x - input[1].uv_2.x),
        1.0 + detail * abs(input[1].uv_2.x - input[0].uv_2.x)
    );
    float edge_level_2 = max(
        1.0 + detail * abs(input[1].uv_2.x - input[2].uv_2.x),
        1.0 + detail * abs(input[2].uv_2.x - input[1].uv_2.x)
    );
    float edge_level_3 = max(
        1.0 + detail * abs(input[3].uv_2.x - input[2].uv_2.x),
        1.0 + detail * abs(input[2].uv_2.x - input[3].uv_2.x)
    );
    PatchOutput output;
    output.edge_levels[0] = edge_level_0;
    output.edge_levels[1] = edge_level_1;
    output.edge_levels[2] = edge_level_2;
    output.edge_levels[3] = edge_level_3;
    output.inner_levels[0] = max(edge_level_1, edge_level_3);
    output.inner_levels[1] = max(edge_level_0, edge_level_2);
    return output;
}

[domain("quad")]
[partitioning("fractional_odd")]
[outputtopology("triangle_cw")]
[outputcontrolpoints(4)]
[patchconstantfunc("levels_of_patch")]
ControlOutput main(InputPatch<ControlInput, 4> input, uint point_index : SV_OutputControlPointID) {
    ControlOutput output;
    output.object_position = input[point_index].object_position;
    output.object_normal = input[point_index].object_normal;
    output.uv_2 = input[point_index].uv_2;
    return output;
}
