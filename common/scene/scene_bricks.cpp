/// [[bricks]]: rectangles and rows of towers of anchored bricks.

#include <cmath>

#include "common/scene/bricks.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Converts a length that must be a whole number of units.
int ToUnits(const SceneReader& r, const char* key, float metres) {
  const double units = static_cast<double>(metres) / static_cast<double>(kBrickUnit);
  const long long whole = std::llround(units);
  // Single precision rounds 30 km to 2 mm.
  if (std::fabs(units - static_cast<double>(whole)) > 0.03) {
    r.FailAt(key, std::string(key) + " must be in steps of " + Decimal(kBrickUnit) + " m");
  }
  return static_cast<int>(whole);
}

/// Reads [least, most] in m and rounds to whole numbers of bricks of `side` units.
void ReadSpan(const SceneReader& r, const char* key, int side, int* least, int* most) {
  const Vec2 span = r.Vector(key, {kBrickUnit, 1000});
  if (span.x() > span.y()) r.FailAt(key, std::string(key) + ": the least is above the most");
  const auto bricks = [side](float metres) {
    const double units = static_cast<double>(metres) / static_cast<double>(kBrickUnit);
    return std::max(1, static_cast<int>(std::lround(units / side)));
  };
  *least = bricks(span.x());
  *most = bricks(span.y());
}

void ReadTowers(const SceneReader& owner, const std::string& file, BrickField* field) {
  const SceneReader r(*owner.Table("towers"), file, owner.what() + ": towers",
                      {"count", "pitch", "width", "height", "windows", "seed"});
  BrickField::Towers& t = field->towers;
  t.count = r.Integer("count", {1, 10000});
  t.pitch = ToUnits(r, "pitch", r.Number("pitch", {1, 1000}));
  ReadSpan(r, "width", field->width, &t.columns_min, &t.columns_max);
  ReadSpan(r, "height", field->height, &t.rows_min, &t.rows_max);
  t.windows = r.Flag("windows", false);
  t.seed = static_cast<std::uint64_t>(r.Integer("seed", {0, 1e9}, 0));
  if (t.columns_max * field->width > t.pitch) r.FailAt("pitch", "the towers are wider than pitch");
}

void ReadCount(const SceneReader& r, BrickField* field) {
  const Vec2 count = r.Vector("count", {1, static_cast<double>(kBricksMax)});
  field->columns = static_cast<int>(count.x());
  field->rows = static_cast<int>(count.y());
  if (count != Vec2(static_cast<float>(field->columns), static_cast<float>(field->rows))) {
    r.FailAt("count", "count must be integers");
  }
}

/// Returns the total with this field; complains if there are too many or if one is too far away.
std::size_t Counted(const SceneReader& r, const BrickField& field, std::size_t before) {
  constexpr int kBricksFar = 600000;  // units: 30 km
  static_assert(kBricksFar / 20 == kCoordinate.max && kBricksFar / 20 == -kCoordinate.min);
  std::size_t count = before;
  EachBrick(field, [&](int x, int y) {
    ++count;
    const int right = x + field.width, top = y + field.height;
    if (x < -kBricksFar || y < -kBricksFar || right > kBricksFar || top > kBricksFar) {
      r.Fail("there would be bricks beyond 30 km");
    }
    return count <= kBricksMax;
  });
  if (count > kBricksMax) {
    r.Fail("a scene may have at most " + std::to_string(kBricksMax) + " bricks");
  }
  return count;
}

/// Adds the same bricks as anchored parts NAME.0, NAME.1, ...
void AddAsParts(const SceneReader& r, const BrickField& field, SceneDraft* draft) {
  if (draft->part_of_name.count(field.name) != 0 || draft->group_of_name.count(field.name) != 0) {
    r.FailAt("name", "there is a part of this name");
  }
  std::vector<PartId>& group = draft->group_of_name[field.name];
  EachBrick(field, [&](int x, int y) {
    if (Full(draft->scene.parts, kPartsMax)) {
      r.FailAt("featherweight", "a scene may have at most " + std::to_string(kPartsMax) + " parts");
    }
    Part part = BrickPart(field, x, y);
    part.id = static_cast<PartId>(draft->scene.parts.size());
    part.name = field.name + "." + std::to_string(group.size());
    part.line = field.line;
    group.push_back(part.id);
    draft->part_of_name[part.name] = part.id;
    draft->scene.parts.push_back(std::move(part));
    return true;
  });
}

void ReadField(const TomlNode& node, SceneDraft* draft, std::size_t* count) {
  SceneReader r(node, draft->file, "bricks",
                {"name", "brick", "position", "count", "towers", "density", "friction",
                 "restitution", "strength", "featherweight"});
  BrickField field;
  field.line = r.line();
  field.name = r.Name("name");
  r.Rename("bricks '" + field.name + "'");
  for (const BrickField& other : draft->scene.bricks) {
    if (other.name == field.name) r.FailAt("name", "there are other bricks of this name");
  }
  const Range side{kBrickSideMin * kBrickUnit, kBrickSideMax * kBrickUnit};
  const Vec2 size = r.Vector("brick", side);
  field.width = ToUnits(r, "brick", size.x());
  field.height = ToUnits(r, "brick", size.y());
  const Vec2 corner = r.Vector("position", kCoordinate, Vec2(0, 0));
  field.x = ToUnits(r, "position", corner.x());
  field.y = ToUnits(r, "position", corner.y());
  if (r.Has("count") == r.Has("towers")) r.Fail("needs exactly one of count and towers");
  if (r.Has("towers")) {
    ReadTowers(r, draft->file, &field);
  } else {
    ReadCount(r, &field);
  }
  field.density = r.Number("density", kDensity, field.density);
  field.friction = r.Number("friction", {0, 1}, field.friction);
  field.restitution = r.Number("restitution", {0, 1}, field.restitution);
  field.strength = r.Number("strength", {0, 1000}, field.strength);
  *count = Counted(r, field, *count);
  if (!r.Flag("featherweight", true)) {
    AddAsParts(r, field, draft);
    return;
  }
  if (draft->scene.bricks.size() == kBrickFieldsMax) {
    r.Fail("a scene may have at most " + std::to_string(kBrickFieldsMax) + " [[bricks]]");
  }
  draft->scene.bricks.push_back(field);
}

}  // namespace

Part BrickPart(const BrickField& field, int x, int y) {
  Part part;
  part.size = Vec2(static_cast<float>(field.width), static_cast<float>(field.height)) * kBrickUnit;
  part.position =
      Vec2(static_cast<float>(2 * x + field.width), static_cast<float>(2 * y + field.height)) *
      (kBrickUnit / 2);
  part.material = {field.density, field.friction, field.restitution};
  part.anchored = true;
  return part;
}

void ReadBricks(const SceneReader& root, SceneDraft* draft) {
  std::size_t count = 0;
  for (const TomlNode* node : root.Tables("bricks")) ReadField(*node, draft, &count);
}

}  // namespace seam
