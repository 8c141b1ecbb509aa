#version 450
// Swarm: compute shader, by Burnish.

struct Particle {
    vec3 place;
    float pad_0;
    vec3 speed;
    float age;
};

layout(std140, set = 3, binding = 0) uniform Draw {
    float dt;  /// Seconds in a step
    float pull;  /// To the middle
    float reach;  /// How far particles push each other
    int before_count;  /// The number of elements of `before`
};

layout(std430, set = 3, binding = 2) readonly buffer BeforeBuffer {
    Particle before[];
};

layout(std430, set = 3, binding = 3) writeonly buffer AfterBuffer {
    Particle after[];
};

layout(std430, set = 3, binding = 4) writeonly buffer SpeedsBuffer {
    float speeds[];
};

layout(local_size_x = 64) in;

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= before_count) { return; }
    vec3 others = vec3(0.0);
    for (int i = 0; i < min(before_count, 64); i++) {
        vec3 others_difference = before[index].place - before[i].place;
        others += others_difference / max(dot(others_difference, others_difference), 0.0001)
            * clamp(1.0 - length(others_difference) / reach, 0.0, 1.0);
    }
    vec3 speed = 0.99 * before[index].speed + dt * (others - pull * before[index].place);
    after[index].place = before[index].place + dt * speed;
    after[index].speed = speed;
    after[index].age = before[index].age + dt;
    speeds[index] = length(speed);
}
