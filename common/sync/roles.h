#pragma once
/// This peer's role for each mechanism: authority, secondary or remote. Only this class decides it.

#include <cstdint>
#include <vector>

#include "common/physics/world.h"
#include "common/sync/authority.h"
#include "common/sync/mode.h"
#include "common/sync/peer_set.h"

namespace seam {

/// Effects of a Grants message on a peer.
struct GrantsApplied {
  std::vector<int> let_go;  ///< mechanisms that the peer held and no longer holds
  std::vector<int> roles;   ///< mechanisms in which its role changed
};

class Roles {
 public:
  /// `self`: peer number. `own_player`: the player whose vehicle this peer predicts in mode
  /// central, or -1. Config, world and the table of its bodies must outlive this.
  Roles(const SyncConfig& config, int self, int own_player, const World& world,
        const BodyTable& bodies);

  int self() const { return self_; }
  int own_player() const { return own_player_; }
  const AuthorityTable& table() const { return table_; }
  AuthorityTable& table() { return table_; }

  /// Returns this peer's kRoleAuthority, kRoleSecondary or kRoleRemote for a mechanism.
  std::int8_t RoleOf(int mechanism) const;
  /// Returns the role for the mechanism of a body.
  std::int8_t RoleOfBody(int body) const { return RoleOf(world_.mechanism(body)); }
  /// True if this peer simulates the body; otherwise it only displays it.
  bool Simulates(int body) const { return RoleOfBody(body) != kRoleRemote; }
  /// True if the table names this peer, in any mode.
  bool IsAuthority(int mechanism) const { return table_.at(mechanism).authority == self_; }
  /// Sets the holders that have fallen silent. For mechanisms that it follows, the server sends
  /// states in their names.
  void SetSilentHolders(const PeerSet& silent) { silent_ = silent; }
  /// True if this peer may send states of a mechanism in its silent holder's name.
  bool SpeaksForHolder(int mechanism) const {
    const AuthorityRecord& record = table_.at(mechanism);
    return silent_.Has(record.authority) && record.secondaries.Has(self_);
  }
  /// True if the own player drives a mechanism.
  bool Drives(int mechanism) const { return Own()[static_cast<std::size_t>(mechanism)]; }
  /// True if another peer simulates any awake body that this peer simulates; always true outside
  /// mode buffer.
  bool Shares() const;
  /// True if a peer that simulates the mechanism comes to its authority's states by itself
  /// (Policy::CopiesAgree). A character's step and way to a seat are not in its states, so that a
  /// peer which begins to simulate it does not.
  bool CopiesAgree(int mechanism) const;
  /// True if a client has authority and every peer simulates the mechanism, so that the authority
  /// sends it only kRefreshHz times a second. Not where rules look at each state at the server.
  bool RefreshesOnly(int mechanism) const;
  /// True if this peer is to propose an edit found by physics: the authority of the first affected
  /// part in a mechanism, or with rollback the server if it follows that mechanism. Of anchored
  /// parts: the server, or each peer where the server does not feel all impacts.
  bool Proposes(const Edit& edit) const;
  /// True if this peer is to tell of a touch of the two parts, by the same rule.
  bool Tells(const PartTouch& touch) const;

  /// Applies a message.
  GrantsApplied Apply(const Grants& grants);
  /// Returns all authority of this peer to the server.
  void ReleaseAll();

 private:
  /// True if the mechanism's changes are this peer's to find: it has authority, or with rollback it
  /// is the server and follows the mechanism.
  bool Finds(int mechanism) const;
  /// By mechanism: true if the own player drives it.
  const std::vector<bool>& Own() const;

  const SyncConfig& config_;
  int self_;
  int own_player_;
  const World& world_;
  AuthorityTable table_;
  PeerSet silent_;
  mutable std::vector<bool> own_;  // rebuilt for each revision, by mechanism
  mutable int own_of_revision_ = -1;
  void LookAtScene() const;
  // Looked up for each revision.
  mutable bool has_rules_ = false;
  mutable std::vector<bool> characters_;  // rebuilt, by mechanism: has a character
  mutable int looked_at_revision_ = -1;
};

}  // namespace seam
