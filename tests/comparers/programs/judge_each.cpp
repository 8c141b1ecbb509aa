// Prints what the comparer in C++ says of each case of a list; `kit.py` tells the form.

#include "burnish_judge.hpp"

#include <iostream>
#include <sstream>

using namespace burnish_judge;

namespace {

/// The verdict, or the error.
template <class MakeBounds, class MakePicture>
std::string said(MakeBounds bounds, MakePicture picture, const std::string& encoding,
                 const std::string& lanes) {
  try {
    Picture drawn = picture();
    if (!lanes.empty()) drawn.lanes = std::stoul(lanes);
    return judge(bounds(), drawn, encoding == "srgb" ? Encoding::srgb : Encoding::linear).message();
  } catch (const JudgeError& error) {
    return std::string("error: ") + error.what();
  }
}

/// The bytes of a file; none if it cannot be read.
std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

int main(int, char** arguments) {
  std::ifstream list(arguments[1]);
  for (std::string line; std::getline(list, line);) {
    std::istringstream fields(line);
    std::array<std::string, 5> field;
    for (std::string& each : field) std::getline(fields, each, '\t');
    const auto& [folder, output, path, encoding, lanes] = field;
    const std::string lower = content(folder + "/" + output + ".lower.npy");
    const std::string upper = content(folder + "/" + output + ".upper.npy");
    const std::string undecided = content(folder + "/undecided.npy");
    const std::string drawn = content(path);
    const auto load = [&field] { return Bounds::load(field[0], field[1]); };
    const auto parse = [&] { return Bounds::parse(lower, upper, undecided); };
    const auto load_picture = [&field] { return Picture::load(field[2]); };
    const auto parse_picture = [&] { return Picture::parse(drawn); };
    std::cout << said(load, load_picture, encoding, lanes) << '\t'
              << said(parse, parse_picture, encoding, lanes) << '\n';
  }
}
