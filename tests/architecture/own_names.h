#pragma once
// What a source calls its own: the names in its unnamed namespaces, judged from its text alone. Operators are
// left out, as they are told apart by what they take. Tested in tests/architecture/own_names_test.cpp.

#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/function_rules.h"

namespace carom::architecture {

/// The name that a declaration gives, of the text before its body, its value or its end; empty where it gives
/// none.
inline std::string nameGivenBy(const std::string& declaration) {
  static const std::regex kSkipped(
      "^\\s*(static_assert\\b|using\\s+(namespace\\b|\\w*::)|friend\\b)|\\boperator\\b");
  static const std::regex kType(
      "^\\s*(template\\s*<.*>\\s*)?(struct|class|enum\\s+class|enum|using)\\s+(\\w+)[^()]*$");
  static const std::regex kOther("(\\w+)\\s*(\\[[^\\]]*\\]\\s*)*(\\(|$)");
  std::smatch found;
  if (std::regex_search(declaration, kSkipped)) return "";
  if (std::regex_match(declaration, found, kType)) return found[3];
  return std::regex_search(declaration, found, kOther) ? found[1].str() : "";
}

/// All of them in a source.
inline std::set<std::string> ownNames(std::string_view text) {
  static const std::regex kNamespace("^\\s*(inline\\s+)?namespace(\\s+[\\w:]+)?\\s*$");
  static const std::regex kUnnamedNamespace("^\\s*namespace\\s*$");
  enum class Scope { kNamed, kUnnamed, kInside };
  std::vector<Scope> scopes;
  std::set<std::string> names;
  std::string statement;
  enum class Part { kName, kBody, kValue };  // of a declaration: a value ends with its semicolon
  Part part = Part::kName;
  const std::string code = std::regex_replace(codeOf(text), std::regex("(^|\n)[ \t]*#[^\n]*"), "\n");
  for (const char c : code) {
    const Scope scope = scopes.empty() ? Scope::kNamed : scopes.back();
    const bool opens = c == '{' && scope != Scope::kInside && std::regex_match(statement, kNamespace);
    if (scope == Scope::kUnnamed && part == Part::kName && !opens && (c == '{' || c == '=' || c == ';')) {
      if (const std::string name = nameGivenBy(statement); !name.empty()) names.insert(name);
      part = c == '=' ? Part::kValue : Part::kBody;
    }
    if (c == '{') {
      const bool named = scope == Scope::kNamed && !std::regex_match(statement, kUnnamedNamespace);
      scopes.push_back(!opens ? Scope::kInside : named ? Scope::kNamed : Scope::kUnnamed);
    }
    if (c == '}' && !scopes.empty()) scopes.pop_back();
    if (c == ';' || c == '{' || c == '}')
      statement.clear();
    else
      statement += c;
    if (scopes.empty() || scopes.back() != Scope::kUnnamed) continue;
    if (c == ';' || (c == '}' && part == Part::kBody)) part = Part::kName;
  }
  return names;
}

}  // namespace carom::architecture
