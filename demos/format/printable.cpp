#include "demos/format/printable.h"

namespace carom::demos {
namespace {

/// The length of the character at the front: 0 where it is no UTF-8 or a control character.
std::size_t plainLength(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const unsigned second = byte(1);
  const bool is_control = first == 0xc2 && second < 0xa0;  // U+0080 to U+009F
  const bool is_break = first == 0xe2 && second == 0x80 && (byte(2) == 0xa8 || byte(2) == 0xa9);
  const bool is_overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool is_no_character = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return is_control || is_break || is_overlong || is_no_character ? 0 : length;
}

std::string escaped(char c) {
  constexpr char kDigits[] = "0123456789abcdef";
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
}

/// As many whole pieces as fit.
std::string escapedUpTo(std::string_view text, std::size_t most) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = plainLength(text);
    const std::string piece = length > 0 ? std::string(text.substr(0, length)) : escaped(text[0]);
    if (line.size() + piece.size() > most) break;
    line += piece;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return line;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t kHalf = kLongestLine / 2;
  if (text.size() <= kHalf) return escapedUpTo(text, kLongestLine);
  const std::string line = escapedUpTo(text, 4 * text.size());
  if (line.size() <= kLongestLine) return line;
  std::size_t end = line.size() - kHalf;
  while (end < line.size() && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) ++end;
  return escapedUpTo(line, kHalf - 5) + " ... " + line.substr(end);
}

}  // namespace carom::demos
