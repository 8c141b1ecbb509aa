// Scanned: compute shader, by Burnish.
// What groups of forty numbers come to, and what is before each of these.

cbuffer Draw : register(b0, space3) {
    int numbers_count;  /// The number of elements of `numbers`
};

StructuredBuffer<float> numbers : register(t2, space3);
RWStructuredBuffer<float2> totals : register(u3, space3);
RWStructuredBuffer<float4> before : register(u4, space3);

struct ComputeInput {
    uint index : SV_DispatchThreadID;
};

groupshared float group_floats[40];
groupshared float3 group_vec3s[40];

/// The values of all invocations of a work group, joined.
float group_sum(float value, uint place, uint present) {
    group_floats[place] = value;
    GroupMemoryBarrierWithGroupSync();
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = group_floats[place] + group_floats[place + reach];
        }
        GroupMemoryBarrierWithGroupSync();
    }
    float joined = group_floats[0];
    GroupMemoryBarrierWithGroupSync();
    return joined;
}

/// The values of all invocations of a work group, joined.
float group_max(float value, uint place, uint present) {
    group_floats[place] = value;
    GroupMemoryBarrierWithGroupSync();
    for (uint reach = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = max(group_floats[place], group_floats[place + reach]);
        }
        GroupMemoryBarrierWithGroupSync();
    }
    float joined = group_floats[0];
    GroupMemoryBarrierWithGroupSync();
    return joined;
}

/// The values of the invocations before this one, joined.
float3 group_exclusive_sum(float3 value, uint place) {
    float3 joined = value;
    for (uint reach = 1u; reach < 40u; reach *= 2u) {
        group_vec3s[place] = joined;
        GroupMemoryBarrierWithGroupSync();
        if (place >= reach) {
            joined = group_vec3s[place - reach] + joined;
        }
        GroupMemoryBarrierWithGroupSync();
    }
    group_vec3s[place] = joined;
    GroupMemoryBarrierWithGroupSync();
    joined = 0.0.xxx;
    if (place > 0u) {
        joined = group_vec3s[place - 1u];
    }
    GroupMemoryBarrierWithGroupSync();
    return joined;
}

[numthreads(40, 1, 1)]
void main(ComputeInput input) {
    int count = numbers_count;
    uint global_index = input.index;
    int index = max(min(int(global_index), count - 1), 0);
    uint place = global_index % 40u;
    uint present = min(uint(count) - (global_index - place), 40u);
    float total = group_sum(numbers[index], place, present);
    float totals_group_max = group_max(numbers[index], place, present);
    float3 before_group_exclusive_sum = group_exclusive_sum(float3(numbers[index], 1.0, 0.0), place);
    if (global_index < uint(count)) {
        before[index] = float4(
            abs(total) >= 1.1754944e-38 ? before_group_exclusive_sum / total : float3(0.0, 0.0, 0.0), 0.0
        );
        if (index % 40 == 0) {
            totals[index / 40] = float2(total, totals_group_max);
        }
    }
}
