// Prints a shader, as a program would load it.
#include <fstream>
#include <iostream>

int main() {
    std::cout << std::ifstream(SHADERS "/Plastic.gl330.frag.glsl").rdbuf();
}
