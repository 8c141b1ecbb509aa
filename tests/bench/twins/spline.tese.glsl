#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};

layout(quads, equal_spacing, cw) in;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec2 uv[];

layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 uv_of_spline;

vec3 weights(float t) {
    float s = 1.0 - t;
    return 0.5 * vec3(s * s, 1.0 + 2.0 * s * t, t * t);
}

vec3 slopes(float t) {
    return vec3(t - 1.0, 1.0 - 2.0 * t, t);
}

vec3 joined(vec3 w, vec3 a, vec3 b, vec3 c) {
    return w.x * a + w.y * b + w.z * c;
}

void main() {
    vec3 weights_x = weights(gl_TessCoord.x);
    vec3 weights_y = weights(gl_TessCoord.y);
    vec3 slopes_x = slopes(gl_TessCoord.x);
    vec3 slopes_y = slopes(gl_TessCoord.y);
    vec3 rows[3];
    vec3 slopes_of_rows[3];
    for (int j = 0; j < 3; j++) {
        rows[j] = joined(weights_x, place[3 * j], place[3 * j + 1], place[3 * j + 2]);
        slopes_of_rows[j] = joined(slopes_x, place[3 * j], place[3 * j + 1], place[3 * j + 2]);
    }
    vec3 along_x = joined(weights_y, slopes_of_rows[0], slopes_of_rows[1], slopes_of_rows[2]);
    vec3 along_y = joined(slopes_y, rows[0], rows[1], rows[2]);

    normal = normalize(cross(along_x, along_y));
    uv_of_spline = mix(
        mix(uv[0], uv[1], gl_TessCoord.x), mix(uv[3], uv[4], gl_TessCoord.x), gl_TessCoord.y
    );
    gl_Position = view_projection * vec4(joined(weights_y, rows[0], rows[1], rows[2]), 1.0);
}
