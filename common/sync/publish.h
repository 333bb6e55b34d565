#pragma once
/// How much of what a peer shows it publishes: views are most of what is on the bus.

#include <string>

#include "common/base/check.h"

namespace seam {

enum class Publish {
  kAuto,  ///< all in a room of at most kPublishAllMost bodies, own in a larger one
  kAll,   ///< every body, as shown at every tick; strands and impacts
  kOwn,   ///< of bodies those that the peer simulates: what it has authority over or follows
  kNone,  ///< no views, strands and impacts
};
constexpr int kPublishAllMost = 64;

/// "auto", "all", "own", "none". Throws OperatorError naming them.
inline Publish ParsePublish(const std::string& name) {
  if (name == "auto") return Publish::kAuto;
  if (name == "all") return Publish::kAll;
  if (name == "own") return Publish::kOwn;
  if (name == "none") return Publish::kNone;
  throw OperatorError("--publish takes auto, all, own or none, not \"" + name + "\"");
}

/// What is meant in a room of so many bodies: not kAuto.
inline Publish Resolved(Publish publish, int bodies) {
  if (publish != Publish::kAuto) return publish;
  return bodies <= kPublishAllMost ? Publish::kAll : Publish::kOwn;
}

}  // namespace seam
