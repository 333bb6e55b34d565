#include "tests/lab/gait/gait_run.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/scene.h"

namespace seam {

const char* const kFlat =
    "[[part]]\nname = \"ground\"\nchain = [[-200, 0], [200, 0]]\nfriction = 0.8\n";

bool GaitSight::upright() const { return feet && !other && std::abs(torso) < kPi / 6; }

GaitRun::GaitRun(const GaitSetup& setup, const CharacterGains& gains, const std::string& ground,
                 const std::string& place) {
  Scene scene = ParseScene("[solver]\n" + setup.solver + "\n[[player]]\nname = \"ann\"\n" + ground +
                               "[[character]]\nname = \"hero\"\nplayer = \"ann\"\n" +
                               setup.character + "\n" + place + "\n",
                           "gait.toml");
  Character hero = scene.characters[0];
  hero.gains = std::make_shared<const CharacterGains>(gains);
  scene.characters = {hero};
  world_ = std::make_unique<World>(scene);
  sight_ = See();
}

void GaitRun::Step(float drive, float lift) {
  Input input;
  input.drive = static_cast<std::int8_t>(std::lround(127 * drive));
  input.lift = static_cast<std::int8_t>(std::lround(127 * lift));
  world_->SetInput(0, input);
  world_->Step();
  const std::vector<Edit> edits = world_->ProposeEdits();
  if (!edits.empty()) world_->Apply(edits);
  sight_ = See();
  upright_ticks_ = sight_.upright() ? upright_ticks_ + 1 : 0;
}

void GaitRun::RunTo(double seconds, float drive, float lift) {
  while (time() < seconds) Step(drive, lift);
}

double GaitRun::time() const {
  return static_cast<double>(world_->tick()) / world_->scene().solver.tick_hz;
}

GaitSight GaitRun::See() const {
  const Scene& scene = world_->scene();
  const Composition& composition = world_->composition();
  const Character& hero = scene.characters[0];
  GaitSight sight;
  for (const PartId part : hero.parts) {
    const int assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
    const int body =
        world_->BodyOfId(composition.assemblies[static_cast<std::size_t>(assembly)].id);
    const float mass = world_->mass(body);
    const BodyState state = world_->Read(body);
    sight.mass += mass;
    sight.centre += mass * state.position;
    sight.velocity += mass * state.velocity;
  }
  sight.centre /= sight.mass;
  sight.velocity /= sight.mass;
  const auto pose = [&](CharacterPart part) { return PartPose(*world_, hero.parts[part]); };
  sight.head_y = pose(kHead).position.y();
  sight.hand_y = std::max(pose(kLowerArmLeft).position.y(), pose(kLowerArmRight).position.y());
  sight.soles = std::min(pose(kFootLeft).position.y(), pose(kFootRight).position.y()) -
                0.045f * hero.height / 1.8f;
  sight.torso = WrapAngle(pose(kTorso).angle);
  const auto of_hero = [&](PartId id) {
    return std::find(hero.parts.begin(), hero.parts.end(), id) - hero.parts.begin();
  };
  for (const PartTouch& touch : world_->PartTouches()) {
    for (const auto index : {of_hero(touch.a), of_hero(touch.b)}) {
      if (index == kCharacterParts) continue;
      const bool foot = index == kFootLeft || index == kFootRight;
      (foot ? sight.feet : sight.other) = true;
    }
  }
  return sight;
}

void GaitRun::Shove(Vec2 impulse) {
  const PartId torso = world_->scene().characters[0].parts[kTorso];
  world_->Apply({Edit(PushEdit{torso, impulse}, EditCause::kOutside)});
}

void GaitRun::GoLimp(float seconds) {
  const PartId torso = world_->scene().characters[0].parts[kTorso];
  world_->Apply({Edit(PushEdit{torso, Vec2(0, 0), 0, seconds}, EditCause::kOutside)});
}

}  // namespace seam
