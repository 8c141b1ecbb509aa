// Prints a shader, as a program would load it, and the default of a parameter.
#include <fstream>
#include <iostream>
#include <string>

#include "materials.hpp"

int main() {
    namespace bound = burnish::materials;
    for (const auto& profile : bound::plastic.profiles)
        for (const auto& text : profile.texts)
            if (std::string(profile.name) == "glsl:gl330" && std::string(text.stage) == "fragment")
                std::cout << std::ifstream(std::string(SHADERS "/") + text.file).rdbuf();
    std::cout << "// " << bound::PlasticMaterial{}.base.x << "\n";
}
