// Scanned: compute shader, by Burnish.
// What groups of forty numbers come to, and what is before each of these.

struct Draw {
    numbers_count: i32,  /// The number of elements of `numbers`
}

@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(2) var<storage, read> numbers: array<f32>;
@group(3) @binding(3) var<storage, read_write> totals: array<vec2f>;
@group(3) @binding(4) var<storage, read_write> before: array<vec4f>;

struct ComputeInput {
    @builtin(global_invocation_id) index: vec3u,
}

var<workgroup> group_floats: array<f32, 40>;
var<workgroup> group_vec3s: array<vec3f, 40>;

/// The values of all invocations of a work group, joined.
fn group_sum(value: f32, place: u32, present: u32) -> f32 {
    group_floats[place] = value;
    workgroupBarrier();
    for (var reach: u32 = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = group_floats[place] + group_floats[place + reach];
        }
        workgroupBarrier();
    }
    let joined = group_floats[0];
    workgroupBarrier();
    return joined;
}

/// The values of all invocations of a work group, joined.
fn group_max(value: f32, place: u32, present: u32) -> f32 {
    group_floats[place] = value;
    workgroupBarrier();
    for (var reach: u32 = 32u; reach > 0u; reach /= 2u) {
        if (place < reach && place + reach < present) {
            group_floats[place] = max(group_floats[place], group_floats[place + reach]);
        }
        workgroupBarrier();
    }
    let joined = group_floats[0];
    workgroupBarrier();
    return joined;
}

/// The values of the invocations before this one, joined.
fn group_exclusive_sum(value: vec3f, place: u32) -> vec3f {
    var joined: vec3f = value;
    for (var reach: u32 = 1u; reach < 40u; reach *= 2u) {
        group_vec3s[place] = joined;
        workgroupBarrier();
        if (place >= reach) {
            joined = group_vec3s[place - reach] + joined;
        }
        workgroupBarrier();
    }
    group_vec3s[place] = joined;
    workgroupBarrier();
    joined = vec3f(0.0);
    if (place > 0u) {
        joined = group_vec3s[place - 1u];
    }
    workgroupBarrier();
    return joined;
}

@compute @workgroup_size(40)
fn main(input: ComputeInput) {
    let count = draw.numbers_count;
    let global_index = input.index.x;
    let index = max(min(i32(global_index), count - 1), 0);
    let place = global_index % 40u;
    let present = min(u32(count) - (global_index - place), 40u);
    let total = group_sum(numbers[index], place, present);
    let totals_group_max = group_max(numbers[index], place, present);
    let before_group_exclusive_sum = group_exclusive_sum(vec3f(numbers[index], 1.0, 0.0), place);
    if (global_index < u32(count)) {
        before[index] = vec4f(
            select(vec3f(0.0), before_group_exclusive_sum / total, abs(total) >= 1.1754944e-38), 0.0
        );
        if (index % 40 == 0) {
            totals[index / 40] = vec2f(total, totals_group_max);
        }
    }
}
