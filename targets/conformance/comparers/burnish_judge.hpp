// SPDX-License-Identifier: Apache-2.0

/// Judges pictures by the bounds of a golden folder. Copy this file into your own test suite.
///
/// `burnish conform FILE --golden FOLDER` writes a golden folder: for each case, and each output of
/// it, the lowest and the highest value that a conforming device may draw at each pixel. This
/// header needs nothing but C++17, and comes in Python, Rust, TypeScript and C++, with the same
/// names and the same verdicts. A test loads the bounds, draws, and asks for the verdict:
///
///     using namespace burnish_judge;
///     const Bounds bounds = Bounds::load("golden/Plastic/defaults", "color");
///     const Picture picture{72, 56, 4, pixels};  // std::vector<std::uint8_t> pixels
///     const Verdict verdict = judge(bounds, picture, Encoding::srgb);
///     if (!verdict.is_good()) throw std::runtime_error(verdict.message());
///
/// On the command line: `c++ -std=c++17 -O2 -DBURNISH_JUDGE_MAIN -x c++ burnish_judge.hpp`, then
/// `./a.out FOLDER OUTPUT PICTURE.npy [linear|srgb]`

#ifndef BURNISH_JUDGE_HPP
#define BURNISH_JUDGE_HPP

#if defined(_M_FP_FAST) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "burnish_judge.hpp compares NaN and infinity: compile it without fast mathematics"
#endif

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "burnish_judge.hpp reads little-endian files on little-endian machines only"
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace burnish_judge {

/// Nothing can be judged: a damaged file, a picture of another size, or nothing to compare.
class JudgeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The way in which a picture of integers has values; pictures of floats have them as such.
enum class Encoding {
  /// A value is its code divided by the largest code.
  linear,
  /// The first three lanes have the transfer function of sRGB; the fourth, alpha, is linear.
  srgb,
};

/// The numbers of a picture.
using Samples = std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>,
                             std::vector<float>, std::vector<double>>;

/// A picture in memory: row by row from the top, with the lanes of each pixel side by side.
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t lanes = 0;
  Samples data;

  /// The picture in a `.npy` file: (height, width) or (height, width, lanes).
  static Picture load(const std::string& path);

  /// The picture in the bytes of a `.npy` file.
  static Picture parse(std::string_view content);
};

/// The values that a conforming device may draw, for one output of a case.
struct Bounds {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t lanes = 0;
  /// The lowest value of each lane of each pixel, in the order of `Picture::data`.
  std::vector<double> lower;
  /// The highest value, likewise.
  std::vector<double> upper;
  /// For each pixel, 1 if it is not compared, else 0.
  std::vector<std::uint8_t> undecided;

  /// The bounds in the folder of a case, `golden/Plastic/defaults`, for one output.
  static Bounds load(const std::string& folder, const std::string& output);

  /// The bounds in the bytes of the three files.
  static Bounds parse(std::string_view lower, std::string_view upper, std::string_view undecided);
};

/// A lane of a pixel that is outside of its bounds, counted from 0 at the left and the top.
struct Outlier {
  std::size_t x = 0;
  std::size_t y = 0;
  std::size_t lane = 0;
  /// The number as the picture has it: of a picture of integers, the code.
  double value = 0;
  /// The lowest number that it may be: of a picture of integers, a code.
  double lower = 0;
  /// The highest number, likewise.
  double upper = 0;
  /// The distance to the nearer end, for codes divided by the largest one. It is infinite for a
  /// NaN.
  double distance = 0;
};

/// The result of a comparison, in pixels.
struct Verdict {
  std::size_t compared = 0;
  std::size_t undecided = 0;
  std::size_t outside = 0;
  /// The lane that is farthest outside. Of equally far ones, it is the first in the rows.
  std::optional<Outlier> worst;

  /// True if no pixel is outside of its bounds.
  bool is_good() const { return outside == 0; }

  /// The verdict in one line.
  std::string message() const;
};

/// Compares a picture with the bounds. Throws `JudgeError` if that is not possible.
Verdict judge(const Bounds& bounds, const Picture& picture, Encoding encoding = Encoding::linear);

namespace detail {

// How numbers are compared.

/// The transfer function of sRGB (IEC 61966-2-1), from linear light.
inline double srgb(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1 + 1.055 * (std::pow(value, 1 / 2.4) - 1);
}

/// The codes that bounds allow: a format may round a value to either neighbour.
inline std::pair<double, double> codes(double lower, double upper, double largest, bool is_srgb) {
  const auto encoded = [&](double end) {
    const double clamped = std::clamp(end, 0.0, 1.0);
    return largest * (is_srgb ? srgb(clamped) : clamped);
  };
  return {std::floor(encoded(lower)), std::ceil(encoded(upper))};
}

/// The distance of a value that is outside to the nearer end.
inline double distance(double value, double lower, double upper) {
  if (std::isnan(value)) return std::numeric_limits<double>::infinity();
  return value < lower ? lower - value : value - upper;
}

/// The largest code of integers; floats have none.
inline std::optional<double> largest_code(const Samples& data) {
  if (std::holds_alternative<std::vector<std::uint8_t>>(data)) return 255;
  if (std::holds_alternative<std::vector<std::uint16_t>>(data)) return 65535;
  return std::nullopt;
}

/// The number of numbers.
inline std::size_t count(const Samples& data) {
  return std::visit([](const auto& numbers) { return numbers.size(); }, data);
}

/// One of the numbers.
inline double at(const Samples& data, std::size_t index) {
  return std::visit([index](const auto& numbers) -> double { return numbers[index]; }, data);
}

/// Throws a `JudgeError` for a picture that does not fit the bounds.
inline void check_shape(const Bounds& bounds, const Picture& picture) {
  const auto text = [](std::size_t number) { return std::to_string(number); };
  if (picture.width != bounds.width || picture.height != bounds.height) {
    throw JudgeError("the picture has " + text(picture.width) + " x " + text(picture.height) +
                     " pixels, but the bounds have " + text(bounds.width) + " x " +
                     text(bounds.height));
  }
  if (picture.lanes < 1 || picture.lanes > bounds.lanes) {
    throw JudgeError("the picture has " + text(picture.lanes) + " lanes, but the bounds have " +
                     text(bounds.lanes));
  }
  const std::size_t expected = picture.width * picture.height * picture.lanes;
  if (count(picture.data) != expected) {
    throw JudgeError("the picture has " + text(count(picture.data)) +
                     " numbers, but its size needs " + text(expected));
  }
}

// How numbers are shown: in all four languages alike.

/// The shortest decimal that means the same number.
inline std::string shown(double number) {
  if (std::isnan(number)) return "NaN";
  number += 0.0;  // without the sign of a negative zero
  const double magnitude = std::fabs(number);
  const bool is_short = number == 0 || (1e-4 <= magnitude && magnitude < 1e16);
  const auto format = is_short ? std::chars_format::fixed : std::chars_format::scientific;
  std::array<char, 32> letters;
  char* const begin = letters.data();
  const std::string text(begin, std::to_chars(begin, begin + letters.size(), number, format).ptr);
  const std::size_t exponent = text.find('e');
  if (exponent == text.npos) return text;
  return text.substr(0, exponent + 1) + std::to_string(std::stoi(text.substr(exponent + 1)));
}

// The format `.npy` of NumPy, as far as pictures need it.

constexpr unsigned long longest_side = 65536;

inline JudgeError damaged_header(const std::string& name) {
  return JudgeError(name + ": has a damaged header");
}

/// The header and the data of a `.npy` file.
inline std::pair<std::string_view, std::string_view> split(const std::string& name,
                                                           std::string_view content) {
  constexpr std::string_view magic = "\x93NUMPY";
  if (content.size() < 8 || content.substr(0, magic.size()) != magic) {
    throw JudgeError(name + ": is no .npy file");
  }
  const auto byte = [content](std::size_t at) { return static_cast<unsigned char>(content[at]); };
  const unsigned major = byte(6), minor = byte(7);
  if (major < 1 || major > 3 || minor != 0) {
    throw JudgeError(name + ": has version " + std::to_string(major) + "." +
                     std::to_string(minor) + " of the .npy format, not 1.0 to 3.0");
  }
  const std::size_t start = major == 1 ? 10 : 12;
  if (content.size() < start) throw damaged_header(name);
  std::size_t length = 0;
  for (std::size_t at = start; at-- > 8;) length = length << 8 | byte(at);
  const std::string_view rest = content.substr(start);
  const std::string_view header = rest.substr(0, length);
  const auto is_text = [](char each) { return each == '\n' || (32 <= each && each < 127); };
  if (header.size() < length || !std::all_of(header.begin(), header.end(), is_text)) {
    throw damaged_header(name);
  }
  return {header, rest.substr(length)};
}

/// A text without the spaces and ends of lines at its own beginning and end.
inline std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char letter) { return letter == ' ' || letter == '\n'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// The rest of a header, from the value of a key on.
inline std::string_view value_of(const std::string& name, std::string_view header,
                                 const std::string& key) {
  const std::string quoted = "'" + key + "'";
  const std::size_t at = header.find(quoted);
  std::string_view rest;
  if (at != header.npos) rest = trimmed(header.substr(at + quoted.size()));
  if (rest.empty() || rest.front() != ':') {
    throw JudgeError(name + ": has a damaged header: no " + key);
  }
  return trimmed(rest.substr(1));
}

/// The text between the two letters that enclose the value of a key.
inline std::string_view between(const std::string& name, std::string_view header,
                                const std::string& key, char first, char last) {
  const std::string_view value = value_of(name, header, key);
  const std::size_t end = value.find(last, 1);
  if (value.empty() || value.front() != first || end == value.npos) {
    throw JudgeError(name + ": has a damaged header: no " + key);
  }
  return value.substr(1, end - 1);
}

/// A side in a header's shape; 0 if it is none.
inline std::size_t side_in(std::string_view text) {
  std::size_t side = 0;
  const bool is_number = std::all_of(text.begin(), text.end(), [](char letter) {
    return '0' <= letter && letter <= '9';
  });
  if (is_number && text.size() <= 5) std::from_chars(text.data(), text.data() + text.size(), side);
  return side;
}

/// The height, the width and the lanes in a header's shape, `56, 72, 4` or `56, 72`.
inline std::array<std::size_t, 3> shape_in(const std::string& name, std::string_view text) {
  std::string_view rest = trimmed(text);
  if (!rest.empty() && rest.back() == ',') rest.remove_suffix(1);
  std::vector<std::size_t> sides;
  for (std::size_t begin = 0, comma = 0; comma != rest.npos; begin = comma + 1) {
    comma = rest.find(',', begin);
    sides.push_back(side_in(trimmed(rest.substr(begin, comma - begin))));
  }
  if (sides.size() == 2) sides.push_back(1);
  const auto is_side = [](std::size_t side) { return 1 <= side && side <= longest_side; };
  if (sides.size() == 3 && is_side(sides[0]) && is_side(sides[1]) && 1 <= sides[2] &&
      sides[2] <= 4) {
    return {sides[0], sides[1], sides[2]};
  }
  throw JudgeError(name + ": has the shape (" + std::string(text) +
                   "), which is no picture: height, width and 1 to 4 lanes");
}

/// The numbers in little-endian data, which is also how they are in memory.
template <class Number>
std::vector<Number> copied(std::string_view data) {
  std::vector<Number> numbers(data.size() / sizeof(Number));
  std::memcpy(numbers.data(), data.data(), data.size());
  return numbers;
}

/// The value of a 16-bit float.
inline float half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 0x1f;
  const int fraction = bits & 0x3ff;
  float magnitude = std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
  if (exponent == 0) magnitude = std::ldexp(static_cast<float>(fraction), -24);
  if (exponent == 31) magnitude = fraction == 0 ? INFINITY : NAN;
  return bits >> 15 ? -magnitude : magnitude;
}

/// The numbers in little-endian data; those of 16-bit floats get 32 bits.
inline Samples numbers_in(std::string_view type, std::string_view data) {
  if (type == "|u1") return copied<std::uint8_t>(data);
  if (type == "<u2") return copied<std::uint16_t>(data);
  if (type == "<f4") return copied<float>(data);
  if (type == "<f8") return copied<double>(data);
  const std::vector<std::uint16_t> halves = copied<std::uint16_t>(data);
  std::vector<float> numbers(halves.size());
  std::transform(halves.begin(), halves.end(), numbers.begin(), half);
  return numbers;
}

/// The content of a `.npy` file, a picture.
struct Npy {
  std::string name;
  std::string type;
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t lanes = 0;
  Samples numbers;

  static Npy load(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string content;
    std::array<char, 65536> chunk;
    while (file.read(chunk.data(), chunk.size()), file.gcount() > 0) {
      content.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) {  // It was not opened, or not read to its end.
      throw JudgeError(path + ": cannot be read: " + std::generic_category().message(errno));
    }
    return parse(path, content);
  }

  static Npy parse(const std::string& name, std::string_view content) {
    constexpr std::string_view known[] = {"|u1", "<u2", "<f2", "<f4", "<f8"};
    const auto [header, data] = split(name, content);
    const std::string type(between(name, header, "descr", '\'', '\''));
    if (std::find(std::begin(known), std::end(known), type) == std::end(known)) {
      throw JudgeError(name + ": has numbers of type " + type +
                       "; known are |u1, <u2, <f2, <f4 and <f8");
    }
    if (value_of(name, header, "fortran_order").substr(0, 5) != "False") {
      throw JudgeError(name + ": is not in C order, row by row");
    }
    const auto [height, width, lanes] =
        shape_in(name, between(name, header, "shape", '(', ')'));
    const auto size = static_cast<std::uint64_t>(type[2] - '0');
    const std::uint64_t needed = size * height * width * lanes;
    if (data.size() != needed) {
      throw JudgeError(name + ": has " + std::to_string(data.size()) +
                       " bytes of numbers, but needs " + std::to_string(needed));
    }
    return {name, type, width, height, lanes, numbers_in(type, data)};
  }

  /// Throws a `JudgeError` for another size, or numbers of another type.
  void expect(const std::string& wanted, const Npy& other, std::size_t other_lanes) const {
    if (width != other.width || height != other.height || lanes != other_lanes) {
      const auto text = [](std::size_t number) { return std::to_string(number); };
      throw JudgeError(name + ": has " + text(width) + " x " + text(height) + " pixels of " +
                       text(lanes) + " lanes, not " + text(other.width) + " x " +
                       text(other.height) + " of " + text(other_lanes));
    }
    if (type != wanted) {
      throw JudgeError(name + ": has numbers of type " + type + ", not " + wanted);
    }
  }
};

inline Picture picture_of(const Npy& file) {
  return {file.width, file.height, file.lanes, file.numbers};
}

inline Bounds bounds_of(const Npy& lower, const Npy& upper, const Npy& undecided) {
  lower.expect("<f8", lower, lower.lanes);
  upper.expect("<f8", lower, lower.lanes);
  undecided.expect("|u1", lower, 1);
  const auto& marks = std::get<std::vector<std::uint8_t>>(undecided.numbers);
  const auto& lows = std::get<std::vector<double>>(lower.numbers);
  const auto& highs = std::get<std::vector<double>>(upper.numbers);
  for (const std::uint8_t mark : marks) {
    if (mark > 1) {
      throw JudgeError(undecided.name + ": is damaged: it has a " + std::to_string(mark) +
                       ", not just 0 and 1");
    }
  }
  for (std::size_t index = 0; index < lows.size(); ++index) {
    if (lows[index] <= highs[index]) continue;
    const std::size_t pixel = index / lower.lanes;
    throw JudgeError(lower.name + ": is damaged at x " + std::to_string(pixel % lower.width) +
                     ", y " + std::to_string(pixel / lower.width) + ", lane " +
                     std::to_string(index % lower.lanes) + ": lower is " + shown(lows[index]) +
                     ", upper " + shown(highs[index]));
  }
  return {lower.width, lower.height, lower.lanes, lows, highs, marks};
}

}  // namespace detail

inline Picture Picture::load(const std::string& path) {
  return detail::picture_of(detail::Npy::load(path));
}

inline Picture Picture::parse(std::string_view content) {
  return detail::picture_of(detail::Npy::parse("picture.npy", content));
}

inline Bounds Bounds::load(const std::string& folder, const std::string& output) {
  return detail::bounds_of(detail::Npy::load(folder + "/" + output + ".lower.npy"),
                           detail::Npy::load(folder + "/" + output + ".upper.npy"),
                           detail::Npy::load(folder + "/undecided.npy"));
}

inline Bounds Bounds::parse(std::string_view lower, std::string_view upper,
                            std::string_view undecided) {
  return detail::bounds_of(detail::Npy::parse("lower.npy", lower),
                           detail::Npy::parse("upper.npy", upper),
                           detail::Npy::parse("undecided.npy", undecided));
}

inline std::string Verdict::message() const {
  const std::string counts = std::to_string(compared) + " pixels compared, " +
                             std::to_string(undecided) + " undecided, " +
                             std::to_string(outside) + " outside of the bounds";
  if (!worst) return "good: " + counts;
  return "bad: " + counts + "; the worst, at x " + std::to_string(worst->x) + ", y " +
         std::to_string(worst->y) + ", lane " + std::to_string(worst->lane) + ", is " +
         detail::shown(worst->value) + ", not within " + detail::shown(worst->lower) + " .. " +
         detail::shown(worst->upper);
}

inline Verdict judge(const Bounds& bounds, const Picture& picture, Encoding encoding) {
  detail::check_shape(bounds, picture);
  const std::optional<double> largest = detail::largest_code(picture.data);
  if (!largest && encoding == Encoding::srgb) {
    throw JudgeError("the picture has floats, which are linear: only integers are encoded");
  }
  Verdict verdict;
  for (std::size_t pixel = 0; pixel < bounds.undecided.size(); ++pixel) {
    if (bounds.undecided[pixel]) {
      ++verdict.undecided;
      continue;
    }
    ++verdict.compared;
    bool is_outside = false;
    for (std::size_t lane = 0; lane < picture.lanes; ++lane) {
      const std::size_t at = pixel * bounds.lanes + lane;
      double lower = bounds.lower[at], upper = bounds.upper[at];
      if (largest) {
        const bool is_srgb = encoding == Encoding::srgb && lane < 3;
        std::tie(lower, upper) = detail::codes(lower, upper, *largest, is_srgb);
      }
      const double value = detail::at(picture.data, pixel * picture.lanes + lane);
      if (lower <= value && value <= upper) continue;
      is_outside = true;
      const double distance = detail::distance(value, lower, upper) / largest.value_or(1);
      if (!verdict.worst || distance > verdict.worst->distance) {
        const std::size_t x = pixel % bounds.width, y = pixel / bounds.width;
        verdict.worst = Outlier{x, y, lane, value, lower, upper, distance};
      }
    }
    if (is_outside) ++verdict.outside;
  }
  if (verdict.compared == 0) {
    throw JudgeError("nothing is compared: every pixel is undecided");
  }
  return verdict;
}

}  // namespace burnish_judge

#ifdef BURNISH_JUDGE_MAIN

#include <iostream>

/// The command line. The exit code is 0 for a good picture, 1 for a bad one, and 2 for an error.
int main(int count, char** arguments) {
  using namespace burnish_judge;
  const std::string encoding = count == 5 ? arguments[4] : "linear";
  if (count < 4 || count > 5 || (encoding != "linear" && encoding != "srgb")) {
    std::cerr << "usage: burnish_judge FOLDER OUTPUT PICTURE.npy [linear|srgb]\n";
    return 2;
  }
  try {
    const Bounds bounds = Bounds::load(arguments[1], arguments[2]);
    const Picture picture = Picture::load(arguments[3]);
    const Verdict verdict =
        judge(bounds, picture, encoding == "srgb" ? Encoding::srgb : Encoding::linear);
    std::cout << verdict.message() << '\n';
    return verdict.is_good() ? 0 : 1;
  } catch (const JudgeError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
}

#endif  // BURNISH_JUDGE_MAIN

#endif  // BURNISH_JUDGE_HPP
