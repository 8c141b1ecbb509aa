// Toy: vertex shader, by Burnish.

struct VertexInput {
    [[vk::location(0)]] float3 place : PLACE;
};

struct VertexOutput {
    [[vk::location(1)]] float3 place : TEXCOORD1;
};

VertexOutput main(VertexInput input) {
    VertexOutput output;
    output.place = input.place;
    return output;
}
