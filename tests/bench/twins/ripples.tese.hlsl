cbuffer View : register(b0, space0) {
    column_major float4x4 view_projection;
    float3 eye;
};
cbuffer Material : register(b0, space2) {
    float detail;
    float ripples;
    float height;
};
cbuffer MaterialDerived : register(b1, space2) {
    float slope_of_ripples;
    float ripples_in_radians;
};
cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
};
cbuffer DrawDerived : register(b1, space3) {
    column_major float4x3 normal_matrix;
};

struct ControlPoint {
    [[vk::location(0)]] float3 place : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
};
struct Vertex {
    [[vk::location(0)]] float4 normal_and_phase : TEXCOORD0;
    float4 position : SV_Position;
};
struct Levels {
    float edges[3] : SV_TessFactor;
    float inside : SV_InsideTessFactor;
};

float3 mixed(float3 w, float3 a, float3 b, float3 c) {
    return w.x * a + w.y * b + w.z * c;
}

[domain("tri")]
Vertex main(Levels levels, OutputPatch<ControlPoint, 3> points, float3 at : SV_DomainLocation) {
    float3 place = mixed(at, points[0].place, points[1].place, points[2].place);
    float3 world = mul(object_to_world, float4(place, 1.0)).xyz;
    float v = dot(at, float3(points[0].uv.y, points[1].uv.y, points[2].uv.y));
    float phase = ripples_in_radians * v;

    float3 normal = mixed(at, points[0].normal, points[1].normal, points[2].normal);
    float3 upright = mul(normal_matrix, normal).xyz;
    float3 n = upright * rsqrt(max(dot(upright, upright), 1.1754944e-38));
    float3 south = n * n.y - float3(0.0, 1.0, 0.0);
    float3 rippled = normalize(n - slope_of_ripples * cos(phase) * south);

    Vertex vertex;
    vertex.normal_and_phase = float4(upright, phase);
    vertex.position = mul(view_projection, float4(world + height * sin(phase) * rippled, 1.0));
    return vertex;
}
