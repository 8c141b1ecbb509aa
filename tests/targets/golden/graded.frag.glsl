#version 450
// Graded: fragment shader, by Burnish.
// Colours that an affine transform corrects, seen along a plane.

layout(std140, set = 3, binding = 0) uniform Draw {
    mat4 object_to_world;
    mat4 grade;
    mat2x4 tilt;
};

layout(location = 0) in vec3 v_normal;
layout(location = 1) in vec2 v_uv;

layout(location = 0) out vec4 out_color;

void main() {
    // Zero stays zero.
    vec3 normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    vec3 graded = (grade * vec4(normal, 1.0)).xyz;
    mat3x2 own = mat3x2(v_uv, v_uv.yx, vec2(1.0, v_uv.x));
    vec2 slope = transpose(mat2x3(tilt[0].xyz, tilt[1].xyz)) * graded
        + (own * mat4x3(grade[0].xyz, grade[1].xyz, grade[2].xyz, grade[3].xyz))[3];
    vec3 color = graded + (tilt * slope).xyz;
    out_color = vec4(color, 1.0);
}
