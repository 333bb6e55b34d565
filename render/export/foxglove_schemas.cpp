/// The schemas of https://docs.foxglove.dev/docs/sdk/schemas, with the used fields only.

#include <utility>

#include "render/export/foxglove.h"

namespace seam {
namespace {

using Fields = std::vector<std::pair<const char*, std::string>>;

std::string Type(const char* name) { return std::string("{\"type\":\"") + name + "\"}"; }

std::string Object(const char* title, const Fields& fields) {
  std::string properties;
  for (const auto& [name, type] : fields) {
    properties += (properties.empty() ? "\"" : ",\"") + std::string(name) + "\":" + type;
  }
  return std::string("{\"title\":\"") + title + "\",\"type\":\"object\",\"properties\":{" +
         properties + "}}";
}

std::string ListOf(const std::string& items) {
  return "{\"type\":\"array\",\"items\":" + items + "}";
}

std::string NumberOrNull() { return "{\"type\":[\"number\",\"null\"]}"; }

std::string Numbers(const char* title, const std::vector<const char*>& names) {
  Fields fields;
  for (const char* name : names) fields.emplace_back(name, Type("number"));
  return Object(title, fields);
}

std::string Time(const char* title) {
  return Object(title, {{"sec", Type("integer")}, {"nsec", Type("integer")}});
}

std::string Vector() { return Numbers("foxglove.Vector3", {"x", "y", "z"}); }
std::string Quaternion() { return Numbers("foxglove.Quaternion", {"x", "y", "z", "w"}); }
std::string Colour() { return Numbers("foxglove.Color", {"r", "g", "b", "a"}); }

std::string Frames() {
  return Object(
      "foxglove.FrameTransforms",
      {{"transforms", ListOf(Object("foxglove.FrameTransform", {{"timestamp", Time("time")},
                                                                {"parent_frame_id", Type("string")},
                                                                {"child_frame_id", Type("string")},
                                                                {"translation", Vector()},
                                                                {"rotation", Quaternion()}}))}});
}

std::string Lines() {
  const std::string point = Numbers("foxglove.Point3", {"x", "y", "z"});
  return Object(
      "foxglove.LinePrimitive",
      {{"type", Type("integer")},
       {"pose", Object("foxglove.Pose", {{"position", Vector()}, {"orientation", Quaternion()}})},
       {"thickness", Type("number")},
       {"scale_invariant", Type("boolean")},
       {"points", ListOf(point)},
       {"color", Colour()},
       {"colors", ListOf(Colour())},
       {"indices", ListOf(Type("integer"))}});
}

std::string SceneUpdate() {
  const std::string pair =
      Object("foxglove.KeyValuePair", {{"key", Type("string")}, {"value", Type("string")}});
  return Object(
      "foxglove.SceneUpdate",
      {{"deletions", ListOf(Object("foxglove.SceneEntityDeletion", {{"timestamp", Time("time")},
                                                                    {"type", Type("integer")},
                                                                    {"id", Type("string")}}))},
       {"entities", ListOf(Object("foxglove.SceneEntity", {{"timestamp", Time("time")},
                                                           {"frame_id", Type("string")},
                                                           {"id", Type("string")},
                                                           {"lifetime", Time("duration")},
                                                           {"frame_locked", Type("boolean")},
                                                           {"metadata", ListOf(pair)},
                                                           {"lines", ListOf(Lines())}}))}});
}

}  // namespace

FoxgloveSchema FrameTransformsSchema() { return {"foxglove.FrameTransforms", Frames()}; }
FoxgloveSchema SceneUpdateSchema() { return {"foxglove.SceneUpdate", SceneUpdate()}; }

FoxgloveSchema LogSchema() {
  return {"foxglove.Log", Object("foxglove.Log", {{"timestamp", Time("time")},
                                                  {"level", Type("integer")},
                                                  {"message", Type("string")},
                                                  {"name", Type("string")},
                                                  {"file", Type("string")},
                                                  {"line", Type("integer")}})};
}

FoxgloveSchema ErrorsSchema() {
  return {"seam2d.Errors",
          Object("seam2d.Errors", {{"tick", Type("integer")},
                                   {"rms_m", NumberOrNull()},
                                   {"max_m", NumberOrNull()},
                                   {"error_m", "{\"type\":\"object\",\"additionalProperties\":" +
                                                   NumberOrNull() + "}"}})};
}

FoxgloveSchema InputSchema() {
  return {"seam2d.Input", Object("seam2d.Input", {{"tick", Type("integer")},
                                                  {"drive", Type("number")},
                                                  {"lift", Type("number")},
                                                  {"buttons", Type("integer")}})};
}

}  // namespace seam
