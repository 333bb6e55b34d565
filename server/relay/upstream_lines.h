#pragma once
/// The lines of seam-relay about its server, for people: one at each change.

#include <string>

#include "client/client.h"

namespace seam {

class UpstreamLines {
 public:
  /// Returns the line that is due, or "": that it has got in, has lost its server, or is sent on.
  std::string Next(const Client& client);

 private:
  enum class State { kOutside, kInside, kMoving };

  State state_ = State::kOutside;
  bool was_inside_ = false;
};

}  // namespace seam
