#include "common/measure/contents/log_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "common/measure/recorded_inputs.h"
#include "common/measure/revisions.h"
#include "common/sync/audit/spare_world.h"

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

/// Compares pairs of views in a spare world.
class ViewAudit {
 public:
  ViewAudit(const Recording& recording, const Scene& scene)
      : revisions_(scene, recording), inputs_(recording, scene) {}

  /// Compares two views, `from` the earlier one.
  void Compare(const View& from, const View& to, std::map<int, Gains>* gains) {
    const int key = revisions_.Key(from.revision);
    if (key != revisions_.Key(to.revision) || from.id != to.id) return;
    if (key != key_) {
      spare_ =
          std::make_unique<SpareWorld>(revisions_.At(key)->topology, SpareWorld::Present::kAll);
    }
    key_ = key;
    const World& world = spare_->world();
    if (static_cast<int>(from.id.size()) != world.body_count()) return;
    spare_->SetTick(from.tick);
    const auto mechanisms = static_cast<int>(world.composition().mechanisms.size());
    for (int m = 0; m < mechanisms; ++m) spare_->Put(m, Holder(m, from, to), StatesOf(m, from));
    while (world.tick() < to.tick) {
      spare_->Step([&](World* stepped) {
        for (const int player : inputs_.players()) {
          inputs_.Apply(stepped, player, stepped->tick() + 1);
        }
      });
    }
    for (int m = 0; m < mechanisms; ++m) {
      const std::vector<BodyState> told = StatesOf(m, to);
      const std::optional<Gain> gain = spare_->Compare(m, {told.begin(), told.end()});
      if (gain) Sum(*gain, Holder(m, from, to), gains);
    }
  }

 private:
  /// The client that held all of the mechanism in both views; 0: none.
  int Holder(int mechanism, const View& from, const View& to) const {
    int holder = 0;
    for (const int body : spare_->bodies(mechanism)) {
      const auto i = static_cast<std::size_t>(body);
      const bool keeps = from.authority[i] == to.authority[i];
      holder = keeps && from.authority[i] > 0 ? from.authority[i] : 0;
    }
    return holder;
  }

  std::vector<BodyState> StatesOf(int mechanism, const View& view) const {
    std::vector<BodyState> states;
    for (const int body : spare_->bodies(mechanism)) {
      states.push_back(StateIn(view, static_cast<std::size_t>(body)));
    }
    return states;
  }

  static void Sum(const Gain& gain, int holder, std::map<int, Gains>* gains) {
    const double speed = double{gain.stepped.norm()};
    if (speed < kAuditedSpeed) return;
    const double along = double{gain.velocity.dot(gain.stepped)} / speed;
    const double counts = std::clamp(along, -kGainMost, kGainMost);
    Gains& sums = (*gains)[holder];
    ++sums.count;
    sums.sum += counts;
    sums.squares += counts * counts;
    sums.largest = std::max(sums.largest, double{gain.velocity.norm()});
  }

  RevisionHistory revisions_;
  RecordedInputs inputs_;
  std::unique_ptr<SpareWorld> spare_;
  int key_ = -1;
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
  ViewAudit audit(recording, scene);
  std::map<int, Gains> gains;
  const auto found = recording.views.find(0);
  const auto length = static_cast<std::int64_t>(kWindowS * recording.room.tick_hz);
  for (std::int64_t tick = recording.first_tick;
       found != recording.views.end() && tick + length <= recording.last_tick; tick += length) {
    const View* const from = FindView(found->second, tick);
    const View* const to = FindView(found->second, tick + length);
    if (from != nullptr && to != nullptr) audit.Compare(*from, *to, &gains);
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
