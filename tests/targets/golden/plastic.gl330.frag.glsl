#version 330 core
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct Lamp {
    vec3 place;
    float pad_0;
    vec3 diffuse;
    float pad_1;
};

layout(std140) uniform View {
    mat4 world_to_clip;
    vec3 eye;  /// Where the camera stands, in world space
};

layout(std140) uniform Rig {
    vec3 sun_direction;
    int lamps_count;
    Lamp lamps[8];
};

layout(std140) uniform DerivedFromRig {
    float sun_cos_outer;  /// cos(outer)
};

layout(std140) uniform Material {
    vec3 base;  /// Base colour
    float power;  /// Specular exponent
};

uniform sampler2D albedo;

in vec3 v_position;
in vec4 v_normal;
in vec2 v_uv;

layout(location = 0) out vec4 out_color;  /// Linear colour

/// What one light contributes.
vec3 shade(vec3 to_light, vec3 normal, vec3 to_eye, vec3 tint) {
    float n_dot_l = dot(normal, to_light);
    float highlight = 0.0;
    if (n_dot_l > 0.0) {
        vec3 mirrored = reflect(-to_light, normal);
        highlight = pow(clamp(dot(mirrored, to_eye), 0.0, 1.0), power);
    }
    return tint * clamp(n_dot_l, 0.0, 1.0) + vec3(highlight);
}

void main() {
    vec3 normal = normalize(v_normal.xyz);
    vec3 to_eye = normalize(eye - v_position);
    // Base colour times the map
    vec3 tint = base * texture(albedo, v_uv).xyz;
    vec3 from_lamps = vec3(0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        vec3 to_light = normalize(lamps[i].place - v_position);
        from_lamps += shade(to_light, normal, to_eye, tint) * lamps[i].diffuse;
    }
    vec3 color = (tint * 0.1 + shade(-sun_direction, normal, to_eye, tint) + from_lamps) * sun_cos_outer;
    out_color = vec4(color, 1.0);
}
