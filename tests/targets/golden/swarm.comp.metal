// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Swarm: compute shader, by Burnish.

struct Particle {
    alignas(16) packed_float3 place;
    float pad_0;
    alignas(16) packed_float3 speed;
    float age;
};

struct Draw {
    float dt;  /// Seconds in a step
    float pull;  /// To the middle
    float reach;  /// How far particles push each other
    int before_count;  /// The number of elements of `before`
};

kernel void cs_main(
    uint index [[thread_position_in_grid]], constant Draw& draw [[buffer(8)]],
    device const Particle* before [[buffer(10)]], device Particle* after [[buffer(11)]],
    device float* speeds [[buffer(12)]]
) {
    const int index_2 = int(index);
    if (index_2 >= draw.before_count) { return; }
    float3 others = float3(0.0f);
    for (int i = 0; i < min(draw.before_count, 64); i++) {
        const float3 others_difference = float3(before[index_2].place) - float3(before[i].place);
        others += others_difference / max(dot(others_difference, others_difference), 0.0001f)
            * saturate(1.0f - length(others_difference) / draw.reach);
    }
    const float3 speed = 0.99f * float3(before[index_2].speed)
        + draw.dt * (others - draw.pull * float3(before[index_2].place));
    after[index_2].place = float3(before[index_2].place) + draw.dt * speed;
    after[index_2].speed = speed;
    after[index_2].age = before[index_2].age + draw.dt;
    speeds[index_2] = length(speed);
}
