// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Scanned: compute shader, by Burnish.
// What groups of forty numbers come to, and what is before each of these.

struct Draw {
    int numbers_count;  /// The number of elements of `numbers`
};

/// The values of all invocations of a work group, joined.
float group_sum(threadgroup array<float, 40>& group_floats, float value, uint place, uint present) {
    group_floats[place] = value;
    threadgroup_barrier(mem_flags::mem_threadgroup);
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = group_floats[place] + group_floats[place + reach];
        }
        threadgroup_barrier(mem_flags::mem_threadgroup);
    }
    const float joined = group_floats[0];
    threadgroup_barrier(mem_flags::mem_threadgroup);
    return joined;
}

/// The values of all invocations of a work group, joined.
float group_max(threadgroup array<float, 40>& group_floats, float value, uint place, uint present) {
    group_floats[place] = value;
    threadgroup_barrier(mem_flags::mem_threadgroup);
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = max(group_floats[place], group_floats[place + reach]);
        }
        threadgroup_barrier(mem_flags::mem_threadgroup);
    }
    const float joined = group_floats[0];
    threadgroup_barrier(mem_flags::mem_threadgroup);
    return joined;
}

/// The values of the invocations before this one, joined.
float3 group_exclusive_sum(threadgroup array<float3, 40>& group_vec3s, float3 value, uint place) {
    float3 joined = value;
    for (uint reach = 1u; reach < 40u; reach *= 2u) {
        group_vec3s[place] = joined;
        threadgroup_barrier(mem_flags::mem_threadgroup);
        if (place >= reach) {
            joined = group_vec3s[place - reach] + joined;
        }
        threadgroup_barrier(mem_flags::mem_threadgroup);
    }
    group_vec3s[place] = joined;
    threadgroup_barrier(mem_flags::mem_threadgroup);
    joined = float3(0.0f);
    if (place > 0u) {
        joined = group_vec3s[place - 1u];
    }
    threadgroup_barrier(mem_flags::mem_threadgroup);
    return joined;
}

kernel void cs_main(
    uint index [[thread_position_in_grid]], constant Draw& draw [[buffer(8)]],
    device const float* numbers [[buffer(10)]], device float2* totals [[buffer(11)]],
    device float4* before [[buffer(12)]]
) {
    threadgroup array<float, 40> group_floats;
    threadgroup array<float3, 40> group_vec3s;
    const int count = draw.numbers_count;
    const uint global_index = index;
    const int index_2 = max(min(int(global_index), count - 1), 0);
    const uint place = global_index % 40u;
    const uint present = min(uint(count) - (global_index - place), 40u);
    const float total = group_sum(group_floats, numbers[index_2], place, present);
    const float totals_group_max = group_max(group_floats, numbers[index_2], place, present);
    const float3 before_group_exclusive_sum = group_exclusive_sum(
        group_vec3s, float3(numbers[index_2], 1.0f, 0.0f), place
    );
    if (global_index < uint(count)) {
        before[index_2] = float4(
            abs(total) >= 1.1754944e-38f ? before_group_exclusive_sum / total : float3(0.0f), 0.0f
        );
        if (index_2 % 40 == 0) {
            totals[index_2 / 40] = float2(total, totals_group_max);
        }
    }
}
