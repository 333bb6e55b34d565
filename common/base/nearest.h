#pragma once
/// "did you mean ...?": finds the known name nearest to the typed one.

#include <string>
#include <vector>

namespace seam {

/// Returns the name in `known` with the least edit distance (insertions, deletions, changes, swaps
/// of two neighbours) to `typed`, the first of several. "" if the distance is over the limit: one
/// for up to three typed characters, else a third of them but at least two.
std::string NearestName(const std::string& typed, const std::vector<std::string>& known);

/// Returns "did you mean 'x'?" or else the choices, "known are a b c" (the first `shown_max`).
std::string Suggestion(const std::string& typed, const std::vector<std::string>& known,
                       std::size_t shown_max = 20);

/// Returns " (did you mean 'x'?)" to append to an error line; "" when no name is near.
std::string DidYouMean(const std::string& typed, const std::vector<std::string>& known);

}  // namespace seam
