#include "common/measure/contents/log_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "common/measure/recorded_inputs.h"
#include "common/measure/revisions.h"
#include "common/physics/world.h"

namespace seam {
namespace {

/// Slower than this a mechanism has no direction, m/s.
constexpr double kAuditedSpeed = 0.5;
/// Greatest gain of one window that counts, m/s: chaos, and inputs that came late, make a few that
/// are great.
constexpr double kGainMost = 0.05;

/// Sums of the gains of one peer's mechanisms, m/s.
struct Gains {
  int count = 0;
  double sum = 0, squares = 0, largest = 0;
};

/// A world that is put to one view after another.
class SpareWorld {
 public:
  SpareWorld(const Recording& recording, const Scene& scene)
      : revisions_(scene, recording), inputs_(recording, scene) {}

  /// Compares two views, `from` the earlier one.
  void Compare(const View& from, const View& to, std::map<int, Gains>* gains) {
    const int key = revisions_.Key(from.revision);
    if (key != revisions_.Key(to.revision) || from.id != to.id) return;
    if (key != key_) world_ = std::make_unique<World>(revisions_.At(key)->topology);
    key_ = key;
    if (static_cast<int>(from.id.size()) != world_->body_count()) return;
    world_->SetTick(from.tick);
    for (int body = 0; body < world_->body_count(); ++body) {
      world_->Write(body, StateIn(from, static_cast<std::size_t>(body)));
    }
    holders_.assign(world_->composition().mechanisms.size(), -1);
    for (std::size_t i = 0; i < from.id.size(); ++i) {
      int& holder = holders_[static_cast<std::size_t>(world_->mechanism(static_cast<int>(i)))];
      const bool keeps = from.authority[i] == to.authority[i];
      holder = keeps && from.authority[i] > 0 ? from.authority[i] : -1;
    }
    const std::vector<int> held = holders_;
    while (world_->tick() < to.tick) {
      for (const int player : inputs_.players()) {
        inputs_.Apply(world_.get(), player, world_->tick() + 1);
      }
      world_->Step();
      for (const Touch& touch : world_->touches()) Meet(held, touch);
    }
    Sum(to, gains);
  }

 private:
  /// Drops mechanisms that touch what another peer or the server holds.
  void Meet(const std::vector<int>& held, const Touch& touch) {
    const auto a = static_cast<std::size_t>(world_->mechanism(touch.body_a));
    const auto b = static_cast<std::size_t>(world_->mechanism(touch.body_b));
    if (held[a] == held[b] && holders_[a] == holders_[b]) return;
    holders_[a] = holders_[b] = -1;
  }

  void Sum(const View& to, std::map<int, Gains>* gains) {
    struct Momentum {
      Vec2 is{0, 0}, would_be{0, 0};
      float mass = 0;
    };
    std::vector<Momentum> all(holders_.size());
    for (int body = 0; body < world_->body_count(); ++body) {
      Momentum& of = all[static_cast<std::size_t>(world_->mechanism(body))];
      const float mass = world_->mass(body);
      of.is += mass * StateIn(to, static_cast<std::size_t>(body)).velocity;
      of.would_be += mass * world_->Read(body).velocity;
      of.mass += mass;
    }
    for (std::size_t m = 0; m < all.size(); ++m) {
      if (holders_[m] < 0 || all[m].mass <= 0) continue;
      const Vec2 is = all[m].is / all[m].mass, would_be = all[m].would_be / all[m].mass;
      const double speed = would_be.norm();
      if (speed < kAuditedSpeed) continue;
      const double gain = static_cast<double>((is - would_be).dot(would_be)) / speed;
      const double counts = std::clamp(gain, -kGainMost, kGainMost);
      Gains& sums = (*gains)[holders_[m]];
      ++sums.count;
      sums.sum += counts;
      sums.squares += counts * counts;
      sums.largest = std::max(sums.largest, static_cast<double>((is - would_be).norm()));
    }
  }

  RevisionHistory revisions_;
  RecordedInputs inputs_;
  std::unique_ptr<World> world_;
  int key_ = -1;
  std::vector<int> holders_;  // by mechanism, in this window; -1: not to be compared
};

int PlayerInSum(const Recording& recording, int peer) {
  if (recording.summaries.empty()) return -1;
  const Summary& sum = recording.summaries.back();
  for (std::size_t i = 0; i < sum.peer.size(); ++i) {
    if (sum.peer[i] == peer) return sum.player[i];
  }
  return -1;
}

}  // namespace

bool AuditedPeer::lies() const {
  const double gain = std::fabs(gain_mps2);
  return windows >= kWindowsMin && gain > kErrors * error_mps2 && gain > kGainMin;
}

std::vector<AuditedPeer> AuditRecording(const Recording& recording) {
  const Scene scene = RecordedScene(recording.room);
  SpareWorld spare(recording, scene);
  std::map<int, Gains> gains;
  const auto found = recording.views.find(0);
  const auto length = static_cast<std::int64_t>(kWindowS * recording.room.tick_hz);
  for (std::int64_t tick = recording.first_tick;
       found != recording.views.end() && tick + length <= recording.last_tick; tick += length) {
    const View* const from = FindView(found->second, tick);
    const View* const to = FindView(found->second, tick + length);
    if (from != nullptr && to != nullptr) spare.Compare(*from, *to, &gains);
  }
  std::vector<AuditedPeer> peers;
  for (const auto& [peer, sums] : gains) {
    const double mean = sums.sum / sums.count;
    const double variance = std::max(0.0, sums.squares / sums.count - mean * mean);
    AuditedPeer audited;
    audited.peer = peer;
    audited.player = PlayerInSum(recording, peer);
    audited.windows = sums.count;
    audited.gain_mps2 = mean / kWindowS;
    audited.error_mps2 = std::sqrt(variance / sums.count) / kWindowS;
    audited.largest_mps = sums.largest;
    peers.push_back(audited);
  }
  return peers;
}

std::string FormatAudit(const std::vector<AuditedPeer>& peers, const Recording& recording) {
  if (peers.empty()) {
    return recording.room.mode == "buffer"
               ? "nothing to compare: nobody but the server simulated anything for long enough\n"
               : "nothing to compare: in mode " + recording.room.mode +
                     " only the server simulates\n";
  }
  const Scene scene = RecordedScene(recording.room);
  std::string text = "  peer  player        windows  gain m/s2  +- m/s2  largest m/s  verdict\n";
  for (const AuditedPeer& p : peers) {
    const auto player = static_cast<std::size_t>(p.player);
    const bool known = p.player >= 0 && player < scene.players.size();
    text += fmt::format("{:>6}  {:<12} {:>8}  {:>9.3f}  {:>7.3f}  {:>11.3f}  {}\n", p.peer,
                        known ? scene.players[player].name : "?", p.windows, p.gain_mps2,
                        p.error_mps2, p.largest_mps, p.lies() ? "lies" : "");
  }
  return text;
}

}  // namespace seam
