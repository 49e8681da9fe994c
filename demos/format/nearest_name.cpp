#include "demos/format/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace carom::demos {
namespace {

// What is longer is no slip of a name, and its table of distances grows with the square.
constexpr std::size_t kLongestName = 200;
constexpr std::size_t kMostListed = 60;

bool sameLetter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

}  // namespace

int editDistance(std::string_view a, std::string_view b) {
  // Rows of the usual table: `two_up` and `up` are the rows above the one being filled.
  std::vector<int> two_up, up(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) up[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int substitution = up[j - 1] + (sameLetter(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({up[j] + 1, row[j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && sameLetter(a[i - 1], b[j - 2]) && sameLetter(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_up[j - 2] + 1);
    }
    two_up = up;
    up = row;
  }
  return up[b.size()];
}

std::string nearestName(std::string_view name, std::span<const std::string> candidates) {
  std::string best;
  int best_distance = 0;
  if (name.size() > kLongestName) return best;
  for (const std::string& candidate : candidates) {
    const std::size_t shorter = std::min(name.size(), candidate.size());
    const std::size_t longer = std::max(name.size(), candidate.size());
    // More than a third of the letters wrong is another word, not a slip.
    const int allowed = std::max(1, static_cast<int>(longer) / 3);
    if (longer - shorter > static_cast<std::size_t>(allowed)) continue;
    const int distance = editDistance(name, candidate);
    if (distance > allowed || (!best.empty() && distance >= best_distance)) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string acceptedNames(std::string_view name, std::span<const std::string> candidates) {
  const std::string nearest = nearestName(name, candidates);
  std::string text = nearest.empty() ? "; " : "; did you mean \"" + nearest + "\"? ";
  text += "accepted: ";
  const std::size_t listed = std::min(candidates.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i) text += (i > 0 ? ", " : "") + candidates[i];
  if (listed < candidates.size()) text += " and " + std::to_string(candidates.size() - listed) + " more";
  if (candidates.empty()) text += "none";
  return text;
}

}  // namespace carom::demos
