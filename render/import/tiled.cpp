#include <tinyxml2.h>

#include <cmath>
#include <cstdlib>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "render/import/imported.h"

namespace seam {
namespace {

using Eigen::Vector2d;
using tinyxml2::XMLElement;

/// Points on the outline of an ellipse: its corners are then 1 % of the radius off.
constexpr int kEllipsePoints = 24;
/// Nested groups of layers; the editor's users have two or three.
constexpr int kGroupsMax = 20;

class TiledReader {
 public:
  TiledReader(const std::string& file, double pixels) : file_(file), pixels_(pixels) {}

  Imported Read(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw OperatorError(file_ + ":" + std::to_string(document.ErrorLineNum()) +
                          ": is no XML: " + document.ErrorName());
    }
    const XMLElement* map = document.FirstChildElement("map");
    if (map == nullptr) throw OperatorError(file_ + ": has no <map>: is this a Tiled map?");
    height_ = Number(*map, "height", 0) * Number(*map, "tileheight", 0);
    NoteDropped(*map);
    ReadLayers(*map, {0, 0}, 0);
    if (world_.bodies.empty()) throw OperatorError(file_ + ": has no objects");
    return std::move(world_);
  }

 private:
  [[noreturn]] void Fail(const XMLElement& at, const std::string& why) const {
    throw OperatorError(file_ + ":" + std::to_string(at.GetLineNum()) + ": " + why);
  }

  double Number(const XMLElement& element, const char* key, double fallback) const {
    const char* text = element.Attribute(key);
    if (text == nullptr) return fallback;
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (end == text || *end != 0 || !(std::fabs(value) < 1e9)) {
      Fail(element, std::string(key) + " is no number");
    }
    return value;
  }

  /// Lists what places objects otherwise than they are placed here.
  void NoteDropped(const XMLElement& map) {
    const auto text = [](const XMLElement& element, const char* key) {
      const char* value = element.Attribute(key);
      return std::string(value != nullptr ? value : "");
    };
    const std::string orientation = text(map, "orientation");
    if (!orientation.empty() && orientation != "orthogonal") {
      world_.dropped.push_back("map: is " + orientation +
                               "; objects stand as on an orthogonal one");
    }
    for (const XMLElement* e = map.FirstChildElement("tileset"); e != nullptr;
         e = e->NextSiblingElement("tileset")) {
      const std::string alignment = text(*e, "objectalignment");
      if (alignment.empty() || alignment == "unspecified" || alignment == "bottomleft") continue;
      world_.dropped.push_back("tileset '" + text(*e, "name") + "': objects aligned " + alignment +
                               "; here by their lower left corner");
    }
  }

  void ReadLayers(const XMLElement& parent, const Vector2d& shift, int depth) {
    if (depth > kGroupsMax) Fail(parent, "nested too deeply");
    for (const XMLElement* e = parent.FirstChildElement(); e != nullptr;
         e = e->NextSiblingElement()) {
      const std::string name = e->Name();
      const Vector2d at = shift + Vector2d(Number(*e, "offsetx", 0), Number(*e, "offsety", 0));
      const std::string label = e->Attribute("name") != nullptr ? e->Attribute("name") : "";
      if (name == "group") {
        ReadLayers(*e, at, depth + 1);
      } else if (name == "objectgroup") {
        of_layer_ = e->FirstChildElement("properties");
        for (const XMLElement* o = e->FirstChildElement("object"); o != nullptr;
             o = o->NextSiblingElement("object")) {
          ReadObject(*o, at);
        }
      } else if (name == "layer" || name == "imagelayer") {
        world_.dropped.push_back("layer '" + label + "': only objects are read");
      }
    }
  }

  /// Returns the value of a custom property, or of the same property of its layer; "" if neither.
  std::string Property(const XMLElement& object, const std::string& key) const {
    for (const XMLElement* list : {object.FirstChildElement("properties"), of_layer_}) {
      if (list == nullptr) continue;
      for (const XMLElement* p = list->FirstChildElement("property"); p != nullptr;
           p = p->NextSiblingElement("property")) {
        const char* name = p->Attribute("name");
        const char* value = p->Attribute("value");
        if (name != nullptr && value != nullptr && name == key) return value;
      }
    }
    return "";
  }
  double NumberProperty(const XMLElement& object, const char* key, double fallback) const {
    const std::string text = Property(object, key);
    if (text.empty()) return fallback;
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (*end != 0 || !std::isfinite(value)) Fail(object, std::string(key) + " is no number");
    return value;
  }

  /// Turns y up and divides by the scale.
  Vector2d Local(double x, double y) const { return Vector2d(x, -y) / pixels_; }

  std::vector<Vector2d> PointsOf(const XMLElement& outline) const {
    std::vector<Vector2d> points;
    const char* at = outline.Attribute("points");
    while (at != nullptr && *at != 0) {
      char* end = nullptr;
      const double x = std::strtod(at, &end);
      if (*end != ',') Fail(outline, "points must be x,y pairs");
      const char* second = end + 1;
      const double y = std::strtod(second, &end);
      if (end == second || !std::isfinite(x) || !std::isfinite(y)) {
        Fail(outline, "points must be x,y pairs");
      }
      points.push_back(Local(x, y));
      at = end;
      while (*at == ' ') ++at;
    }
    return points;
  }

  void ReadObject(const XMLElement& object, const Vector2d& shift) {
    const char* id = object.Attribute("id");
    const char* name = object.Attribute("name");
    const std::string label = name != nullptr && *name != 0 ? name
                              : id != nullptr               ? std::string("object-") + id
                                                            : "object";
    const double width = Number(object, "width", 0), height = Number(object, "height", 0);
    const auto drop = [&](const std::string& why) {
      world_.dropped.push_back("object '" + label + "': " + why);
    };
    for (const char* other : {"point", "text"}) {
      if (object.FirstChildElement(other) != nullptr) return drop(std::string("a ") + other);
    }
    if (object.Attribute("template") != nullptr) return drop("from a template file");
    ImportedBody body;
    const std::string type = Property(object, "body");
    if (!type.empty() && type != "static" && type != "dynamic" && type != "kinematic") {
      Fail(object, "body must be static, dynamic or kinematic");
    }
    body.kind = type == "dynamic"     ? ImportedBody::Kind::kDynamic
                : type == "kinematic" ? ImportedBody::Kind::kKinematic
                                      : ImportedBody::Kind::kStatic;
    body.name = label;
    body.position =
        Local(Number(object, "x", 0) + shift.x(), Number(object, "y", 0) + shift.y() - height_);
    body.angle = -Number(object, "rotation", 0) * kPi / 180;
    ImportedShape shape;
    shape.density = NumberProperty(object, "density", 1);
    shape.friction = NumberProperty(object, "friction", 0.5);
    shape.restitution = NumberProperty(object, "restitution", 0);
    const XMLElement* polygon = object.FirstChildElement("polygon");
    const XMLElement* polyline = object.FirstChildElement("polyline");
    if (polygon != nullptr) {
      shape.points = PointsOf(*polygon);
    } else if (polyline != nullptr) {
      shape.kind = ImportedShape::Kind::kTwoSidedChain;
      shape.points = PointsOf(*polyline);
    } else if (width <= 0 || height <= 0) {
      return drop("has no size");
    } else if (object.FirstChildElement("ellipse") != nullptr) {
      SetEllipse(width, height, &shape);
    } else {
      // A tile's origin is its lower left corner, a rectangle's its upper left.
      const double up = object.Attribute("gid") != nullptr ? height : 0;
      shape.points = {Local(0, -up), Local(width, -up), Local(width, height - up),
                      Local(0, height - up)};
    }
    body.shapes.push_back(shape);
    world_.bodies.push_back(body);
  }

  void SetEllipse(double width, double height, ImportedShape* shape) const {
    const Vector2d centre = Local(width / 2, height / 2);
    if (std::fabs(width - height) < 1e-6 * width) {
      shape->kind = ImportedShape::Kind::kCircle;
      shape->centre = centre;
      shape->radius = width / 2 / pixels_;
      return;
    }
    for (int i = 0; i < kEllipsePoints; ++i) {
      const double turn = 2 * kPi * i / kEllipsePoints;
      shape->points.push_back(centre + Vector2d(width * std::cos(turn), height * std::sin(turn)) /
                                           (2 * pixels_));
    }
  }

  const std::string& file_;
  const double pixels_;
  double height_ = 0;  // of the map, pixels: its lower edge is y = 0
  Imported world_;
  const XMLElement* of_layer_ = nullptr;  // the properties of the layer that is read; null: none
};

}  // namespace

Imported ReadTiled(const std::string& text, const std::string& file, double pixels) {
  return TiledReader(file, pixels).Read(text);
}

}  // namespace seam
