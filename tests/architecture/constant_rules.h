#pragma once
// The constants that a source names, with the text of their values. Comments are blanked first
// (function_rules.h). Tested in tests/architecture/constants_test.cpp.

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/function_rules.h"

namespace carom::architecture {

struct Constant {
  std::string name;
  std::string value;  ///< As it is written, blanks left out.
  int line = 0;
};

/// One "name = value" or "name{value}" of a declaration; without a name where it declares no kConstant.
inline Constant constantOf(std::string_view part) {
  const std::size_t begin = part.find_first_of("={(;");
  if (begin == part.npos || part[begin] == '(' || part[begin] == ';') return {};
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string_view head = part.substr(0, begin);
  if (const std::size_t array = head.find('['); array != head.npos) head = head.substr(0, array);
  while (!head.empty() && !is_word(head.back())) head.remove_suffix(1);
  std::size_t name = head.size();
  while (name > 0 && is_word(head[name - 1])) --name;
  Constant constant;
  if (head.size() < name + 2 || head[name] != 'k' ||
      std::isupper(static_cast<unsigned char>(head[name + 1])) == 0)
    return {};
  constant.name = head.substr(name);
  for (const char c : part.substr(begin + (part[begin] == '=' ? 1 : 0)))
    if (std::isspace(static_cast<unsigned char>(c)) == 0) constant.value += c;
  return constant;
}

/// All that are declared const or constexpr under a name like kName.
inline std::vector<Constant> constantsOf(std::string_view text) {
  const std::string code = codeOf(text);
  std::vector<Constant> found;
  static const std::regex kWord(R"(\bconst(expr)?\b)");
  std::size_t read = 0;  // the end of the last declaration: a constexpr one may say const as well
  for (std::sregex_iterator word(code.begin(), code.end(), kWord), end; word != end; ++word) {
    const auto begin = static_cast<std::size_t>(word->position());
    if (begin < read) continue;
    const std::size_t stop = std::min(code.find(';', begin), code.size());
    for (const std::string& part : partsOf(std::string_view(code).substr(begin, stop - begin))) {
      Constant constant = constantOf(part);
      if (constant.name.empty()) break;
      const auto before = code.begin() + static_cast<std::ptrdiff_t>(begin);
      constant.line = static_cast<int>(1 + std::count(code.begin(), before, '\n'));
      found.push_back(constant);
      read = stop;
    }
  }
  return found;
}

}  // namespace carom::architecture
