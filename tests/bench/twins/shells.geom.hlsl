cbuffer View : register(b0, space0) {
    column_major float4x4 view_projection;
    float3 eye;
};
cbuffer Material : register(b0, space2) {
    float fur_length;
    int shells;
    float density;
};
cbuffer MaterialDerived : register(b1, space2) {
    float last_shell;
};

struct Vertex {
    [[vk::location(0)]] float3 place : TEXCOORD0;
    [[vk::location(1)]] float3 direction : TEXCOORD1;
    [[vk::location(2)]] float3 normal : TEXCOORD2;
    [[vk::location(3)]] float2 uv : TEXCOORD3;
};
struct VertexOfShell {
    [[vk::location(0)]] float4 normal_and_height : TEXCOORD0;
    [[vk::location(1)]] float2 uv : TEXCOORD1;
    float4 position : SV_Position;
};

[maxvertexcount(48)]
void main(triangle Vertex corners[3], inout TriangleStream<VertexOfShell> fur) {
    for (int shell = 0; shell < shells; shell++) {
        float height = float(shell) / last_shell;
        float away = fur_length * height;
        for (int i = 0; i < 3; i++) {
            float3 place = corners[i].place + away * corners[i].direction;
            VertexOfShell vertex;
            vertex.position = mul(view_projection, float4(place, 1.0));
            vertex.normal_and_height = float4(corners[i].normal, height);
            vertex.uv = corners[i].uv;
            fur.Append(vertex);
        }
        fur.RestartStrip();
    }
}
