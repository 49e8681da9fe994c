#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <vector>

#include "demos/format/content_hash.h"

namespace carom::fuzz {
namespace {

constexpr const char* kNumbers[] = {"0",          "-0",         "1",           "-1",
                                    "0.5",        "1e-4",       "1e-5",        "1e5",
                                    "1e6",        "5e-324",     "1e-308",      "1e-200",
                                    "1e-30",      "1e30",       "1e200",       "1e308",
                                    "-1e308",     "1e999",      "NaN",         "20000",
                                    "1000000",    "65536",      "0.001",       "2147483647",
                                    "2147483648", "4294967295", "-2147483648", "1e-9",
                                    "1e9",        "3.5",        "1000000000",  "18446744073709551616",
                                    "0x10",       "1e",         "00",          "-",
                                    "99999",      "360"};
constexpr const char* kTexts[] = {"",        "a\\nb",    "\\u001b[2J", "\\u0000", "\xff\xfe",
                                  "\xc3",    "../../..", "/dev/zero",  "floor",   "meshes/gem.obj",
                                  "\\ud800", "#12345g",  "%s%n",       "a[1]",    "."};
constexpr const char* kValues[] = {"null",  "true",       "{}",      "[]",   "[[[[]]]]",
                                   "\"x\"", "{\"a\":{}}", "[0,0,0]", "[1,2]"};

template <std::size_t N>
std::string oneOf(const char* const (&list)[N], Random& random) {
  return list[random.below(N)];
}

struct Span {
  std::size_t begin = 0, end = 0;
};

bool isOfNumber(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+' || c == 'e';
}

/// The numbers, or the insides of the strings, of a text.
std::vector<Span> numbersOf(const std::string& text) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(text[i])) == 0 && text[i] != '-') continue;
    std::size_t end = i + 1;
    while (end < text.size() && isOfNumber(text[end])) ++end;
    spans.push_back({i, end});
    i = end;
  }
  return spans;
}

std::vector<Span> stringsOf(const std::string& text) {
  std::vector<Span> spans;
  for (std::size_t i = text.find('"'); i != std::string::npos; i = text.find('"', i)) {
    const std::size_t end = text.find('"', i + 1);
    if (end == std::string::npos) break;
    spans.push_back({i + 1, end});
    i = end + 1;
  }
  return spans;
}

/// From a bracket to the one that closes it; nothing where there is none.
Span someBrackets(const std::string& text, Random& random) {
  if (text.empty()) return {};
  const std::size_t begin = text.find_first_of("{[", random.below(text.size()));
  if (begin == std::string::npos) return {};
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    depth += text[i] == '{' || text[i] == '[' ? 1 : text[i] == '}' || text[i] == ']' ? -1 : 0;
    if (depth == 0) return {begin, i + 1};
  }
  return {};
}

void replace(std::string& text, const Span& span, const std::string& by) {
  text.replace(span.begin, span.end - span.begin, by);
}

std::string pieceOf(const std::string& text, Random& random, std::size_t longest) {
  if (text.empty()) return "";
  return text.substr(random.below(text.size()), 1 + random.below(longest));
}

std::string newText(Random& random) {
  if (random.oneIn(20)) return std::string(1 + random.below(100000), 'x');
  return oneOf(kTexts, random);
}

void mutateText(std::string& text, const std::string& other, Random& random) {
  const std::size_t what = random.below(10);
  if (what < 4) {
    const std::vector<Span> numbers = numbersOf(text);
    if (!numbers.empty()) replace(text, numbers[random.below(numbers.size())], oneOf(kNumbers, random));
  } else if (what < 6) {
    const std::vector<Span> strings = stringsOf(text);
    if (strings.empty()) return;
    const Span chosen = strings[random.below(strings.size())];
    const Span source = strings[random.below(strings.size())];
    replace(text, chosen,
            random.oneIn(2) ? newText(random) : text.substr(source.begin, source.end - source.begin));
  } else {
    const Span brackets = someBrackets(text, random);
    if (brackets.end == 0) return;
    const Span source = someBrackets(other, random);
    const std::string own = text.substr(brackets.begin, brackets.end - brackets.begin);
    if (what == 6) replace(text, brackets, oneOf(kValues, random));
    if (what == 7) replace(text, brackets, std::string(own).append(",").append(own));
    if (what == 8) replace(text, brackets, other.substr(source.begin, source.end - source.begin));
    if (what == 9) replace(text, brackets, "");
  }
}

void mutateBytes(std::string& bytes, const std::string& other, Random& random) {
  if (bytes.empty()) bytes.push_back('x');
  const std::size_t at = random.below(bytes.size());
  switch (random.below(9)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(random.next());
      break;
    case 2:
      bytes.erase(at, 1 + random.below(64));
      break;
    case 3:
      bytes.insert(at, pieceOf(bytes, random, 256));
      break;
    case 4:
      bytes.insert(at, pieceOf(other, random, 1024));
      break;
    case 5:
      bytes.resize(at);
      break;
    case 6: {  // a word of an extreme value
      const std::uint64_t words[] = {0,
                                     ~0ull,
                                     0x7fffffff,
                                     0x80000000,
                                     0xffff,
                                     1,
                                     0x7ff0000000000000ull,
                                     0x7ff8000000000000ull,
                                     0x7f800000,
                                     0x3f800000,
                                     random.next()};
      const std::uint64_t word = words[random.below(std::size(words))];
      const std::size_t size = std::min<std::size_t>(std::size_t{1} << random.below(4), bytes.size() - at);
      std::memcpy(bytes.data() + at, &word, size);
      break;
    }
    case 7:
      bytes = bytes.substr(0, at) + (at < other.size() ? other.substr(at) : "");
      break;
    default:
      for (int k = 0; k < 16; ++k) bytes[random.below(bytes.size())] = static_cast<char>(random.next());
  }
}

constexpr std::size_t kRecordingStart = 12, kBlockHead = 5, kSumSize = 8;

/// The checksums of all blocks that are whole.
void repairSums(std::string& bytes) {
  demos::ContentHash sum;
  for (std::size_t at = kRecordingStart; at + kBlockHead <= bytes.size();) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + 1, sizeof size);
    const std::size_t end = at + kBlockHead + size;
    if (end + kSumSize > bytes.size()) return;
    sum.add(bytes.substr(at, end - at));
    const std::uint64_t value = sum.value();
    std::memcpy(bytes.data() + end, &value, kSumSize);
    at = end + kSumSize;
  }
}

}  // namespace

std::uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15ull;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

std::string mutatedText(std::string text, const std::string& other, Random& random) {
  const std::size_t times = 1 + random.below(4);
  for (std::size_t i = 0; i < times; ++i)
    random.oneIn(8) ? mutateBytes(text, other, random) : mutateText(text, other, random);
  return text;
}

std::string mutatedBytes(std::string bytes, const std::string& other, Random& random) {
  const std::size_t times = 1 + random.below(4);
  for (std::size_t i = 0; i < times; ++i) mutateBytes(bytes, other, random);
  return bytes;
}

std::string mutatedRecording(std::string bytes, const std::string& other, Random& random) {
  constexpr std::size_t begin = kRecordingStart + kBlockHead;
  if (bytes.size() > begin && random.oneIn(2)) {  // the header's text, and its size with it
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + kRecordingStart + 1, sizeof size);
    size = static_cast<std::uint32_t>(std::min<std::size_t>(size, bytes.size() - begin));
    std::string header = bytes.substr(begin, size);
    mutateText(header, header, random);
    const auto length = static_cast<std::uint32_t>(header.size());
    bytes.replace(begin, size, header);
    std::memcpy(bytes.data() + kRecordingStart + 1, &length, sizeof length);
  } else {
    bytes = mutatedBytes(std::move(bytes), other, random);
  }
  if (!random.oneIn(4)) repairSums(bytes);
  return bytes;
}

}  // namespace carom::fuzz
