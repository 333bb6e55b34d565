#include "common/scene/connectors.h"
#include "common/scene/grouping.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

std::vector<Connector> ReadList(const SceneReader& r, const char* key) {
  const auto expected = [&] {
    r.FailAt(key, std::string(key) + " must be a list of at most " +
                      std::to_string(kConnectorsMax) + " [x, y, angle]");
  };
  std::vector<Connector> list;
  const std::vector<TomlNode>& items = r.Items(key);
  if (items.size() > kConnectorsMax) expected();
  for (const TomlNode& item : items) {
    if (item.kind != TomlNode::Kind::kArray || item.items.size() != 3) expected();
    float values[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const TomlNode& node = item.items[i];
      const bool number =
          node.kind == TomlNode::Kind::kInteger || node.kind == TomlNode::Kind::kNumber;
      if (!number || !(node.number >= -1000 && node.number <= 1000)) {
        r.FailAt(key, std::string(key) + ": each of x, y and angle must be from -1000 to 1000");
      }
      values[i] = static_cast<float>(node.number);
    }
    list.push_back({Vec2(values[0], values[1]), values[2]});
  }
  return list;
}

}  // namespace

Connectors ReadConnectors(const SceneReader& part) {
  Connectors out;
  out.inlets = ReadList(part, "inlets");
  out.outlets = ReadList(part, "outlets");
  for (const char* key : {"join_strength", "join_reach", "join_angle"}) {
    if (out.empty() && part.Has(key)) part.FailAt(key, "only connectors join");
  }
  out.strength = part.Number("join_strength", {0, 1e9}, out.strength);
  out.reach = part.Number("join_reach", {0.001, 10}, out.reach);
  out.angle = part.Number("join_angle", {0, 3.15, true}, out.angle);
  return out;
}

void ReadGrouping(const SceneReader& root, SceneDraft* draft) {
  const TomlNode* table = root.Table("grouping");
  if (table == nullptr) return;
  const SceneReader r(*table, draft->file, "grouping", {"after", "impact", "acceleration", "spin"});
  Grouping grouping;
  grouping.after = r.Number("after", {0.1, 3600});
  grouping.impact = r.Number("impact", {0, 100}, grouping.impact);
  grouping.acceleration = r.Number("acceleration", {0, 1000}, grouping.acceleration);
  grouping.spin = r.Number("spin", {0, 100}, grouping.spin);
  draft->scene.grouping.Set(grouping);
}

}  // namespace seam
