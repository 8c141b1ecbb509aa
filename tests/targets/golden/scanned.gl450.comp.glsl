#version 450 core
// Scanned: compute shader, by Burnish.
// What groups of forty numbers come to, and what is before each of these.

layout(std140, binding = 8) uniform Draw {
    int numbers_count;  /// The number of elements of `numbers`
};

layout(std430, binding = 0) readonly buffer NumbersBuffer {
    float numbers[];
};

layout(std430, binding = 1) writeonly buffer TotalsBuffer {
    vec2 totals[];
};

layout(std430, binding = 2) writeonly buffer BeforeBuffer {
    vec4 before[];
};

shared float group_floats[40];
shared vec3 group_vec3s[40];

/// The values of all invocations of a work group, joined.
float group_sum(float value, uint place, uint present) {
    group_floats[place] = value;
    memoryBarrierShared(); barrier();
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = group_floats[place] + group_floats[place + reach];
        }
        memoryBarrierShared(); barrier();
    }
    float joined = group_floats[0];
    memoryBarrierShared(); barrier();
    return joined;
}

/// The values of all invocations of a work group, joined.
float group_max(float value, uint place, uint present) {
    group_floats[place] = value;
    memoryBarrierShared(); barrier();
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = max(group_floats[place], group_floats[place + reach]);
        }
        memoryBarrierShared(); barrier();
    }
    float joined = group_floats[0];
    memoryBarrierShared(); barrier();
    return joined;
}

/// The values of the invocations before this one, joined.
vec3 group_exclusive_sum(vec3 value, uint place) {
    vec3 joined = value;
    for (uint reach = 1u; reach < 40u; reach *= 2u) {
        group_vec3s[place] = joined;
        memoryBarrierShared(); barrier();
        if (place >= reach) {
            joined = group_vec3s[place - reach] + joined;
        }
        memoryBarrierShared(); barrier();
    }
    group_vec3s[place] = joined;
    memoryBarrierShared(); barrier();
    joined = vec3(0.0);
    if (place > 0u) {
        joined = group_vec3s[place - 1u];
    }
    memoryBarrierShared(); barrier();
    return joined;
}

layout(local_size_x = 40) in;

void main() {
    int count = numbers_count;
    uint global_index = gl_GlobalInvocationID.x;
    int index = max(min(int(global_index), count - 1), 0);
    uint place = global_index % 40u;
    uint present = min(uint(count) - (global_index - place), 40u);
    float total = group_sum(numbers[index], place, present);
    float totals_group_max = group_max(numbers[index], place, present);
    vec3 before_group_exclusive_sum = group_exclusive_sum(vec3(numbers[index], 1.0, 0.0), place);
    if (global_index < uint(count)) {
        before[index] = vec4(
            abs(total) >= 1.1754944e-38 ? before_group_exclusive_sum / total : vec3(0.0), 0.0
        );
        if (index % 40 == 0) {
            totals[index / 40] = vec2(total, totals_group_max);
        }
    }
}
