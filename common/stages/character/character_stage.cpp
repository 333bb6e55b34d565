#include <algorithm>

#include "common/scene/character.h"
#include "common/stages/character/character_control.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

class CharacterStage : public Stage {
 public:
  explicit CharacterStage(const StageWorld& world)
      : tick_s_(1.0f / static_cast<float>(world.scene.solver.tick_hz)) {
    for (const Character& character : world.scene.characters) {
      if (!character.active) continue;
      players_.push_back(character.player);
      parts_.emplace_back(character.parts.begin(), character.parts.end());
      controls_.emplace_back(character, world);
    }
  }

  void Rebuilt(b2World* world) override {
    for (CharacterControl& control : controls_) control.Find(world);
  }
  void Emptied() override {
    for (CharacterControl& control : controls_) control.Forget();
  }
  void AfterTick() override {
    for (CharacterControl& control : controls_) control.UpdateHandLoads(tick_s_);
  }
  void ProposeEdits(std::vector<Edit>* edits) override {
    for (const CharacterControl& control : controls_) control.ProposeGrips(edits);
  }
  void BeforeStep(float h) override {
    for (CharacterControl& control : controls_) control.Act(h);
  }
  void Edited(const Edit& edit) override {
    const PushEdit* push = edit.As<PushEdit>();
    if (push == nullptr) return;
    for (std::size_t i = 0; i < controls_.size(); ++i) {
      const std::vector<PartId>& own = parts_[i];
      const bool struck = std::find(own.begin(), own.end(), push->part) != own.end();
      if (!struck) continue;
      controls_[i].Struck(push->impulse.norm());
      if (push->limp != 0) controls_[i].GoLimp(push->limp);
    }
  }
  void SetInput(int player, const Input& input) override {
    for (std::size_t i = 0; i < controls_.size(); ++i) {
      if (players_[i] == player) controls_[i].SetInput(input);
    }
  }

  void Save(std::vector<float>* memory) const override {
    for (const CharacterControl& control : controls_) control.memory().Save(memory);
  }
  void Load(StageMemory* memory) override {
    for (CharacterControl& control : controls_) control.mutable_memory()->Load(memory);
  }

 private:
  const float tick_s_;
  std::vector<int> players_;
  std::vector<std::vector<PartId>> parts_;  // of each character
  std::vector<CharacterControl> controls_;
};

}  // namespace

bool HasActiveCharacter(const Scene& scene) {
  return std::any_of(scene.characters.begin(), scene.characters.end(),
                     [](const Character& c) { return c.active; });
}

std::unique_ptr<Stage> MakeCharacterStage(const StageWorld& world) {
  return std::make_unique<CharacterStage>(world);
}

}  // namespace seam
