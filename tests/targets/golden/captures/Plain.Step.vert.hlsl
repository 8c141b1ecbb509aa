// Plain: vertex shader, by Burnish.

struct VertexInput {
    [[vk::location(2)]] float2 vertex_uv : VERTEX_UV;
    uint vertex_index : SV_VertexID;
};

struct VertexOutput {
    [[vk::location(0)]] nointerpolation int number : TEXCOORD0;
    [[vk::location(1)]] float2 place : TEXCOORD1;
};

VertexOutput main(VertexInput input) {
    VertexOutput output;
    output.number = asint(input.vertex_index);
    output.place = input.vertex_uv;
    return output;
}
