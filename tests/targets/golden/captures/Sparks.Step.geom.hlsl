// Sparks: geometry shader, by Burnish.
// Every spark that is young enough becomes two.

cbuffer Material : register(b0, space2) {
    float3 wind;
};

struct GeometryInput {
    [[vk::location(0)]] float4 position_older : TEXCOORD0;
};

struct GeometryOutput {
    [[vk::location(0)]] float3 position : TEXCOORD0;  /// In world space
    [[vk::location(1)]] float age : TEXCOORD1;
    [[vk::location(2)]] nointerpolation uint mark : TEXCOORD2;
};

[maxvertexcount(2)]
void main(
    point GeometryInput input[1], uint primitive_index : SV_PrimitiveID,
    inout PointStream<GeometryOutput> stream
) {
    GeometryOutput output;
    if (input[0].position_older.w < 1.0) {
        float older = 0.5 * input[0].position_older.w;
        for (int i = 0; i < 2; i++) {
            output.position = input[0].position_older.xyz + wind * float(i);
            output.age = older;
            output.mark = primitive_index;
            stream.Append(output);
        }
    }
}
