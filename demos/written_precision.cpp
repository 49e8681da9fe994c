#include "demos/written_precision.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>

namespace carom::demos {
namespace {

constexpr std::size_t kRead = 1 << 20;
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

}  // namespace

double halfLastDigit(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) return 0.0;
  constexpr std::string_view kBetween = " \t\r\n,;/";
  Written most;
  for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    const Written word = writtenAs(text.substr(at, end - at));
    if (word.digits > most.digits || (word.digits == most.digits && word.last_place > most.last_place))
      most = word;
    at = text.find_first_not_of(kBetween, end);
  }
  if (most.digits <= kMeantAsTheyStand) return 0.0;
  double error = 0.5;  // no power of the C library's, whose last bit differs from one to the next
  for (int place = most.last_place; place < 0; ++place) error /= 10.0;
  for (int place = 0; place < most.last_place; ++place) error *= 10.0;
  return error;
}

double writtenError(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kRead, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  // The last number may be cut.
  if (text.size() == kRead)
    text.resize(text.find_last_of('\n') == std::string::npos ? 0 : text.find_last_of('\n'));
  return halfLastDigit(text);
}

}  // namespace carom::demos
