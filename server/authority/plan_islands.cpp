#include "server/authority/plan_islands.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>

#include "common/sync/reach/box_grid.h"
#include "server/authority/box_sweep.h"
#include "server/authority/dwell.h"
#include "server/authority/islands.h"
#include "server/authority/plan_capacity.h"
#include "server/authority/swept_boxes.h"

namespace seam {
namespace {

class IslandPlan {
 public:
  IslandPlan(const PlanGround& ground, AuthorityPlan* plan)
      : ground_(ground),
        view_(ground.view()),
        plan_(*plan),
        players_(view_),
        islands_(ground, players_),
        open_(OpenBoxes()),
        grid_(view_.boxes, &open_) {
    near_player_.assign(view_.mechanisms.size(), -1);
    near_gap_.assign(view_.mechanisms.size(), FLT_MAX);
    for (const MovingBox& box : view_.boxes) speed_ = std::max(speed_, box.velocity.norm());
  }

  void Plan() {
    LookAround();
    for (std::size_t i = 0; i < islands_.all().size(); ++i) Decide(static_cast<int>(i));
    LimitToCapacity(view_, players_, islands_, &plan_);
  }

 private:
  const PlayerView& player(int p) const { return view_.players[static_cast<std::size_t>(p)]; }
  int PeerOf(int p) const { return p < 0 ? 0 : player(p).peer; }

  /// Returns by box: 0 if its island already has an authority regardless of distances and contacts.
  std::vector<char> OpenBoxes() {
    const bool limited = std::any_of(view_.players.begin(), view_.players.end(),
                                     [](const PlayerView& p) { return p.limited(); });
    std::vector<char> open(view_.boxes.size(), 1);
    for (std::size_t i = 0; i < open.size() && !limited; ++i) {
      const Island& island = islands_.Of(view_.boxes[i].group);
      const bool decided = island.driver >= 0 && (!island.disputed || island.Merges());
      if (decided) open[i] = 0;
    }
    return open;
  }

  /// Finds for each vehicle the islands it will touch, and the mechanisms near it.
  void LookAround() {
    const std::vector<MovingBox> around = islands_.VehicleBoxes(view_);
    for (const MovingBox& vehicle : around) {
      const int p = islands_.driver(vehicle.group);
      if (!player(p).silent) LookNear(vehicle, p);
    }
    const BoxClusters& clusters = ground_.clusters();
    for (std::size_t c = 0; c < clusters.count(); ++c) {
      const int p = islands_.driver(clusters.GroupOf(c));
      if (p >= 0 && !player(p).silent) LookAhead(c, p);
      if (p < 0) clusters.Each(c, [&](std::size_t i) { ClaimForUndriven(view_.boxes[i]); });
    }
  }

  /// Claims for the holder of a moving mechanism without driver the sleeping islands it will hit.
  void ClaimForUndriven(const MovingBox& box) {
    const MechanismView& mechanism = view_.mechanisms[static_cast<std::size_t>(box.group)];
    const int p = players_.At(mechanism.now.authority);
    if (p < 0 || !mechanism.moves || player(p).silent) return;
    const float ahead = LookAheadSeconds(p, box), way = box.velocity.norm() * ahead + kTouchGap;
    const Vec2 reach(way, way);
    grid_.Near(box.min - reach, box.max + reach, [&](int b) {
      const MovingBox& other = view_.boxes[static_cast<std::size_t>(b)];
      Island& island = islands_.Of(other.group);
      if (!island.awake && island.driver < 0) Claim(box, ahead, other, p, &island);
    });
  }

  void LookNear(const MovingBox& vehicle, int p) {
    const Vec2 keep(view_.rules.keep, view_.rules.keep);
    grid_.Near(vehicle.min - keep, vehicle.max + keep, [&](int b) {
      const MovingBox& box = view_.boxes[static_cast<std::size_t>(b)];
      const auto m = static_cast<std::size_t>(box.group);
      const float gap = Gap(box, vehicle);
      const bool nearer = gap < near_gap_[m] ||
                          (gap == near_gap_[m] && near_player_[m] >= 0 && p < near_player_[m]);
      if (nearer) {
        near_gap_[m] = gap;
        near_player_[m] = p;
      }
      Island& island = islands_.Of(box.group);
      if (p == island.holder) {
        island.holder_gap = std::min(island.holder_gap, gap);
        if (!island.awake && !island.holder_keeps) {
          const float seconds = LookAheadSeconds(p, vehicle) + kTouchKeep;
          island.holder_keeps = SecondsToTouch(vehicle, box, kTouchGap, seconds) != FLT_MAX;
        }
      }
      if (gap < island.nearest_gap || (gap == island.nearest_gap && p < island.nearest)) {
        island.nearest_gap = gap;
        island.nearest = p;
      }
    });
  }

  /// Returns the look-ahead within which player p's peer must get what `own` will touch, s. Shorter
  /// for standing vehicles: these may be driven in any direction.
  float LookAheadSeconds(int p, const MovingBox& own) const {
    const float ahead = own.velocity.norm() > kSettles ? kTouchAhead : kStandingAhead;
    return 2 * player(p).one_way_s + kPlanPeriod + ahead;
  }

  /// Claims the island for player p if it will touch within `ahead` s, see LookAheadSeconds.
  static void Claim(const MovingBox& own, float ahead, const MovingBox& other, int p,
                    Island* island) {
    const float after = SecondsToTouch(own, other, kTouchGap, ahead);
    if (after == FLT_MAX) return;
    if (p == island->holder) island->holder_claims = true;
    if (after < island->claim_s || (after == island->claim_s && p < island->claim)) {
      island->claim_s = after;
      island->claim = p;
    }
  }

  /// Claims the islands that the boxes of a cluster, driven by player p, will touch.
  void LookAhead(std::size_t cluster, int p) {
    const BoxClusters& clusters = ground_.clusters();
    std::array<float, BoxClusters::kMost> ahead{};  // by box of the cluster, s
    float way = 0, own_way = 0, longest = 0;
    clusters.Each(cluster, [&](std::size_t i) {
      const MovingBox& own = view_.boxes[i];
      const float seconds = LookAheadSeconds(p, own);
      ahead[i - clusters.begin(cluster)] = seconds;
      const float speeds = own.velocity.norm() + std::min(speed_, kApproachMax);
      const float more = kTouchGap + own.acceleration * seconds * seconds / 2;
      way = std::max(way, speeds * seconds + more);
      own_way = std::max(own_way, own.velocity.norm() * seconds + more);
      longest = std::max(longest, seconds);
    });
    const MovingBox& around = clusters.around()[cluster];
    const Vec2 reach(way, way);
    grid_.Near(around.min - reach, around.max + reach, [&](int b) {
      const MovingBox& box = view_.boxes[static_cast<std::size_t>(b)];
      Island& island = islands_.Of(box.group);
      if (island.driver >= 0) return;  // an island with a driver belongs to the driver
      const float speed = std::max(std::fabs(box.velocity.x()), std::fabs(box.velocity.y()));
      const float other_way = (speed + box.acceleration * longest / 2) * longest + kPairRounding;
      const Vec2 apart = (around.min - box.max).cwiseMax(box.min - around.max);
      if (std::max(apart.x(), apart.y()) > own_way + other_way) return;
      clusters.Each(cluster, [&](std::size_t i) {
        Claim(view_.boxes[i], ahead[i - clusters.begin(cluster)], box, p, &island);
      });
    });
  }

  /// True if a sleeping island stays with its holder. A silent holder loses nothing: it reports
  /// little about sleeping bodies anyway.
  bool KeepsAsleep(const Island& island) const {
    return island.holder >= 0 && (island.holder_keeps || player(island.holder).silent);
  }

  /// Returns the player for the bodies without driver of an island; -1: the server.
  int Choose(const Island& island) const {
    if (island.driver >= 0) {
      if (!island.disputed) return island.driver;
      const bool within = islands_.Drives(island.holder, island);
      return within ? island.holder : island.driver;
    }
    if (island.claim >= 0) return island.holder_claims ? island.holder : island.claim;
    if (!island.awake) return KeepsAsleep(island) ? island.holder : -1;
    if (island.holder >= 0 && island.holder_gap <= view_.rules.keep) return island.holder;
    return island.nearest_gap <= view_.rules.acquire ? island.nearest : -1;
  }

  void Decide(int index) {
    const Island& island = islands_.all()[static_cast<std::size_t>(index)];
    const int chosen = Choose(island);
    const bool stays = island.disputed && !island.Merges();
    for (const int m : islands_.MembersOf(index)) {
      const MechanismView& mechanism = view_.mechanisms[static_cast<std::size_t>(m)];
      int& authority = plan_[static_cast<std::size_t>(m)].authority;
      const int driver = islands_.driver(m);
      const int current = players_.At(mechanism.now.authority);
      if (Dwells(view_, players_, mechanism) || (driver < 0 && stays && current >= 0)) {
        authority = mechanism.now.authority;
      } else if (driver >= 0) {
        authority = PeerOf(driver);
      } else if (stays && near_player_[static_cast<std::size_t>(m)] >= 0) {
        authority = PeerOf(near_player_[static_cast<std::size_t>(m)]);
      } else {
        authority = PeerOf(chosen);
      }
    }
  }

  const PlanGround& ground_;
  const AuthorityView& view_;
  AuthorityPlan& plan_;
  const PlayerOfPeer players_;
  Islands islands_;
  const std::vector<char> open_;  // by box
  const BoxGrid grid_;            // of the open boxes
  float speed_ = 0;               // of the fastest box, m/s
  std::vector<int> near_player_;  // by mechanism: player of the nearest vehicle, within rules.keep
  std::vector<float> near_gap_;   // m
};

}  // namespace

void PlanIslands(const PlanGround& ground, AuthorityPlan* plan) { IslandPlan(ground, plan).Plan(); }

}  // namespace seam
