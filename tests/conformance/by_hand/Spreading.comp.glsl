#version 450

layout(std140, set = 3, binding = 0) uniform Values {
    float rate;
    float limit;
    int cells;
};
layout(std430, set = 3, binding = 2) readonly buffer Before {
    float before[];
};
layout(std430, set = 3, binding = 3) writeonly buffer After {
    float after[];
};
layout(std430, set = 3, binding = 4) buffer Crossed {
    int crossed[4];
};

layout(local_size_x = 64) in;

void main() {
    int cell = int(gl_GlobalInvocationID.x);
    if (cell >= cells) return;
    float left = before[cell == 0 ? 0 : cell - 1];
    float right = before[cell == cells - 1 ? cell : cell + 1];
    float now = (1.0 - 2.0 * rate) * before[cell] + rate * (left + right);
    after[cell] = now;
    if (now > limit) atomicAdd(crossed[cell & 3], 1);
}
