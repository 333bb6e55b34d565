/// The compacted edit history: a topology rebuilt from it equals the one with all edits, bit for
/// bit, and damaged entries are refused in one line.

#include "common/topology/topology_fold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "common/base/random.h"
#include "common/physics/world.h"
#include "common/sync/edits/topology_snapshot.h"
#include "tests/support/soak.h"

namespace seam {
namespace topology_fold_test {

/// A few joints of every kind, a seat and a wall to blast.
const std::string kScene = R"(
[[player]]
name = "ann"
[[player]]
name = "bob"
[[part]]
name = "floor"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "box"
box = [1, 0.5]
position = [-8, 0.3]
repeat = {count = 6, step = [1, 0], glue = 50}
[[part]]
name = "ball"
circle = 0.4
position = [-8, 5]
repeat = {count = 6, step = [2, 0]}
[[joint]]
name = "rope"
kind = "rope"
a = "ball.0"
b = "ball.1"
[[joint]]
name = "slide"
kind = "prismatic"
a = "ball.2"
b = "ball.3"
axis = [1, 0.5]
[[joint]]
name = "hinge"
kind = "hinge"
a = "box.5"
b = "ball.4"
[[joint]]
name = "gear"
kind = "gear"
joints = ["slide", "hinge"]
ratio = -2
[[joint]]
name = "pulley"
kind = "pulley"
a = "box.0"
b = "ball.5"
ground_a = [-8, 9]
ground_b = [2, 9]
[[seat]]
name = "chair"
part = "box.0"
at = [0, 0.7]
reach = 3
button = 3
[[bricks]]
name = "wall"
brick = [0.5, 0.25]
position = [20, 0]
count = [40, 40]
)";

class RandomEdits {
 public:
  explicit RandomEdits(std::uint64_t seed) : random_(seed) {}

  /// Most can be applied, some cannot.
  Edit Next(const Topology& now) {
    const auto parts = static_cast<int>(now.scene().parts.size());
    const auto joints = static_cast<int>(now.scene().joints.size());
    switch (random_.Next() % 16) {
      case 0:
      case 1:
      case 2:
      case 3: return Edit(BreakEdit{Below(joints + 3) - 1});
      case 4: return Edit(RemoveEdit{Below(parts + 2) - 1});
      case 5: return Edit(FreeEdit{Below(parts)});
      case 6: return Edit(PushEdit{Below(parts), {1, 2}, 3});
      case 7: return Edit(SeatEdit{0, Below(3) - 1});
      case 8: return Edit(BlastEdit{{20 + Real(0, 10), Real(0, 8)}, 0.8f, 20});
      case 9:
      case 10: return Edit(InsertEdit{Text(now)});
      default:
        return Edit(BondEdit{Below(parts),
                             Below(parts),
                             {Real(-2, 2), Real(-2, 2)},
                             Real(-3, 3),
                             static_cast<float>(Below(3)),
                             static_cast<BondCause>(Below(3) - 1)});
    }
  }
  int Below(int count) {
    return static_cast<int>(random_.Next() % static_cast<std::uint64_t>(count));
  }
  float Real(float low, float high) { return static_cast<float>(random_.Uniform(low, high)); }

 private:
  /// Names are reused after their part is gone.
  std::string Text(const Topology& now) {
    const auto& parts = now.scene().parts;
    const std::string a =
        parts[static_cast<std::size_t>(Below(static_cast<int>(parts.size())))].name;
    const std::string name = "new" + std::to_string(Below(8));
    const std::string joint = "j" + std::to_string(++count_);
    std::string text;
    if (Below(4) > 0) {
      text += "[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" +
              std::to_string(Below(40) - 20) +
              ", 6]\nanchored = " + (Below(4) == 0 ? "true" : "false") + "\n";
    }
    static const char* const kKinds[] = {"rope", "hinge", "glue\"\nstrength = 5 # \"", "weld"};
    if (Below(2) == 0 && a.find('@') == std::string::npos) {
      text += "[[joint]]\nname = \"" + joint + "\"\nkind = \"" + kKinds[Below(4)] + "\"\na = \"" +
              a + "\"\nb = \"" + name + "\"\n";
    }
    const auto& joints = now.scene().joints;
    const auto any = [&] {
      return joints[static_cast<std::size_t>(Below(static_cast<int>(joints.size())))].name;
    };
    if (Below(3) == 0) {  // most name what is no hinge
      text += "[[joint]]\nname = \"g" + joint + "\"\nkind = \"gear\"\njoints = [\"" +
              (Below(2) == 0 ? "j" + std::to_string(Below(count_)) : any()) + "\", \"" + any() +
              "\"]\n";
    }
    return text;
  }

  Random random_;
  int count_ = 0;
};

bool SameFloats(std::initializer_list<float> a, std::initializer_list<float> b) {
  return a.size() == b.size() && std::memcmp(a.begin(), b.begin(), a.size() * sizeof(float)) == 0;
}

void ExpectSame(const Topology& one, const Topology& other) {
  ASSERT_EQ(one.revision(), other.revision());
  ASSERT_EQ(one.composition().hash, other.composition().hash);
  const Scene &x = one.scene(), &y = other.scene();
  ASSERT_EQ(x.parts.size(), y.parts.size());
  ASSERT_EQ(x.joints.size(), y.joints.size());
  for (std::size_t j = 0; j < x.joints.size(); ++j) {
    if (x.joints[j].gone) continue;
    ASSERT_EQ(x.joints[j].coupled, y.joints[j].coupled);
  }
  for (std::size_t i = 0; i < x.parts.size(); ++i) {
    const Part &p = x.parts[i], &q = y.parts[i];
    ASSERT_EQ(p.gone, q.gone) << i;
    ASSERT_EQ(p.id, q.id) << i;
    if (p.gone) continue;
    ASSERT_EQ(p.name, q.name) << i;
    ASSERT_EQ(p.anchored, q.anchored) << p.name;
    ASSERT_TRUE(SameFloats(
        {p.position.x(), p.position.y(), p.angle, p.size.x(), p.size.y(), p.radius, p.velocity.x()},
        {q.position.x(), q.position.y(), q.angle, q.size.x(), q.size.y(), q.radius,
         q.velocity.x()}))
        << p.name;
  }
  for (std::size_t i = 0; i < x.joints.size(); ++i) {
    const Joint &p = x.joints[i], &q = y.joints[i];
    const auto index = static_cast<std::int32_t>(i);
    ASSERT_EQ(p.gone, q.gone) << i;
    ASSERT_EQ(one.IsBond(index), other.IsBond(index)) << i;
    if (p.gone) continue;
    ASSERT_EQ(p.name, q.name) << i;
    ASSERT_EQ(p.kind, q.kind) << p.name;
    ASSERT_EQ(p.a, q.a) << p.name;
    ASSERT_EQ(p.b, q.b) << p.name;
    ASSERT_EQ(p.grouped, q.grouped) << p.name;
    ASSERT_TRUE(SameFloats({p.anchor_a.x(), p.anchor_a.y(), p.anchor_b.x(), p.anchor_b.y()},
                           {q.anchor_a.x(), q.anchor_a.y(), q.anchor_b.x(), q.anchor_b.y()}))
        << p.name;
    ASSERT_TRUE(SameFloats({p.axis.x(), p.axis.y(), p.turn, p.length, p.strength},
                           {q.axis.x(), q.axis.y(), q.turn, q.length, q.strength}))
        << p.name << " " << p.length << " " << q.length;
  }
  for (std::size_t i = 0; i < x.seats.size(); ++i) ASSERT_EQ(x.seats[i].player, y.seats[i].player);
}

std::vector<Snapshot> SnapshotsOf(const TopologyFold& fold, const Topology& now) {
  return ToSnapshots(now.revision(), fold.Entries(now));
}

Status Read(const Scene& scene, const std::vector<Snapshot>& parts, Topology* out) {
  SnapshotReader reader(scene);
  for (const Snapshot& part : parts) {
    Status status = reader.Take(part);
    if (!status.ok()) return status;
  }
  if (!reader.complete()) return Status::Error("not complete");
  *out = reader.topology();
  return Status::Ok();
}

TEST(TopologyFold, RebuildsTheTopologyOfAllEdits) {
  const Scene scene = ParseScene(kScene, "fold.toml");
  int applied = 0;
  for (const std::uint64_t seed : SoakSeeds(1, 60)) {
    SCOPED_TRACE(seed);
    RandomEdits edits(seed);
    Topology now(scene);
    TopologyFold fold(now);
    for (int round = 0; round < 6; ++round) {
      for (int i = 0; i < 40; ++i) {
        const Edit edit = edits.Next(now);
        applied += now.Apply({edit})[0].ok() ? 1 : 0;
        fold.Note(edit, now);
      }
      Topology built(scene);
      const Status status = Read(scene, SnapshotsOf(fold, now), &built);
      ASSERT_TRUE(status.ok()) << status.why();
      ASSERT_NO_FATAL_FAILURE(ExpectSame(now, built));
      // And it goes on the same.
      RandomEdits more(seed * 1000 + static_cast<std::uint64_t>(round));
      Topology further = now;
      for (int i = 0; i < 20; ++i) {
        const Edit edit = more.Next(further);
        ASSERT_EQ(further.Apply({edit})[0].ok(), built.Apply({edit})[0].ok()) << i;
      }
      ASSERT_NO_FATAL_FAILURE(ExpectSame(further, built));
    }
  }
  EXPECT_GT(applied, 1000) << "the edits are worth something";
}

TEST(TopologyFold, GrowsWithTheTopologyAndNotWithItsHistory) {
  const Scene scene = ParseScene(kScene, "fold.toml");
  Topology now(scene);
  TopologyFold fold(now);
  const auto apply = [&](const Edit& edit) {
    ASSERT_TRUE(now.Apply({edit})[0].ok());
    fold.Note(edit, now);
  };
  for (int i = 0; i < 3000; ++i) {
    apply(Edit(InsertEdit{"[[part]]\nname = \"come-and-go\"\nbox = [1, 1]\nposition = [0, 9]\n"}));
    const auto part = static_cast<PartId>(now.scene().parts.size()) - 1;
    apply(Edit(PushEdit{part, {1, 0}, 0}));
    apply(Edit(BondEdit{part, 8, {1, 0}, 0, 0}));
    apply(Edit(RemoveEdit{part}));
  }
  EXPECT_LT(fold.steps(), 1000u);
  const std::vector<Snapshot> parts = SnapshotsOf(fold, now);
  EXPECT_EQ(parts.size(), 1u);
  EXPECT_LT(parts[0].kind.size(), 20u);
  Topology built(scene);
  ASSERT_TRUE(Read(scene, parts, &built).ok());
  ExpectSame(now, built);
}

TEST(TopologyFold, DamagedSnapshotsAreRefusedOrAreValidWorlds) {
  const Scene scene = ParseScene(kScene, "fold.toml");
  RandomEdits edits(7);
  Topology now(scene);
  TopologyFold fold(now);
  for (int i = 0; i < 200; ++i) {
    const Edit edit = edits.Next(now);
    now.Apply({edit});
    fold.Note(edit, now);
  }
  const std::vector<Snapshot> good = SnapshotsOf(fold, now);
  const float kWild[] = {3e38f, -3e38f, 1e6f, NAN, INFINITY, -1, 0, 1e-30f};
  int refused = 0;
  for (const std::uint64_t seed : SoakSeeds(1, 400)) {
    RandomEdits random(seed);
    std::vector<Snapshot> bad = good;
    Snapshot& part = bad[static_cast<std::size_t>(random.Below(static_cast<int>(bad.size())))];
    const auto at = static_cast<std::size_t>(random.Below(static_cast<int>(part.kind.size())));
    switch (random.Below(8)) {
      case 0: part.kind[at] = static_cast<std::int8_t>(random.Below(127)); break;
      case 1: part.joint[at] = random.Below(2) == 0 ? INT32_MAX : random.Below(60) - 1; break;
      case 2: part.a[at] = static_cast<std::int32_t>(random.Below(kIdsMax) - 1); break;
      case 3: part.b[at] = static_cast<std::int32_t>(random.Below(60) - 1); break;
      case 4:
        if (part.value.empty()) break;
        part.value[static_cast<std::size_t>(random.Below(static_cast<int>(part.value.size())))] =
            kWild[random.Below(8)];
        break;
      case 5:
        if (!part.text.empty()) part.text[part.text.size() / 2] = '"';
        break;
      case 6: part.part += 1; break;
      case 7: part.value.resize(part.value.size() / 2); break;
      default: break;
    }
    Topology built(scene);
    const Status status = Read(scene, bad, &built);
    refused += status.ok() ? 0 : 1;
    if (!status.ok()) {
      EXPECT_EQ(status.why().find('\n'), std::string::npos);
      continue;
    }
    World world(built);  // the engine takes it
    for (int tick = 0; tick < 3; ++tick) world.Step();
  }
  EXPECT_GT(refused, 100);
}

TEST(TopologyFold, AnInsertBeyondTheLimitOfPartsIsRefusedAndTheRestGoesOn) {
  const Scene scene = ParseScene(kScene, "fold.toml");
  TopologyEntry almost;
  almost.kind = TopologyEntry::Kind::kParts;
  almost.a = static_cast<std::int32_t>(kPartsEver);
  TopologyBuilder builder(scene);
  ASSERT_TRUE(builder.Add(almost).ok());
  ASSERT_TRUE(builder.Finish(60000).ok());
  Topology topology = builder.topology();
  const Edit insert(InsertEdit{"[[part]]\nname = \"late\"\nbox = [1, 1]\nposition = [0, 9]\n"});
  EXPECT_EQ(topology.Validate(insert).why(), "insert:1: insert: there have been too many parts");
  EXPECT_FALSE(topology.Apply({insert})[0].ok());
  EXPECT_TRUE(topology.Apply({Edit(RemoveEdit{3})})[0].ok());
  EXPECT_EQ(topology.revision(), 60002);
}

TEST(TopologyFold, ABrokenBondsSlotIsReused) {
  const Scene scene = ParseScene(kScene, "fold.toml");
  Topology topology(scene);
  const auto scenes = static_cast<std::int32_t>(scene.joints.size());
  topology.Apply({Edit(BondEdit{8, 9, {1, 0}, 0, 0}), Edit(BondEdit{10, 11, {1, 0}, 0, 0})});
  EXPECT_EQ(topology.JointMadeAt(scenes), 1);
  topology.Apply({Edit(BreakEdit{scenes}), Edit(BreakEdit{0})});
  topology.Apply({Edit(BondEdit{9, 10, {1, 0}, 0, 0})});
  ASSERT_EQ(topology.scene().joints.size(), scene.joints.size() + 2) << "the scene's stays empty";
  EXPECT_EQ(topology.JointMadeAt(scenes), 5);
  EXPECT_TRUE(topology.scene().joints[0].gone);
  EXPECT_FALSE(topology.scene().joints[static_cast<std::size_t>(scenes)].gone);
}

}  // namespace topology_fold_test
}  // namespace seam
