#pragma once
/// A server of a fleet, as a directory has it.

#include <string>

#include "common/codec/messages.h"
#include "common/fleet/directory.h"

namespace seam {

/// `id` must not be empty.
inline FleetServer ServerOf(const std::string& id) {
  FleetServer server;
  server.id = id;
  server.address = "127.0.0.1:" + std::to_string(7000 + id.back());
  server.version = "0.27.0";
  server.protocol = kProtocolVersion;
  server.capacity = 8;
  return server;
}

}  // namespace seam
