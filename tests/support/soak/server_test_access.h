#pragma once
/// How much a server keeps waiting, and what it thinks concerns whom: for tests that watch it.

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
  /// How much a mechanism concerns a peer, as the server sees it.
  static Concern ConcernOf(const Server& server, int peer, int mechanism) {
    return server.broadcast_.ConcernOf(peer, mechanism);
  }
  static std::size_t WaitingEdits(const Server& server) { return server.edits_.waiting(); }
};

}  // namespace seam
