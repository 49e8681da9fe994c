#pragma once
// The failures that are known: open.txt, one a line, "<kind> <family> <figure> # cause". A family may be "*";
// a line covers failures of that kind and family up to that figure, a larger one fails. Tested in
// tests/explore/open_failures_test.cpp.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carom::explore {

struct OpenFailure {
  std::string kind;
  std::string family;  ///< "*": any.
  double most = 0.0;
  std::string cause;

  bool covers(const std::string& of_kind, const std::string& of_family, double figure) const {
    return kind == of_kind && (family == "*" || family == of_family) && figure <= most;
  }
};

/// Throws InputError with the line for one that is not of that form.
std::vector<OpenFailure> parseOpenFailures(std::string_view text, const std::string& origin);
std::vector<OpenFailure> readOpenFailures(const std::filesystem::path& path);

}  // namespace carom::explore
