#pragma once
/// Decides who may join a room: anybody, or only those with the operator's connect tokens.

#include <cstdint>
#include <memory>
#include <string>

#include "common/net/seal.h"

namespace seam {

struct TokenDoor {
  std::shared_ptr<const Secret> key;  ///< the operator's; nullptr: anybody comes in, without token
  std::string room;                   ///< for which the tokens must be; "": the join's room
  std::int32_t epoch = 1;             ///< of the room
};

}  // namespace seam
