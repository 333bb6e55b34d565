/// Things that should keep their shape: a hanging chain, one with a heavy end, a welded beam.

#include <cmath>

#include "common/base/geometry.h"
#include "tests/lab/hard/exact_judge.h"

namespace seam {
namespace {

/// A point of the world at tick 0 that moves with a body whose root is `root`.
Eigen::Vector2d Carried(const World& world, int body, const Part& root, const Vec2& at) {
  const BodyState state = world.Read(body);
  const double turn = static_cast<double>(state.angle) - static_cast<double>(root.angle);
  const Eigen::Vector2d arm = (at - root.position).cast<double>();
  return state.position.cast<double>() + Turned(arm, turn);
}

/// n equal rigid links between two hinges of one height. The tension's horizontal part is the same
/// everywhere and its vertical part changes by a link's weight from one to the next, so
/// tan(phi_i) = c (i - (n - 1)/2), with the one c that makes sum L cos(phi_i) the span.
std::vector<Eigen::Vector2d> HangingChain(const Eigen::Vector2d& from, double span, double length,
                                          int n) {
  const auto slope = [&](double c, int i) { return c * (i - (n - 1) / 2.0); };
  double low = 0, high = 1e6;
  for (int round = 0; round < 200; ++round) {
    const double c = (low + high) / 2;
    double reach = 0;
    for (int i = 0; i < n; ++i) reach += length / std::hypot(1.0, slope(c, i));
    (reach > span ? low : high) = c;
  }
  std::vector<Eigen::Vector2d> centres;
  Eigen::Vector2d hinge = from;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d link =
        length / std::hypot(1.0, slope(low, i)) * Eigen::Vector2d(1, slope(low, i));
    centres.push_back(hinge + link / 2);
    hinge += link;
  }
  return centres;
}

/// The links are the moving parts, from left to right, as boxes of the hinges' distance.
std::unique_ptr<Judge> Catenary(const Scene& scene) {
  const Eigen::Vector2d from = scene.joints.front().anchor_a.cast<double>();
  const Eigen::Vector2d to = scene.joints.back().anchor_a.cast<double>();
  const Part& link = scene.parts[static_cast<std::size_t>(scene.joints.front().b)];
  const int n = static_cast<int>(scene.joints.size()) - 1;
  const std::vector<Eigen::Vector2d> exact =
      HangingChain(from, to.x() - from.x(), static_cast<double>(link.size.x()), n);
  const int first = BodyOf(scene, link.id);
  return std::make_unique<Worst>([exact, first](const World& world) {
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      worst = Worse(worst, (Place(world, first + static_cast<int>(i)) - exact[i]).norm());
    }
    return worst;
  });
}

/// The chain hangs straight from the first joint; the last joint holds the load.
std::unique_ptr<Judge> Stretch(const Scene& scene) {
  const Joint last = scene.joints.back();
  const Eigen::Vector2d hook = scene.joints.front().anchor_a.cast<double>();
  const double length = (last.anchor_a.cast<double>() - hook).norm();
  const Part load = scene.parts[static_cast<std::size_t>(last.b)];
  const int body = BodyOf(scene, load.id);
  return std::make_unique<Worst>([=](const World& world) {
    return std::fabs((Carried(world, body, load, last.anchor_a) - hook).norm() - length);
  });
}

/// The load a millimetre beside the chain: the pin that holds it stays where it was.
void NudgeLoad(Scene* scene) {
  scene->parts[static_cast<std::size_t>(scene->joints.back().b)].position.x() += 0.001f;
}

/// Where the beam's last link is, seen from the block that carries the beam, against where it was.
std::unique_ptr<Judge> Droop(const Scene& scene) {
  const Part base = PartNamed(scene, "base");
  const Part tip = scene.parts.back();
  // Welded to one body, both are carried by its root.
  const int base_body = BodyOf(scene, base.id), tip_body = BodyOf(scene, tip.id);
  const Composition whole = Compose(scene);
  const auto root_of = [&](PartId part) {
    const int assembly = whole.assembly_of_part[static_cast<std::size_t>(part)];
    const PartId id = whole.assemblies[static_cast<std::size_t>(assembly)].id;
    return scene.parts[static_cast<std::size_t>(id)];
  };
  const Part base_root = root_of(base.id), tip_root = root_of(tip.id);
  return std::make_unique<Worst>([=](const World& world) {
    const Eigen::Vector2d was = (tip.position - base.position).cast<double>();
    const Eigen::Vector2d foot = Carried(world, base_body, base_root, base.position);
    const Eigen::Vector2d is = Carried(world, tip_body, tip_root, tip.position) - foot;
    // The base's own axes.
    const Vec2 beside = base.position + Vec2(1, 0);
    const Eigen::Vector2d x = Carried(world, base_body, base_root, beside) - foot;
    return (Eigen::Vector2d(is.dot(x), x.x() * is.y() - x.y() * is.x()) - was).norm();
  });
}

}  // namespace

std::vector<HardCase> ChainCases() {
  return {
      {"cantilever",
       "cantilever",
       Truth::kFormula,
       "m",
       "worst way of the tip of ten welded links from where it was, seen from the base",
       10,
       Droop,
       {}},
      {"catenary",
       "catenary",
       Truth::kFormula,
       "m",
       "worst distance of a link from tan(phi_i) = c (i - (n - 1)/2), sum L cos(phi_i) = span",
       20,
       Catenary,
       {}},
      {"chain-heavy-end",
       "chain-heavy-end",
       Truth::kFormula,
       "m",
       "worst stretch of ten links of 0.01 kg with 10 kg at their end",
       20,
       Stretch,
       {}},
      {"chain-heavy-end-nudged", "chain-heavy-end", Truth::kFormula, "m",
       "the same with the load 1 mm beside the chain", 20, Stretch, NudgeLoad},
  };
}

}  // namespace seam
