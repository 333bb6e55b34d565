#pragma once
/// The checked objective of `tune gait`: an ability, its starts, and the gains to search.

#include <string>
#include <vector>

namespace seam {

/// One gain of the search.
struct SearchedGain {
  std::string name;
  double start = 0;         ///< the value built in, unless the file says another
  double sigma = 0;         ///< deviation of the first samples
  double min = 0, max = 0;  ///< samples beyond are moved to the bound
};

/// Starts from.. from + count - 1.
struct StartRange {
  int from = 1, count = 1;
};

/// Another ability that the search must not spoil.
struct AlsoTrained {
  std::string ability;
  StartRange train;
  double weight = 1;  ///< of its mean cost beside that of the ability that is searched
};

struct GaitFile {
  std::string ability;                  ///< a name of Abilities()
  StartRange train, held_out;           ///< without a start in common
  std::string solver = "substeps = 4";  ///< lines of [solver]
  std::string character;                ///< more lines of [[character]]
  std::vector<AlsoTrained> also;
  int lambda = 15, generations = 40, seed = 1;
  std::vector<SearchedGain> gains;
};

/// Throws OperatorError "file:line: ..." for mistakes.
GaitFile ReadGaitFile(const std::string& path);

}  // namespace seam
