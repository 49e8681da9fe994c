#pragma once
// What `carom doctor` says of the renderer, after a small picture that it has drawn. Tested in
// tests/demos/program/program_test.cpp and gl_choice_program_test.cpp.

#include <iostream>
#include <string>

namespace carom::demos {

/// One line of the report: a word and its answer, in columns.
inline void tellFact(const std::string& what, const std::string& answer) {
  constexpr std::size_t kColumn = 16;
  std::cout << what << std::string(what.size() < kColumn ? kColumn - what.size() : 1, ' ') << answer << '\n';
}

/// Tells who draws and why, and draws; with "auto", tells of the context that was not taken as well. Throws
/// NoRenderer, with the packages that would help.
void examineRenderer(const std::string& gl);

}  // namespace carom::demos
