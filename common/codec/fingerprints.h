#pragma once
/// The fingerprints of the LCM types: the first 8 bytes of a message, by which programs in any
/// language know its type.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

struct Fingerprint {
  std::string type;                   ///< "view_t"
  std::uint64_t hash = 0;             ///< as lcm-gen computes it from the type's file
  std::uint64_t without_session = 0;  ///< of the form that has no `session`; 0: there is none
};

/// Returns every type of lcmtypes, by name.
std::vector<Fingerprint> Fingerprints();

}  // namespace seam
