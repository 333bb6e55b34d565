#include "tests/lab/exact/judged_room.h"

#include "common/physics/part_places.h"

namespace seam {

JudgedRoom::JudgedRoom(const Scene& scene) : scene_(scene) {
  for (const Part& part : scene.parts) part_of_name_.emplace(part.name, part.id);
}

PartId JudgedRoom::FindPart(const std::string& name) const {
  const auto found = part_of_name_.find(name);
  return found == part_of_name_.end() ? -1 : found->second;
}

bool JudgedRoom::ReadPart(const std::string& part, BodyState* state) const {
  const PartId id = FindPart(part);
  return world_ != nullptr && id >= 0 && seam::ReadPart(*world_, id, state);
}

void JudgedRoom::Refuse() const {
  if (!loading_)
    throw ScriptRefusal("a scene that is judged cannot be changed by its exact answer");
}

}  // namespace seam
