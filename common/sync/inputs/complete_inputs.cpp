#include "common/sync/inputs/complete_inputs.h"

#include <algorithm>

namespace seam {

std::int64_t CompleteInputs::Tick() const {
  std::int64_t complete = kAll;
  for (std::size_t p = 0; p < inputs_.size(); ++p) {
    std::int64_t& until = known_until_[p];
    while (inputs_[p].knows(until + 1)) ++until;
    complete = std::min(complete, until);
  }
  return complete;
}

}  // namespace seam
