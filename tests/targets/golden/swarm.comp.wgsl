// Swarm: compute shader, by Burnish.

struct Particle {
    place: vec3f,
    pad_0: f32,
    speed: vec3f,
    age: f32,
}

struct Draw {
    dt: f32,  /// Seconds in a step
    pull: f32,  /// To the middle
    reach: f32,  /// How far particles push each other
    before_count: i32,  /// The number of elements of `before`
}

@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(2) var<storage, read> before: array<Particle>;
@group(3) @binding(3) var<storage, read_write> after: array<Particle>;
@group(3) @binding(4) var<storage, read_write> speeds: array<f32>;

struct ComputeInput {
    @builtin(global_invocation_id) index: vec3u,
}

@compute @workgroup_size(64)
fn main(input: ComputeInput) {
    let index = i32(input.index.x);
    if (index >= draw.before_count) { return; }
    var others: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < min(draw.before_count, 64); i++) {
        let others_difference = before[index].place - before[i].place;
        others += others_difference / max(dot(others_difference, others_difference), 0.0001)
            * saturate(1.0 - length(others_difference) / draw.reach);
    }
    let speed = 0.99 * before[index].speed + draw.dt * (others - draw.pull * before[index].place);
    after[index].place = before[index].place + draw.dt * speed;
    after[index].speed = speed;
    after[index].age = before[index].age + draw.dt;
    speeds[index] = length(speed);
}
