#version 450
// Toy: vertex shader, by Burnish.

layout(location = 0) in vec3 place;

layout(location = 1) out vec3 v_place;

void main() {
    v_place = place;
}
