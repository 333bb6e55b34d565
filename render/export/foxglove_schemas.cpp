/// The schemas of https://docs.foxglove.dev/docs/sdk/schemas as protocol buffers, with the used
/// fields only, and seam2d's own.

#include <algorithm>
#include <set>

#include "render/export/foxglove.h"
#include "render/export/protobuf.h"

namespace seam {
namespace {

constexpr const char* kTime = ".google.protobuf.Timestamp";
constexpr const char* kVector = ".foxglove.Vector3";
constexpr const char* kQuaternion = ".foxglove.Quaternion";
constexpr const char* kColor = ".foxglove.Color";

ProtoSchema Numbers(const char* name, const std::vector<const char*>& fields) {
  ProtoSchema schema{name, {}};
  for (const char* field : fields) {
    schema.fields.push_back(
        {field, static_cast<int>(schema.fields.size()) + 1, ProtoType::kDouble});
  }
  return schema;
}

ProtoSchema SecondsAndNanos(const char* name) {
  return {name, {{"seconds", 1, ProtoType::kInt64}, {"nanos", 2, ProtoType::kInt32}}};
}

std::vector<ProtoSchema> FoxgloveMessages() {
  using Type = ProtoType;
  return {
      Numbers("Vector3", {"x", "y", "z"}),
      Numbers("Point3", {"x", "y", "z"}),
      Numbers("Quaternion", {"x", "y", "z", "w"}),
      Numbers("Color", {"r", "g", "b", "a"}),
      {"Pose",
       {{"position", 1, Type::kMessage, kVector}, {"orientation", 2, Type::kMessage, kQuaternion}}},
      {"FrameTransform",
       {{"timestamp", 1, Type::kMessage, kTime},
        {"parent_frame_id", 2, Type::kString},
        {"child_frame_id", 3, Type::kString},
        {"translation", 4, Type::kMessage, kVector},
        {"rotation", 5, Type::kMessage, kQuaternion}}},
      {"FrameTransforms", {{"transforms", 1, Type::kMessage, ".foxglove.FrameTransform", true}}},
      {"LinePrimitive",
       {{"type", 1, Type::kEnum, ".foxglove.LinePrimitive.Type"},
        {"pose", 2, Type::kMessage, ".foxglove.Pose"},
        {"thickness", 3, Type::kDouble},
        {"scale_invariant", 4, Type::kBool},
        {"points", 5, Type::kMessage, ".foxglove.Point3", true},
        {"color", 6, Type::kMessage, kColor}},
       {{"Type", {"LINE_STRIP", "LINE_LOOP", "LINE_LIST"}}}},
      {"SceneEntityDeletion",
       {{"timestamp", 1, Type::kMessage, kTime},
        {"type", 2, Type::kEnum, ".foxglove.SceneEntityDeletion.Type"},
        {"id", 3, Type::kString}},
       {{"Type", {"MATCHING_ID", "ALL"}}}},
      {"SceneEntity",
       {{"timestamp", 1, Type::kMessage, kTime},
        {"frame_id", 2, Type::kString},
        {"id", 3, Type::kString},
        {"lifetime", 4, Type::kMessage, ".google.protobuf.Duration"},
        {"frame_locked", 5, Type::kBool},
        {"lines", 11, Type::kMessage, ".foxglove.LinePrimitive", true}}},
      {"SceneUpdate",
       {{"deletions", 1, Type::kMessage, ".foxglove.SceneEntityDeletion", true},
        {"entities", 2, Type::kMessage, ".foxglove.SceneEntity", true}}},
      {"PackedElementField",
       {{"name", 1, Type::kString},
        {"offset", 2, Type::kFixed32},
        {"type", 3, Type::kEnum, ".foxglove.PackedElementField.NumericType"}},
       {{"NumericType",
         {"UNKNOWN", "UINT8", "INT8", "UINT16", "INT16", "UINT32", "INT32", "FLOAT32",
          "FLOAT64"}}}},
      {"PointCloud",
       {{"timestamp", 1, Type::kMessage, kTime},
        {"frame_id", 2, Type::kString},
        {"pose", 3, Type::kMessage, ".foxglove.Pose"},
        {"point_stride", 4, Type::kFixed32},
        {"fields", 5, Type::kMessage, ".foxglove.PackedElementField", true},
        {"data", 6, Type::kBytes}}},
      {"Log",
       {{"timestamp", 1, Type::kMessage, kTime},
        {"level", 2, Type::kEnum, ".foxglove.Log.Level"},
        {"message", 3, Type::kString},
        {"name", 4, Type::kString},
        {"file", 5, Type::kString},
        {"line", 6, Type::kFixed32}},
       {{"Level", {"UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"}}}}};
}

std::vector<ProtoSchema> OwnMessages() {
  using Type = ProtoType;
  return {{"BodyError", {{"body", 1, Type::kString}, {"error_m", 2, Type::kFloat}}},
          {"ViewErrors",
           {{"view", 1, Type::kString},
            {"rms_m", 2, Type::kFloat},
            {"max_m", 3, Type::kFloat},
            {"bodies", 4, Type::kMessage, ".seam2d.BodyError", true}}},
          {"Errors",
           {{"tick", 1, Type::kInt64}, {"views", 2, Type::kMessage, ".seam2d.ViewErrors", true}}},
          {"Input",
           {{"tick", 1, Type::kInt64},
            {"drive", 2, Type::kFloat},
            {"lift", 3, Type::kFloat},
            {"buttons", 4, Type::kInt32}}}};
}

/// Removes messages that no field of message `name`, or of what that is made of, is of.
std::vector<ProtoSchema> NeededBy(const std::string& name, std::vector<ProtoSchema> all) {
  std::set<std::string> needed{"." + name};
  const std::string package = "." + name.substr(0, name.find('.') + 1);
  for (std::size_t before = 0; before != needed.size();) {
    before = needed.size();
    for (const ProtoSchema& schema : all) {
      if (needed.count(package + schema.name) == 0) continue;
      for (const ProtoField& field : schema.fields) needed.insert(field.of);
    }
  }
  all.erase(
      std::remove_if(all.begin(), all.end(),
                     [&](const ProtoSchema& s) { return needed.count(package + s.name) == 0; }),
      all.end());
  return all;
}

}  // namespace

std::string ExportSchema(const std::string& name) {
  constexpr const char *kTimeFile = "google/protobuf/timestamp.proto",
                       *kDurationFile = "google/protobuf/duration.proto";
  const std::string package = name.substr(0, name.find('.')), file = name + ".proto";
  if (package == "seam2d") {
    return DescriptorSet({{file.c_str(), "seam2d", {}, NeededBy(name, OwnMessages())}});
  }
  return DescriptorSet(
      {{kTimeFile, "google.protobuf", {}, {SecondsAndNanos("Timestamp")}},
       {kDurationFile, "google.protobuf", {}, {SecondsAndNanos("Duration")}},
       {file.c_str(), "foxglove", {kTimeFile, kDurationFile}, NeededBy(name, FoxgloveMessages())}});
}

}  // namespace seam
