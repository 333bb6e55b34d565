#pragma once
/// Whom a room lets in: anybody, or only those with the operator's connect tokens.

#include <memory>
#include <string>

#include "common/net/seal.h"

namespace seam {

struct TokenDoor {
  std::shared_ptr<const Secret> key;  ///< the operator's; nullptr: anybody comes in, without token
  std::string room;                   ///< for which the tokens must be
};

}  // namespace seam
