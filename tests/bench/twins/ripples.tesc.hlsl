struct ControlPoint {
    [[vk::location(0)]] float3 place : TEXCOORD0;
    [[vk::location(1)]] float3 normal : TEXCOORD1;
    [[vk::location(2)]] float2 uv : TEXCOORD2;
};
struct Levels {
    float edges[3] : SV_TessFactor;
    float inside : SV_InsideTessFactor;
};

Levels levels_of(InputPatch<ControlPoint, 3> points) {
    Levels levels;
    levels.edges[0] = levels.edges[1] = levels.edges[2] = levels.inside = 2.0;
    return levels;
}

[domain("tri")]
[partitioning("integer")]
[outputtopology("triangle_cw")]
[outputcontrolpoints(3)]
[patchconstantfunc("levels_of")]
ControlPoint main(InputPatch<ControlPoint, 3> points, uint number : SV_OutputControlPointID) {
    return points[number];
}
