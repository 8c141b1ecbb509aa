#version 100
precision highp float;
precision highp int;
precision highp sampler2D;
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.
// Second line

struct Lamp {
    vec3 place;
    float pad_0;
    vec3 diffuse;
    float pad_1;
};

uniform mat4 world_to_clip;
uniform vec3 eye;  /// Where the camera stands, in world space

uniform vec3 sun_direction;
uniform int lamps_count;
uniform Lamp lamps[8];

uniform float sun_cos_outer;  /// cos(outer)

uniform vec3 base;  /// Base colour
uniform float power;  /// Specular exponent

uniform sampler2D albedo;

varying vec3 v_position;
varying vec4 v_normal;
varying vec2 v_uv;

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
    vec3 tint = base * texture2D(albedo, v_uv).xyz;
    vec3 from_lamps = vec3(0.0);
    for (int i = 0; i < 8; i++) {
        if (i >= lamps_count) { break; }
        vec3 to_light = normalize(lamps[i].place - v_position);
        from_lamps += shade(to_light, normal, to_eye, tint) * lamps[i].diffuse;
    }
    vec3 color = (tint * 0.1 + shade(-sun_direction, normal, to_eye, tint) + from_lamps) * sun_cos_outer;
    gl_FragColor = vec4(color, 1.0);
}
