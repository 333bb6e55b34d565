#include "tests/lab/experiment/build_id.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "common/base/bytes.h"
#include "common/base/random.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"

namespace seam {
namespace {

constexpr int kArguments = 4096;
constexpr int kTicks = 60;

/// A hash of all numbers that are added.
class NumberHash {
 public:
  template <typename Number>
  void Add(Number number) {
    value_ = Fnv1a(&number, sizeof number, value_);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = Fnv1a("", 0);
};

/// Adds the results of the functions that the programs import from libm, in the precision in which
/// they do.
void AddFunctions(NumberHash* hash) {
  Random random(1);
  for (int i = 0; i < kArguments; ++i) {
    const double a = random.Uniform(-20, 20), b = random.Uniform(-20, 20), u = a / 20;
    const double p = std::fabs(a) + 1e-3;
    for (const double value :
         {std::sin(a), std::cos(a), std::tan(a), std::acos(u), std::atan2(a, b), std::exp(a),
          std::log(p), std::log2(p), std::log10(p), std::log1p(p), std::pow(p, u), std::hypot(a, b),
          std::sqrt(p), std::remainder(a, b)}) {
      hash->Add(value);
    }
    const auto af = static_cast<float>(a), bf = static_cast<float>(b), uf = static_cast<float>(u);
    const auto pf = static_cast<float>(p);
    for (const float value : {std::sin(af), std::cos(af), std::acos(uf), std::atan2(af, bf),
                              std::exp(af), std::log(pf), std::sqrt(pf), std::remainder(af, bf)}) {
      hash->Add(value);
    }
  }
}

/// A wheel, a tower and a rope, the joints by the engine or exact.
std::string Yard(const std::string& joints) {
  return "title = \"A yard\"\n[solver]\njoints = \"" + joints + R"("
[[part]]
name = "ground"
chain = [[-40, 0], [40, 1]]
friction = 0.7
[[part]]
name = "brick"
box = [0.8, 0.4]
position = [4, 1.2]
angle = 0.1
repeat = {count = [2, 4], step = [0.9, 0.6]}
[[part]]
name = "wheel"
circle = 0.5
position = [-3, 2]
velocity = [6, 0]
spin = -12
[[part]]
name = "hook"
box = [0.2, 0.2]
position = [-8, 8]
anchored = true
[[part]]
name = "link"
box = [0.8, 0.2]
position = [-7.5, 8]
[[part]]
name = "load"
box = [0.8, 0.2]
position = [-6.7, 8]
[[joint]]
name = "top"
kind = "hinge"
a = "hook"
b = "link"
anchor = [-7.9, 8]
[[joint]]
name = "low"
kind = "hinge"
a = "link"
b = "load"
anchor = [-7.1, 8]
)";
}

std::string Compute() {
  NumberHash hash;
  AddFunctions(&hash);
  for (const char* joints : {"iterative", "exact"}) {
    World world(ParseScene(Yard(joints), "numerics"));
    for (int tick = 0; tick < kTicks; ++tick) world.Step();
    hash.Add(world.Hash());
  }
  return fmt::format("{:016x}", hash.value());
}

}  // namespace

std::string BuiltCommit() { return SEAM_COMMIT; }

const std::string& Numerics() {
  static const std::string numerics = Compute();
  return numerics;
}

}  // namespace seam
