#pragma once
// What a function may look like: how many parameters it takes, and that it keeps no memory of its thread. A
// source is judged from its text alone: comments and strings are blanked, then every pair of parentheses
// whose parts all read "type name" is a list of parameters. Tested in tests/architecture/functions_test.cpp.

#include <algorithm>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace carom::architecture {

inline constexpr std::size_t kMostParameters = 6;

/// The text with comments and the insides of strings and characters replaced by blanks; lines stay lines.
inline std::string codeOf(std::string_view text) {
  std::string code(text);
  const auto blank = [&code](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      if (code[i] != '\n') code[i] = ' ';
  };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (text.substr(i, 2) == "//") {
      end = std::min(text.find('\n', i), text.size());
      blank(i, end);
    } else if (text.substr(i, 2) == "/*") {
      const std::size_t close = text.find("*/", i + 2);
      end = close == text.npos ? text.size() : close + 2;
      blank(i, end);
    } else if (text.substr(i, 2) == "R\"") {
      const std::size_t open = std::min(text.find('(', i), text.size());
      std::string close(1, ')');
      close.append(text.substr(i + 2, open - i - 2)).append(1, '"');
      const std::size_t found = text.find(close, open);
      end = found == text.npos ? text.size() : found + close.size();
      blank(i, end);
    } else if (text[i] == '"' ||
               (text[i] == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, text.size());
      blank(i + 1, end - 1);
    }
    i = end;
  }
  return code;
}

/// The parts of a list between commas that no bracket encloses.
inline std::vector<std::string> partsOf(std::string_view list) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : list) {
    if (std::string_view("([{<").find(c) != std::string_view::npos) ++depth;
    if (std::string_view(")]}>").find(c) != std::string_view::npos) --depth;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Whether a part reads "type name", with a default perhaps.
inline bool isParameter(const std::string& part) {
  std::size_t end = part.find('=');
  std::string_view text(part.data(), end == part.npos ? part.size() : end);
  const auto strip = [&text](auto drop) {
    while (!text.empty() && drop(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  };
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  strip(is_space);
  const std::size_t before_name = text.size();
  strip(is_word);
  if (text.size() == before_name || text.empty()) return false;
  if (!is_space(static_cast<unsigned char>(text.back())) && text.back() != '&' && text.back() != '*')
    return false;
  strip([&](unsigned char c) { return is_space(c) || c == '&' || c == '*'; });
  // The type: words, scopes and what angle brackets hold.
  static const std::regex kType(
      R"(\s*[A-Za-z_][\w:]*(\s+[A-Za-z_][\w:]*)*(\s*<[\s\S]*>)?(::\w+)?(\s+const)?\s*)");
  return std::regex_match(text.begin(), text.end(), kType);
}

struct LongList {
  std::string function;
  int line = 0;
  std::size_t parameters = 0;
};

/// The functions, constructors and lambdas of a source that take more than `kMostParameters`.
inline std::vector<LongList> longParameterLists(std::string_view text) {
  const std::string code = codeOf(text);
  std::vector<LongList> found;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '(') open.push_back(i);
    if (code[i] != ')' || open.empty()) continue;
    const std::size_t begin = open.back();
    open.pop_back();
    const std::vector<std::string> parts = partsOf(std::string_view(code).substr(begin + 1, i - begin - 1));
    if (parts.size() <= kMostParameters || !std::all_of(parts.begin(), parts.end(), isParameter)) continue;
    std::size_t name = begin;
    while (name > 0 &&
           (std::isalnum(static_cast<unsigned char>(code[name - 1])) != 0 || code[name - 1] == '_'))
      --name;
    const auto line = 1 + std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    found.push_back({code.substr(name, begin - name), static_cast<int>(line), parts.size()});
  }
  return found;
}

/// The lines that name memory of a thread.
inline std::vector<int> threadLocalLines(std::string_view text) {
  const std::string code = codeOf(text);
  std::vector<int> lines;
  static constexpr std::string_view kWord = "thread_local";
  for (std::size_t at = code.find(kWord); at != code.npos; at = code.find(kWord, at + 1))
    lines.push_back(
        static_cast<int>(1 + std::count(code.begin(), code.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
  return lines;
}

}  // namespace carom::architecture
