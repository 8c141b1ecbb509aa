// Water: functions, by Burnish.
// Waves over a plane that lies flat in the world.

/// Deep water carries long waves faster.
float water_phase(float2 w_heading, float w_length, float2 p, float t) {
    float number = 6.2831855 / w_length;
    return number * dot(w_heading, p) - sqrt(9.81 * number) * t;
}

/// How far a wave moves the point that rests at `p`.
float3 water_moved(float2 w_heading, float w_length, float w_height, float w_sharpness, float2 p, float t) {
    float phase = water_phase(w_heading, w_length, p, t);
    return w_height * float3(w_sharpness * cos(phase) * w_heading, sin(phase)).xzy;
}

/// The vector that the wave takes away from a normal that points up.
float3 water_tilted(float2 w_heading, float w_length, float w_height, float w_sharpness, float2 p, float t) {
    float phase = water_phase(w_heading, w_length, p, t);
    return 6.2831855 / w_length * w_height * float3(cos(phase) * w_heading, w_sharpness * sin(phase)).xzy;
}

float3 water_position(float3 vertex_position, float4x4 object_to_world, float time) {
    float4 rest_product = mul(object_to_world, float4(vertex_position, 1.0));
    static const float2 waves_heading[3] = {float2(1.0, 0.0), float2(0.6, 0.8), float2(-0.8, 0.6)};
    static const float waves_length[3] = {1.6, 0.9, 0.5};
    static const float waves_height[3] = {0.06, 0.03, 0.015};
    static const float waves_sharpness[3] = {0.7, 0.6, 0.5};
    float2 rest = rest_product.xz;
    float3 shift = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return rest_product.xyz + shift;
}

float3 water_normal(float3 normal_2) {
    return normal_2 * rsqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
}

float2 water_rest(float3 inherited_position) {
    return inherited_position.xz;
}

float3 water_shift(float3 inherited_position, float time) {
    static const float2 waves_heading[3] = {float2(1.0, 0.0), float2(0.6, 0.8), float2(-0.8, 0.6)};
    static const float waves_length[3] = {1.6, 0.9, 0.5};
    static const float waves_height[3] = {0.06, 0.03, 0.015};
    static const float waves_sharpness[3] = {0.7, 0.6, 0.5};
    float3 shift = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return shift;
}

float3 water_tilt(float3 inherited_position, float time) {
    static const float2 waves_heading[3] = {float2(1.0, 0.0), float2(0.6, 0.8), float2(-0.8, 0.6)};
    static const float waves_length[3] = {1.6, 0.9, 0.5};
    static const float waves_height[3] = {0.06, 0.03, 0.015};
    static const float waves_sharpness[3] = {0.7, 0.6, 0.5};
    float3 tilt = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return tilt;
}

/// eye: Where the viewer stands
float water_glancing(float3 position, float3 normal_2, float3 eye) {
    // Zero stays zero.
    float3 normal = normal_2 * rsqrt(max(dot(normal_2, normal_2), 1.1754944e-38));
    float3 to_eye = normalize(eye - position);
    return 1.0 - saturate(dot(normal, to_eye));
}

float3 water_inherited_position(float3 vertex_position, float4x4 object_to_world) {
    return mul(object_to_world, float4(vertex_position, 1.0)).xyz;
}

float3 water_normal_2(float3 vertex_position, float4x4 object_to_world, float time) {
    static const float2 waves_heading[3] = {float2(1.0, 0.0), float2(0.6, 0.8), float2(-0.8, 0.6)};
    static const float waves_length[3] = {1.6, 0.9, 0.5};
    static const float waves_height[3] = {0.06, 0.03, 0.015};
    static const float waves_sharpness[3] = {0.7, 0.6, 0.5};
    float2 rest = mul(object_to_world, float4(vertex_position, 1.0)).xz;
    float3 tilt = float3(0.0, 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return float3(0.0, 1.0, 0.0) - tilt;
}
