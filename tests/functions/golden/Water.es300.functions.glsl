// Water: functions, by Burnish.
// Waves over a plane that lies flat in the world.

/// Deep water carries long waves faster.
float water_phase(vec2 w_heading, float w_length, vec2 p, float t) {
    float number = 6.2831855 / w_length;
    return number * dot(w_heading, p) - sqrt(9.81 * number) * t;
}

/// How far a wave moves the point that rests at `p`.
vec3 water_moved(vec2 w_heading, float w_length, float w_height, float w_sharpness, vec2 p, float t) {
    float phase = water_phase(w_heading, w_length, p, t);
    return w_height * vec3(w_sharpness * cos(phase) * w_heading, sin(phase)).xzy;
}

/// The vector that the wave takes away from a normal that points up.
vec3 water_tilted(vec2 w_heading, float w_length, float w_height, float w_sharpness, vec2 p, float t) {
    float phase = water_phase(w_heading, w_length, p, t);
    return 6.2831855 / w_length * w_height * vec3(cos(phase) * w_heading, w_sharpness * sin(phase)).xzy;
}

vec3 water_position(vec3 vertex_position, mat4 object_to_world, float time) {
    vec4 rest_product = object_to_world * vec4(vertex_position, 1.0);
    const vec2 waves_heading[3] = vec2[3](vec2(1.0, 0.0), vec2(0.6, 0.8), vec2(-0.8, 0.6));
    const float waves_length[3] = float[3](1.6, 0.9, 0.5);
    const float waves_height[3] = float[3](0.06, 0.03, 0.015);
    const float waves_sharpness[3] = float[3](0.7, 0.6, 0.5);
    vec2 rest = rest_product.xz;
    vec3 shift = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return rest_product.xyz + shift;
}

vec3 water_normal(vec3 normal_2) {
    return normal_2 * inversesqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
}

vec2 water_rest(vec3 inherited_position) {
    return inherited_position.xz;
}

vec3 water_shift(vec3 inherited_position, float time) {
    const vec2 waves_heading[3] = vec2[3](vec2(1.0, 0.0), vec2(0.6, 0.8), vec2(-0.8, 0.6));
    const float waves_length[3] = float[3](1.6, 0.9, 0.5);
    const float waves_height[3] = float[3](0.06, 0.03, 0.015);
    const float waves_sharpness[3] = float[3](0.7, 0.6, 0.5);
    vec3 shift = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return shift;
}

vec3 water_tilt(vec3 inherited_position, float time) {
    const vec2 waves_heading[3] = vec2[3](vec2(1.0, 0.0), vec2(0.6, 0.8), vec2(-0.8, 0.6));
    const float waves_length[3] = float[3](1.6, 0.9, 0.5);
    const float waves_height[3] = float[3](0.06, 0.03, 0.015);
    const float waves_sharpness[3] = float[3](0.7, 0.6, 0.5);
    vec3 tilt = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return tilt;
}

/// eye: Where the viewer stands
float water_glancing(vec3 position, vec3 normal_2, vec3 eye) {
    // Zero stays zero.
    vec3 normal = normal_2 * inversesqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
    vec3 to_eye = normalize(eye - position);
    return 1.0 - clamp(dot(normal, to_eye), 0.0, 1.0);
}

vec3 water_inherited_position(vec3 vertex_position, mat4 object_to_world) {
    return (object_to_world * vec4(vertex_position, 1.0)).xyz;
}

vec3 water_normal_2(vec3 vertex_position, mat4 object_to_world, float time) {
    const vec2 waves_heading[3] = vec2[3](vec2(1.0, 0.0), vec2(0.6, 0.8), vec2(-0.8, 0.6));
    const float waves_length[3] = float[3](1.6, 0.9, 0.5);
    const float waves_height[3] = float[3](0.06, 0.03, 0.015);
    const float waves_sharpness[3] = float[3](0.7, 0.6, 0.5);
    vec2 rest = (object_to_world * vec4(vertex_position, 1.0)).xz;
    vec3 tilt = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return vec3(0.0, 1.0, 0.0) - tilt;
}
