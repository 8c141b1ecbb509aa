// Water: functions, by Burnish.
// Waves over a plane that lies flat in the world.

/// Deep water carries long waves faster.
fn water_phase(w_heading: vec2f, w_length: f32, p: vec2f, t: f32) -> f32 {
    let number = 6.2831855 / w_length;
    return number * dot(w_heading, p) - sqrt(9.81 * number) * t;
}

/// How far a wave moves the point that rests at `p`.
fn water_moved(w_heading: vec2f, w_length: f32, w_height: f32, w_sharpness: f32, p: vec2f, t: f32) -> vec3f {
    let phase = water_phase(w_heading, w_length, p, t);
    return w_height * vec3f(w_sharpness * cos(phase) * w_heading, sin(phase)).xzy;
}

/// The vector that the wave takes away from a normal that points up.
fn water_tilted(w_heading: vec2f, w_length: f32, w_height: f32, w_sharpness: f32, p: vec2f, t: f32) -> vec3f {
    let phase = water_phase(w_heading, w_length, p, t);
    return 6.2831855 / w_length * w_height * vec3f(cos(phase) * w_heading, w_sharpness * sin(phase)).xzy;
}

fn water_position(vertex_position: vec3f, object_to_world: mat4x4f, time: f32) -> vec3f {
    let rest_product = object_to_world * vec4f(vertex_position, 1.0);
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    let rest = rest_product.xz;
    var shift: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return rest_product.xyz + shift;
}

fn water_normal(normal_2: vec3f) -> vec3f {
    return normal_2 * inverseSqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
}

fn water_rest(inherited_position: vec3f) -> vec2f {
    return inherited_position.xz;
}

fn water_shift(inherited_position: vec3f, time: f32) -> vec3f {
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    var shift: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return shift;
}

fn water_tilt(inherited_position: vec3f, time: f32) -> vec3f {
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    var tilt: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return tilt;
}

/// eye: Where the viewer stands
fn water_glancing(position: vec3f, normal_2: vec3f, eye: vec3f) -> f32 {
    // Zero stays zero.
    let normal = normal_2 * inverseSqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
    let to_eye = normalize(eye - position);
    return 1.0 - saturate(dot(normal, to_eye));
}

fn water_inherited_position(vertex_position: vec3f, object_to_world: mat4x4f) -> vec3f {
    return (object_to_world * vec4f(vertex_position, 1.0)).xyz;
}

fn water_normal_2(vertex_position: vec3f, object_to_world: mat4x4f, time: f32) -> vec3f {
    const waves_heading: array<vec2f, 3> = array<vec2f, 3>(
        vec2f(1.0, 0.0), vec2f(0.6, 0.8), vec2f(-0.8, 0.6)
    );
    const waves_length: array<f32, 3> = array<f32, 3>(1.6, 0.9, 0.5);
    const waves_height: array<f32, 3> = array<f32, 3>(0.06, 0.03, 0.015);
    const waves_sharpness: array<f32, 3> = array<f32, 3>(0.7, 0.6, 0.5);
    let rest = (object_to_world * vec4f(vertex_position, 1.0)).xz;
    var tilt: vec3f = vec3f(0.0);
    for (var i: i32 = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return vec3f(0.0, 1.0, 0.0) - tilt;
}
