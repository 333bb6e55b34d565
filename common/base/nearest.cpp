#include "common/base/nearest.h"

#include <algorithm>

namespace seam {
namespace {

/// Edit distance (Levenshtein 1966): insertions, deletions and changes from one to the other.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string NearestName(const std::string& typed, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, typed.size() / 3) + 1;
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

}  // namespace seam
