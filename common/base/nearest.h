#pragma once
/// "did you mean ...?": the known name that is nearest to one that was typed.

#include <string>
#include <vector>

namespace seam {

/// The name of `known` with the least edit distance (insertions, deletions, changes, swaps of two
/// neighbours) to `typed`, if that is at most a third of the typed characters, or two (one of a
/// word of up to three characters); else "". The first of several.
std::string NearestName(const std::string& typed, const std::vector<std::string>& known);

/// "did you mean 'x'?", or what there is, "known are a b c" (of many, the first `shown_max`).
std::string Suggestion(const std::string& typed, const std::vector<std::string>& known,
                       std::size_t shown_max = 20);

/// " (did you mean 'x'?)", to follow a mistake; "" when no name is near.
std::string DidYouMean(const std::string& typed, const std::vector<std::string>& known);

}  // namespace seam
