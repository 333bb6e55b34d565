#include "common/base/nearest.h"

#include <algorithm>

namespace seam {
namespace {

/// Returns the edit distance: insertions, deletions, changes, and swaps of two neighbours (Damerau
/// 1964, no part edited twice).
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1), above, above_that;
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    above_that = above;
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({change, above[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], above_that[j - 2] + 1);
    }
  }
  return row[b.size()];
}

/// Returns the most edits that still count as near. A short word is near to most others, so that
/// only one is allowed.
std::size_t MistakesMax(const std::string& typed) {
  return typed.size() <= 3 ? 1 : std::max<std::size_t>(2, typed.size() / 3);
}

}  // namespace

std::string NearestName(const std::string& typed, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = MistakesMax(typed) + 1;
  for (const std::string& name : known) {
    const std::size_t distance = EditDistance(typed, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string Suggestion(const std::string& typed, const std::vector<std::string>& known,
                       std::size_t shown_max) {
  const std::string nearest = NearestName(typed, known);
  if (!nearest.empty()) return "did you mean '" + nearest + "'?";
  if (known.empty()) return "there is none";
  std::string all = "known are";
  for (std::size_t i = 0; i < std::min(known.size(), shown_max); ++i) all += " " + known[i];
  if (known.size() > shown_max) all += " and " + std::to_string(known.size() - shown_max) + " more";
  return all;
}

std::string DidYouMean(const std::string& typed, const std::vector<std::string>& known) {
  const std::string nearest = NearestName(typed, known);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

}  // namespace seam
