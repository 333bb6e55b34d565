#pragma once
/// What this peer is to each mechanism: its authority, a secondary or remote. Only this class says.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/mode.h"
#include "common/sync/peer_set.h"

namespace seam {

/// What a message of grants has changed for a peer.
struct GrantsApplied {
  std::vector<int> let_go;  ///< mechanisms that it had and has no longer
  std::vector<int> roles;   ///< mechanisms in which its role is another
};

class Roles {
 public:
  /// `self`: peer number. `own_player`: the player whose vehicle this peer predicts in mode
  /// central, or -1. Config and world must outlive this.
  Roles(const SyncConfig& config, int self, int own_player, const World& world);

  int self() const { return self_; }
  int own_player() const { return own_player_; }
  const AuthorityTable& table() const { return table_; }
  AuthorityTable& table() { return table_; }

  /// kRoleAuthority, kRoleSecondary or kRoleRemote of this peer for a mechanism.
  std::int8_t RoleOf(int mechanism) const;
  /// The same for the mechanism of a body.
  std::int8_t RoleOfBody(int body) const { return RoleOf(world_.mechanism(body)); }
  /// Whether this peer steps the body itself; else it only displays it.
  bool Simulates(int body) const { return RoleOfBody(body) != kRoleRemote; }
  /// Whether the table names this peer, in any mode.
  bool IsAuthority(int mechanism) const { return table_.at(mechanism).authority == self_; }
  /// Holders that have fallen silent: the server, while it follows what they have, says in their
  /// names where that is.
  void SpeakFor(const PeerSet& silent) { silent_ = silent; }
  /// Whether this peer may say, in a silent holder's name, where a mechanism's bodies are.
  bool StandsIn(int mechanism) const {
    const AuthorityRecord& record = table_.at(mechanism);
    return silent_.Has(record.authority) && record.secondaries.Has(self_);
  }
  /// Whether another peer steps any of the bodies that are awake here and that this one steps.
  bool Shares() const;
  /// Whether this peer is to propose an edit that physics found: the authority of the first part
  /// concerned that is in a mechanism; in mode oracle every peer.
  bool Proposes(const Edit& edit) const;

  /// Takes over a message.
  GrantsApplied Apply(const Grants& grants);
  /// Gives all that this peer has back to the server.
  void ReleaseAll();
  /// The mechanisms have changed; `from` as in BodyRemap::mechanisms.
  void Remap(const std::vector<std::vector<int>>& from);

 private:
  /// By mechanism: what the own player drives.
  const std::vector<bool>& Own() const;

  const SyncConfig& config_;
  int self_;
  int own_player_;
  const World& world_;
  AuthorityTable table_;
  PeerSet silent_;
  mutable std::vector<bool> own_;  // as of that revision
  mutable int own_of_revision_ = -1;
};

}  // namespace seam
