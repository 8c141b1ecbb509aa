// Water: functions, by Burnish.
// Waves over a plane that lies flat in the world.

/// Deep water carries long waves faster.
float water_phase(float2 w_heading, float w_length, float2 p, float t) {
    const float number = 6.2831855f / w_length;
    return number * dot(w_heading, p) - precise::sqrt(9.81f * number) * t;
}

/// How far a wave moves the point that rests at `p`.
float3 water_moved(float2 w_heading, float w_length, float w_height, float w_sharpness, float2 p, float t) {
    const float phase = water_phase(w_heading, w_length, p, t);
    return w_height * float3(w_sharpness * precise::cos(phase) * w_heading, precise::sin(phase)).xzy;
}

/// The vector that the wave takes away from a normal that points up.
float3 water_tilted(float2 w_heading, float w_length, float w_height, float w_sharpness, float2 p, float t) {
    const float phase = water_phase(w_heading, w_length, p, t);
    return 6.2831855f / w_length * w_height
        * float3(precise::cos(phase) * w_heading, w_sharpness * precise::sin(phase)).xzy;
}

float3 water_position(float3 vertex_position, float4x4 object_to_world, float time) {
    const float4 rest_product = object_to_world * float4(vertex_position, 1.0f);
    const array<float2, 3> waves_heading = array<float2, 3>{
        float2(1.0f, 0.0f), float2(0.6f, 0.8f), float2(-0.8f, 0.6f)
    };
    const array<float, 3> waves_length = array<float, 3>{1.6f, 0.9f, 0.5f};
    const array<float, 3> waves_height = array<float, 3>{0.06f, 0.03f, 0.015f};
    const array<float, 3> waves_sharpness = array<float, 3>{0.7f, 0.6f, 0.5f};
    const float2 rest = rest_product.xz;
    float3 shift = float3(0.0f);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return rest_product.xyz + shift;
}

float3 water_normal(float3 normal_2) {
    return normal_2 * precise::rsqrt(max(dot(normal_2, normal_2), 1.1754944e-38f));
}

float2 water_rest(float3 inherited_position) {
    return inherited_position.xz;
}

float3 water_shift(float3 inherited_position, float time) {
    const array<float2, 3> waves_heading = array<float2, 3>{
        float2(1.0f, 0.0f), float2(0.6f, 0.8f), float2(-0.8f, 0.6f)
    };
    const array<float, 3> waves_length = array<float, 3>{1.6f, 0.9f, 0.5f};
    const array<float, 3> waves_height = array<float, 3>{0.06f, 0.03f, 0.015f};
    const array<float, 3> waves_sharpness = array<float, 3>{0.7f, 0.6f, 0.5f};
    float3 shift = float3(0.0f);
    for (int i = 0; i < 3; i++) {
        shift += water_moved(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], inherited_position.xz,
            time
        );
    }
    return shift;
}

float3 water_tilt(float3 inherited_position, float time) {
    const array<float2, 3> waves_heading = array<float2, 3>{
        float2(1.0f, 0.0f), float2(0.6f, 0.8f), float2(-0.8f, 0.6f)
    };
    const array<float, 3> waves_length = array<float, 3>{1.6f, 0.9f, 0.5f};
    const array<float, 3> waves_height = array<float, 3>{0.06f, 0.03f, 0.015f};
    const array<float, 3> waves_sharpness = array<float, 3>{0.7f, 0.6f, 0.5f};
    float3 tilt = float3(0.0f);
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
    const float3 normal = normal_2 * precise::rsqrt(max(dot(normal_2, normal_2), 1.1754944e-38f));
    const float3 to_eye = normalize(eye - position);
    return 1.0f - saturate(dot(normal, to_eye));
}

float3 water_inherited_position(float3 vertex_position, float4x4 object_to_world) {
    return (object_to_world * float4(vertex_position, 1.0f)).xyz;
}

float3 water_normal_2(float3 vertex_position, float4x4 object_to_world, float time) {
    const array<float2, 3> waves_heading = array<float2, 3>{
        float2(1.0f, 0.0f), float2(0.6f, 0.8f), float2(-0.8f, 0.6f)
    };
    const array<float, 3> waves_length = array<float, 3>{1.6f, 0.9f, 0.5f};
    const array<float, 3> waves_height = array<float, 3>{0.06f, 0.03f, 0.015f};
    const array<float, 3> waves_sharpness = array<float, 3>{0.7f, 0.6f, 0.5f};
    const float2 rest = (object_to_world * float4(vertex_position, 1.0f)).xz;
    float3 tilt = float3(0.0f);
    for (int i = 0; i < 3; i++) {
        tilt += water_tilted(
            waves_heading[i], waves_length[i], waves_height[i], waves_sharpness[i], rest, time
        );
    }
    return float3(0.0f, 1.0f, 0.0f) - tilt;
}
