#pragma once
/// How much a server keeps waiting: for tests that watch that nothing grows.

#include <algorithm>

#include "server/server.h"

namespace seam {

struct ServerTestAccess {
  /// Reliable messages that wait, of the session that has most of them.
  static std::size_t WaitingOfLinks(Server& server) {
    std::size_t most = 0;
    server.sessions_.ForEachReady(
        0, [&](const Session& session) { most = std::max(most, session.link.waiting()); });
    return most;
  }
  static const AuthorityManager& Authority(const Server& server) { return server.authority_; }
  static std::size_t WaitingEdits(const Server& server) { return server.edits_.waiting(); }
};

}  // namespace seam
