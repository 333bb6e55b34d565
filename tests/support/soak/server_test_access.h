#pragma once
/// Access to a server's queue lengths and relevances, for tests that watch it.

#include <algorithm>

#include "server/authority_source.h"
#include "server/server.h"

namespace seam {

struct ServerTestAccess {
  /// Returns the largest number of unacknowledged reliable messages of a session.
  static std::size_t WaitingOfLinks(Server& server) {
    std::size_t most = 0;
    server.sessions_.ForEachReady(
        0, [&](const Session& session) { most = std::max(most, session.link.waiting()); });
    return most;
  }
  static const AuthorityManager& Authority(const Server& server) { return server.authority_; }
  /// Returns the relevance of a mechanism to a peer, as the server has it.
  static Relevance RelevanceOf(const Server& server, int peer, int mechanism) {
    return server.broadcast_.RelevanceOf(peer, mechanism);
  }
  static Replica& ReplicaOf(Server& server) { return server.replica_; }
  static AuthorityManager& ManagerOf(Server& server) { return server.authority_; }
  /// Returns the input of the room's rules; nullptr if the scene has none.
  static const AuthoritySource* RuleSourceOf(const Server& server) {
    return server.rule_source_.get();
  }
  static const Plausible& PlausibleOf(const Server& server) { return server.filter_.plausible(); }
  /// Returns nullptr if nothing is audited.
  static const Auditor* AuditorOf(const Server& server) { return server.auditor_.get(); }
  static std::size_t WaitingEdits(const Server& server) { return server.edits_->waiting(); }
};

}  // namespace seam
