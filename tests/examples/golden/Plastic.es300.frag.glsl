#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    vec3 diffuse_color;
    float pad_0;
    vec3 specular_color;
    float pad_1;
    vec3 place;
    float pad_2;
};

layout(std140) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140) uniform Rig {
    vec3 ambient_light;  /// Light from everywhere
    float rig_pad_0;
    vec3 sun_diffuse_color;
    float rig_pad_1;
    vec3 sun_specular_color;
    float rig_pad_2;
    vec3 sun_direction;  /// Where the light travels
    float rig_pad_3;
    Point lamps[8];
    int lamps_count;  /// How many of `lamps` shine
    float rig_pad_4;
    float rig_pad_5;
    float rig_pad_6;
    vec3 torch_diffuse_color;
    float rig_pad_7;
    vec3 torch_specular_color;
    float rig_pad_8;
    vec3 torch_place;
    float rig_pad_9;
    vec3 torch_axis;  /// Where the light travels
    float torch_inner;
    float torch_outer;
};

layout(std140) uniform RigDerived {
    float torch_falloff_cos;
    uint torch_falloff_edges_meet;
    float torch_falloff_inverse_width;
};

layout(std140) uniform Material {
    vec3 base;  /// Base colour
    float material_pad_0;
    vec3 shine;  /// Highlight colour
    float power;  /// Specular exponent
};

uniform sampler2D albedo;

in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;

layout(location = 0) out vec4 out_color;

vec3 lambert_phong(vec3 diffuse, vec3 to_light, vec3 specular, vec3 tint, vec3 normal, vec3 to_eye) {
    float normal_dot_to_light = dot(normal, to_light);
    vec3 phong = vec3(0.0);
    if (normal_dot_to_light > 0.0) {
        phong = shine * specular * pow(clamp(dot(reflect(-to_light, normal), to_eye), 0.0, 1.0), power);
    }
    return tint * diffuse * clamp(normal_dot_to_light, 0.0, 1.0) + phong;
}

void main() {
    vec3 tint = base * texture(albedo, v_uv).xyz;
    vec3 normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    vec3 to_eye_difference = eye - v_position;
    vec3 to_eye = to_eye_difference * inversesqrt(max(dot(to_eye_difference, to_eye_difference), 1.1754944e-38));
    vec3 color_total = vec3(0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        vec3 lamps_to_light_difference = lamps[i].place - v_position;
        vec3 lamps_to_light = lamps_to_light_difference * inversesqrt(max(dot(lamps_to_light_difference, lamps_to_light_difference), 1.1754944e-38));
        color_total += lambert_phong(lamps[i].diffuse_color, lamps_to_light, lamps[i].specular_color, tint, normal, to_eye);
    }
    vec3 torch_to_light_difference = torch_place - v_position;
    vec3 torch_to_light = torch_to_light_difference * inversesqrt(max(dot(torch_to_light_difference, torch_to_light_difference), 1.1754944e-38));
    float torch_falloff_cosine = dot(torch_axis, -torch_to_light);
    float torch_falloff_along = clamp((torch_falloff_cosine - torch_falloff_cos) * torch_falloff_inverse_width, 0.0, 1.0);
    float torch_falloff = torch_falloff_edges_meet != 0u ? step(torch_falloff_cos, torch_falloff_cosine) : torch_falloff_along * torch_falloff_along * (3.0 - 2.0 * torch_falloff_along);
    vec3 color = tint * ambient_light + lambert_phong(sun_diffuse_color, -sun_direction, sun_specular_color, tint, normal, to_eye) + color_total + lambert_phong(torch_diffuse_color * torch_falloff, torch_to_light, torch_specular_color * torch_falloff, tint, normal, to_eye);
    out_color = vec4(color, 1.0);
}
