#pragma once
/// Rest where the copies of one body differ from peer to peer: mode strict, and the reconcilers
/// that correct copies. A copy that is corrected pushes what touches it, so the engine's word alone
/// is not trusted.
///
/// A held body does not wake from a small disturbance. It wakes when its speed exceeds kWakeShare
/// times the engine's sleep threshold for some ticks in a row, or from an impact, an edit or an
/// input. If an island has several owners, the engine may never let them sleep. A peer then commits
/// its own bodies once they have lain still, whatever the copies do; if that fails, the lowest peer
/// commits, and finally every peer.

#include <memory>
#include <vector>

#include "common/sync/inputs/input_track.h"
#include "common/sync/reach/driven.h"
#include "common/sync/rest/rest_commit.h"

namespace seam {

class DistrustedRest : public RestCommit {
 public:
  /// As RestCommit. `inputs`: by player.
  DistrustedRest(const SyncConfig& config, World& world, const Roles& roles, const Drivers& drivers,
                 BodyMemory& memory, Display& display, const std::vector<InputTrack>& inputs,
                 const Reach& reach)
      : RestCommit(config, world, roles, memory, display, reach),
        self_(roles.self()),
        send_every_(config.send_every()),
        drivers_(drivers),
        inputs_(inputs) {}

 protected:
  void Prepare() override;
  bool IsDisturbed(int body) const override;
  /// An own body touched only by own bodies stays awake: no other peer's word is needed. Where all
  /// bodies are held and have several owners, the engine wakes bodies that lean on slightly
  /// displaced copies in every step; these count as pushes.
  void HoldIsland(const std::vector<int>& island) override;
  bool MayCommitAwake(const std::vector<int>& island, const std::vector<int>& own) const override;
  double BackAfter() const override;

 private:
  bool Driven(int body) const { return driven_[static_cast<std::size_t>(world().mechanism(body))]; }
  bool ExceedsWakeLimit(int body);

  const int self_;
  const int send_every_;
  const Drivers& drivers_;
  const std::vector<InputTrack>& inputs_;
  std::vector<bool> driven_;  // scratch, by mechanism: an input moves it
};

/// Makes the RestCommit of the room's mode. See DistrustedRest.
std::unique_ptr<RestCommit> MakeRestCommit(const SyncConfig& config, World& world,
                                           const Roles& roles, const Drivers& drivers,
                                           BodyMemory& memory, Display& display,
                                           const std::vector<InputTrack>& inputs,
                                           const Reach& reach);

}  // namespace seam
