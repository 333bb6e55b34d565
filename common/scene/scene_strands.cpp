#include <algorithm>

#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/strand.h"

namespace seam {
namespace {

Strand ReadStrand(const TomlNode& node, const SceneDraft& draft) {
  Strand strand;
  strand.line = node.line;
  SceneReader r(node, draft.file, "strand",
                {"name", "part", "at", "length", "links", "width", "stiffness", "damping"});
  strand.name = r.Name("name");
  r.Rename("strand '" + strand.name + "'");
  const FeatureList<Strand>& all = draft.scene.strands;
  const auto same = [&](const Strand& other) { return other.name == strand.name; };
  if (std::any_of(all.begin(), all.end(), same)) {
    r.FailAt("name", "there is another strand of this name");
  }
  strand.part = FindPart(r, "part", draft);
  strand.at = r.Vector("at", {-kSizeMaxMax, kSizeMaxMax}, Vec2(0, 0));
  strand.length = r.Number("length", {0.05f, 20}, strand.length);
  strand.links = r.Integer("links", {2, static_cast<int>(kStrandLinksMax)}, strand.links);
  strand.width = r.Number("width", {0.005f, 1}, strand.width);
  strand.stiffness = r.Number("stiffness", {0, 1}, strand.stiffness);
  strand.damping = r.Number("damping", {0, 20}, strand.damping);
  return strand;
}

}  // namespace

void ReadStrands(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("strand")) {
    if (draft->scene.strands.size() == kStrandsMax) {
      root.Fail("a scene may have at most " + std::to_string(kStrandsMax) + " [[strand]]");
    }
    draft->scene.strands.push_back(ReadStrand(*node, *draft));
  }
}

}  // namespace seam
