#pragma once
/// Amount of its view that a peer publishes; views are most of the bus traffic.

#include <string>

#include "common/base/check.h"

namespace seam {

enum class Publish {
  kAuto,  ///< kAll in a room of at most kPublishAllMost bodies, kOwn in a larger one
  kAll,   ///< every body as displayed at every tick; strands and impacts
  kOwn,   ///< only bodies that the peer simulates, as authority or follower
  kNone,  ///< no views, strands and impacts
};
constexpr int kPublishAllMost = 64;

/// Parses "auto", "all", "own" or "none". Throws OperatorError that names them.
inline Publish ParsePublish(const std::string& name) {
  if (name == "auto") return Publish::kAuto;
  if (name == "all") return Publish::kAll;
  if (name == "own") return Publish::kOwn;
  if (name == "none") return Publish::kNone;
  throw OperatorError("--publish takes auto, all, own or none, not \"" + name + "\"");
}

/// Resolves kAuto for a room of so many bodies.
inline Publish Resolved(Publish publish, int bodies) {
  if (publish != Publish::kAuto) return publish;
  return bodies <= kPublishAllMost ? Publish::kAll : Publish::kOwn;
}

}  // namespace seam
