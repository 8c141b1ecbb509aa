// Swarm: compute shader, by Burnish.

struct Particle {
    float3 place;
    float pad_0;
    float3 speed;
    float age;
};

cbuffer Draw : register(b0, space3) {
    float dt;  /// Seconds in a step
    float pull;  /// To the middle
    float reach;  /// How far particles push each other
    int before_count;  /// The number of elements of `before`
};

StructuredBuffer<Particle> before : register(t2, space3);
RWStructuredBuffer<Particle> after : register(u3, space3);
RWStructuredBuffer<float> speeds : register(u4, space3);

struct ComputeInput {
    uint index : SV_DispatchThreadID;
};

[numthreads(64, 1, 1)]
void main(ComputeInput input) {
    int index = int(input.index);
    if (index >= before_count) { return; }
    float3 others = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < min(before_count, 64); i++) {
        float3 others_difference = before[index].place - before[i].place;
        others += others_difference / max(dot(others_difference, others_difference), 0.0001)
            * saturate(1.0 - length(others_difference) / reach);
    }
    float3 speed = 0.99 * before[index].speed + dt * (others - pull * before[index].place);
    after[index].place = before[index].place + dt * speed;
    after[index].speed = speed;
    after[index].age = before[index].age + dt;
    speeds[index] = length(speed);
}
