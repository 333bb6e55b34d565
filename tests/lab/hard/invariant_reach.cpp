#include <algorithm>
#include <cmath>

#include "tests/lab/hard/invariant_judges.h"

namespace seam {
namespace {

using Point = Eigen::Vector2d;

/// A joint's place on one of its two bodies. Places of one body are as far apart as at tick 0; the
/// two places of a joint are at one point, or a rigid distance joint's length apart.
struct Place {
  int assembly = 0;
  Point at{0, 0};          ///< m, world, tick 0
  std::size_t across = 0;  ///< the joint's other place
  double across_m = 0;
  double way_m = kNoLimit;  ///< from the anchored place `root`
  Point root{0, 0};
};

/// Farthest that a body's position may be from `root`.
struct Leash {
  std::size_t body = 0;
  Point root{0, 0};
  double reach_m = 0;
};

std::vector<Place> Places(const Scene& scene, const Composition& composition) {
  std::vector<Place> places;
  for (const Joint& joint : scene.joints) {
    // A spring may stretch.
    if (joint.frequency_hz > 0) continue;
    const auto assembly = [&](PartId part) {
      return composition.assembly_of_part[static_cast<std::size_t>(part)];
    };
    if (assembly(joint.a) == assembly(joint.b)) continue;
    Place a, b;
    a.assembly = assembly(joint.a);
    b.assembly = assembly(joint.b);
    a.at = joint.anchor_a.cast<double>();
    b.at = joint.anchor_b.cast<double>();
    a.across_m = joint.length > 0 ? static_cast<double>(joint.length) : (a.at - b.at).norm();
    b.across_m = a.across_m;
    a.across = places.size() + 1;
    b.across = places.size();
    places.push_back(a);
    places.push_back(b);
  }
  return places;
}

/// Shortest ways from all anchored places at once, by relaxing until nothing gets shorter.
void FindWays(const Composition& composition, std::vector<Place>* places) {
  std::vector<std::vector<std::size_t>> of_assembly(composition.assemblies.size());
  for (std::size_t i = 0; i < places->size(); ++i) {
    Place& place = (*places)[i];
    of_assembly[static_cast<std::size_t>(place.assembly)].push_back(i);
    if (!composition.assemblies[static_cast<std::size_t>(place.assembly)].anchored) continue;
    place.way_m = 0;
    place.root = place.at;
  }
  const auto shorten = [&](const Place& from, double step, Place* to) {
    if (from.way_m + step >= to->way_m) return false;
    to->way_m = from.way_m + step;
    to->root = from.root;
    return true;
  };
  bool shorter = true;
  // Each round settles at least one more place.
  for (std::size_t round = 0; shorter && round <= places->size(); ++round) {
    shorter = false;
    for (Place& place : *places) {
      if (shorten(place, place.across_m, &(*places)[place.across])) shorter = true;
      for (const std::size_t other : of_assembly[static_cast<std::size_t>(place.assembly)]) {
        Place& to = (*places)[other];
        if (shorten(place, (place.at - to.at).norm(), &to)) shorter = true;
      }
    }
  }
}

std::vector<Leash> Leashes(const Scene& scene) {
  const Composition composition = Compose(scene);
  std::vector<Place> places = Places(scene, composition);
  FindWays(composition, &places);
  std::vector<Leash> leashes;
  std::size_t body = 0;
  for (std::size_t i = 0; i < composition.assemblies.size(); ++i) {
    const Assembly& assembly = composition.assemblies[i];
    if (assembly.anchored) continue;
    const Vec2& root = scene.parts[static_cast<std::size_t>(assembly.id)].position;
    Leash leash;
    leash.body = body++;
    leash.reach_m = kNoLimit;
    for (const Place& place : places) {
      if (place.assembly != static_cast<int>(i)) continue;
      const double reach = place.way_m + (root.cast<double>() - place.at).norm();
      if (reach >= leash.reach_m) continue;
      leash.reach_m = reach;
      leash.root = place.root;
    }
    if (leash.reach_m < kNoLimit) leashes.push_back(leash);
  }
  return leashes;
}

class ReachJudge final : public Watch {
 public:
  ReachJudge(const WatchLimits& limits, double tear_m, const Scene& scene)
      : Watch(limits), tear_m_(tear_m), leashes_(Leashes(scene)) {}

 protected:
  void Look(const World&, double t) override {
    for (const Leash& leash : leashes_) {
      const Point at = states()[leash.body].position.cast<double>();
      worst_m_ = std::max(worst_m_, (at - leash.root).norm() - leash.reach_m);
    }
    if (worst_m_ > tear_m_) Fail("came apart", t);
  }
  double Value() const override { return worst_m_; }

 private:
  const double tear_m_;
  const std::vector<Leash> leashes_;
  double worst_m_ = 0;
};

}  // namespace

std::unique_ptr<Judge> MakeReachJudge(const WatchLimits& limits, double tear_m,
                                      const Scene& scene) {
  return std::make_unique<ReachJudge>(limits, tear_m, scene);
}

}  // namespace seam
