#include "demos/format/written_precision.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace carom::demos {
namespace {

constexpr int kMeantAsTheyStand = 4;  // digits

struct Written {
  int digits = 0;      ///< From the first that is not 0 on.
  int last_place = 0;  ///< The power of ten of the last digit.
};

/// Of a decimal number with a point; no digits for any other word.
Written writtenAs(std::string_view word) {
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(word.data() + (word[0] == '+' ? 1 : 0), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return {};
  Written written;
  bool after_point = false, counted = false;
  std::size_t i = 0;
  for (; i < word.size() && word[i] != 'e' && word[i] != 'E'; ++i) {
    if (word[i] == '.') after_point = true;
    if (word[i] < '0' || word[i] > '9') continue;
    counted = counted || word[i] != '0';
    written.digits += counted ? 1 : 0;
    written.last_place -= after_point ? 1 : 0;
  }
  if (!after_point) return {};
  int exponent = 0;
  if (i < word.size()) {
    const std::size_t first = i + 1 + (i + 1 < word.size() && word[i + 1] == '+' ? 1 : 0);
    std::from_chars(word.data() + first, word.data() + word.size(), exponent);
  }
  written.last_place += exponent;
  return written;
}

/// The number with the most digits.
Written longestNumber(std::string_view text) {
  Written most;
  if (text.find('\0') != std::string_view::npos) return most;
  constexpr std::string_view kBetween = " \t\r\n,;/";
  for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    const Written word = writtenAs(text.substr(at, end - at));
    if (word.digits > most.digits || (word.digits == most.digits && word.last_place > most.last_place))
      most = word;
    at = text.find_first_not_of(kBetween, end);
  }
  return most;
}

/// Takes words and lines off the front of a text.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  bool done() const { return rest_.empty(); }
  Words line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    Words words(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return words;
  }
  std::string_view next() {
    const std::size_t first = rest_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    const std::size_t end = std::min(rest_.find_first_of(" \t\r", first), rest_.size());
    const std::string_view word = rest_.substr(first, end - first);
    rest_.remove_prefix(end);
    return word;
  }
  /// Not a number where there is none.
  double number() {
    std::string_view word = next();
    if (!word.empty() && word[0] == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = error == std::errc() && !word.empty() && end == word.data() + word.size();
    return whole ? value : std::numeric_limits<double>::quiet_NaN();
  }
  Vec3 point() {
    const double x = number(), y = number();
    return {x, y, number()};
  }

 private:
  std::string_view rest_;
};

/// OBJ and STL name each vertex.
std::vector<Vec3> namedVertices(std::string_view text, std::string_view name) {
  std::vector<Vec3> vertices;
  for (Words words(text); !words.done();) {
    Words line = words.line();
    if (line.next() == name) vertices.push_back(line.point());
  }
  return vertices;
}

std::vector<Vec3> offVertices(std::string_view text) {
  Words words(text);
  words.line();
  std::vector<Vec3> vertices;
  double count = -1.0;
  while (!words.done() && (count < 0.0 || static_cast<double>(vertices.size()) < count)) {
    Words line = words.line(), again = line;
    const std::string_view first = again.next();
    if (first.empty() || first[0] == '#') continue;
    if (count < 0.0)
      count = line.number();
    else
      vertices.push_back(line.point());
  }
  return vertices;
}

std::vector<Vec3> plyVertices(std::string_view text) {
  Words words(text);
  std::array<int, 3> column{-1, -1, -1};
  int elements = 0, columns = 0;
  double count = 0.0;
  for (bool in_header = true; in_header && !words.done();) {
    Words line = words.line();
    const std::string_view key = line.next(), name = line.next();
    if (key == "format" && name != "ascii") return {};
    if (key == "element") {
      if (elements++ == 0 && name != "vertex") return {};
      if (elements == 1) count = line.number();
    }
    if (key == "property" && elements == 1) {
      const std::string_view what = line.next();
      for (std::size_t i = 0; i < 3; ++i)
        if (what == std::string_view("xyz").substr(i, 1)) column[i] = columns;
      ++columns;
    }
    in_header = key != "end_header";
  }
  std::vector<Vec3> vertices;
  while (!words.done() && static_cast<double>(vertices.size()) < count) {
    Words line = words.line();
    Vec3 p = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    for (int i = 0; i < columns; ++i) {
      const double value = line.number();
      for (int k = 0; k < 3; ++k)
        if (column[static_cast<std::size_t>(k)] == i) p[k] = value;
    }
    vertices.push_back(p);
  }
  return vertices;
}

}  // namespace

double halfLastDigit(std::string_view text) {
  const Written most = longestNumber(text);
  if (most.digits <= kMeantAsTheyStand) return 0.0;
  double error = 0.5;  // no power of the C library's, whose last bit differs from one to the next
  for (int place = most.last_place; place < 0; ++place) error /= 10.0;
  for (int place = 0; place < most.last_place; ++place) error *= 10.0;
  return error;
}

bool hasDoubleDigits(std::string_view text) {
  return longestNumber(text).digits > std::numeric_limits<float>::max_digits10;
}

std::vector<Vec3> writtenVertices(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return {};
  const std::string_view first = Words(text).line().next();
  std::vector<Vec3> vertices = first == "ply"                      ? plyVertices(text)
                               : first == "OFF" || first == "COFF" ? offVertices(text)
                               : first == "solid"                  ? namedVertices(text, "vertex")
                                                                   : namedVertices(text, "v");
  for (const Vec3& p : vertices)
    if (!p.allFinite()) return {};
  return vertices;
}

bool takeWritten(const std::vector<Vec3>& written, std::vector<Vec3*>& points) {
  double reach = 0.0;
  for (const Vec3& p : written) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  if (written.empty() || !(reach > 0.0)) return false;
  // Cells as wide as the largest error: what a point is the rounding of is in its own or one beside it.
  const double error = 1e-6 * reach;
  using Cell = std::array<std::int64_t, 3>;
  const auto cellOf = [error](const Vec3& p) {
    Cell cell;
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::floor(p[static_cast<Eigen::Index>(i)] / error));
    return cell;
  };
  std::map<Cell, std::vector<const Vec3*>> cells;
  for (const Vec3& p : written) {
    std::vector<const Vec3*>& there = cells[cellOf(p)];
    if (std::none_of(there.begin(), there.end(), [&p](const Vec3* other) { return *other == p; }))
      there.push_back(&p);
  }
  std::vector<Vec3> found;
  for (const Vec3* point : points) {
    if (point->cwiseAbs().maxCoeff() > 2.0 * reach) return false;
    const Vec3* own = nullptr;
    const Cell middle = cellOf(*point);
    for (int i = 0; i < 27; ++i) {
      const auto near = cells.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
      if (near == cells.end()) continue;
      for (const Vec3* candidate : near->second) {
        if ((*candidate - *point).cwiseAbs().maxCoeff() > error) continue;
        if (own != nullptr) return false;
        own = candidate;
      }
    }
    if (own == nullptr) return false;
    found.push_back(*own);
  }
  for (std::size_t i = 0; i < points.size(); ++i) *points[i] = found[i];
  return true;
}

}  // namespace carom::demos
