#include "common/physics/assembly.h"

#include <algorithm>
#include <numeric>

#include "common/base/bytes.h"

namespace seam {
namespace {

/// Union-find over 0..n-1.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
    return i;
  }
  void Join(int a, int b) {
    const int ra = Find(a);
    const int rb = Find(b);
    parent_[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
  }

 private:
  std::vector<int> parent_;
};

}  // namespace

float PartMass(const Part& part) {
  double area = 0;
  switch (part.kind) {
    case ShapeKind::kBox: area = static_cast<double>(part.size.x()) * part.size.y(); break;
    case ShapeKind::kCircle: area = 3.14159265358979 * part.radius * part.radius; break;
    case ShapeKind::kPolygon:
      for (std::size_t i = 0; i < part.points.size(); ++i) {
        const Vec2& p = part.points[i];
        const Vec2& q = part.points[(i + 1) % part.points.size()];
        area += 0.5 * (static_cast<double>(p.x()) * q.y() - static_cast<double>(q.x()) * p.y());
      }
      area = std::abs(area);
      break;
    case ShapeKind::kChain: break;
  }
  return static_cast<float>(area * part.material.density);
}

Composition Compose(const Scene& scene) {
  Composition out;
  const std::size_t count = scene.parts.size();
  Groups welded(count);
  for (const Joint& j : scene.joints) {
    if (j.kind == JointKind::kWeld) welded.Join(j.a, j.b);
  }
  std::vector<std::vector<PartId>> groups(count);
  for (std::size_t i = 0; i < count; ++i) {
    groups[static_cast<std::size_t>(welded.Find(static_cast<int>(i)))].push_back(
        static_cast<PartId>(i));
  }
  for (const std::vector<PartId>& parts : groups) {
    if (parts.empty()) continue;
    Assembly a;
    a.parts = parts;
    a.id = parts.front();
    for (PartId p : parts) {
      const Part& part = scene.parts[static_cast<std::size_t>(p)];
      a.anchored = a.anchored || part.anchored;
      if (PartMass(part) > PartMass(scene.parts[static_cast<std::size_t>(a.id)])) a.id = p;
    }
    out.assemblies.push_back(a);
  }
  std::sort(out.assemblies.begin(), out.assemblies.end(),
            [](const Assembly& a, const Assembly& b) { return a.id < b.id; });
  out.assembly_of_part.assign(count, -1);
  for (std::size_t i = 0; i < out.assemblies.size(); ++i) {
    for (PartId p : out.assemblies[i].parts) {
      out.assembly_of_part[static_cast<std::size_t>(p)] = static_cast<int>(i);
    }
  }
  Groups jointed(out.assemblies.size());
  for (const Joint& j : scene.joints) {
    if (j.kind == JointKind::kWeld) continue;
    const int a = out.assembly_of_part[static_cast<std::size_t>(j.a)];
    const int b = out.assembly_of_part[static_cast<std::size_t>(j.b)];
    if (out.assemblies[static_cast<std::size_t>(a)].anchored) continue;
    if (out.assemblies[static_cast<std::size_t>(b)].anchored) continue;
    jointed.Join(a, b);
  }
  std::vector<int> mechanism_of(out.assemblies.size(), -1);
  for (std::size_t i = 0; i < out.assemblies.size(); ++i) {
    if (out.assemblies[i].anchored) continue;
    const auto lead = static_cast<std::size_t>(jointed.Find(static_cast<int>(i)));
    if (mechanism_of[lead] < 0) {
      mechanism_of[lead] = static_cast<int>(out.mechanisms.size());
      out.mechanisms.emplace_back();
      out.mechanisms.back().id = out.assemblies[i].id;
    }
    out.assemblies[i].mechanism = mechanism_of[lead];
    out.mechanisms[static_cast<std::size_t>(mechanism_of[lead])].assemblies.push_back(
        static_cast<int>(i));
  }
  for (Mechanism& m : out.mechanisms) {
    PartId lowest = -1;
    for (int a : m.assemblies) {
      for (PartId p : out.assemblies[static_cast<std::size_t>(a)].parts) {
        const int owner = scene.parts[static_cast<std::size_t>(p)].owner;
        if (owner >= 0 && (lowest < 0 || p < lowest)) {
          lowest = p;
          m.owner = owner;
        }
      }
    }
  }
  std::uint64_t hash = Fnv1a("seam", 4);
  for (const Assembly& a : out.assemblies) {
    hash = Fnv1a(&a.id, sizeof a.id, hash);
    hash = Fnv1a(&a.mechanism, sizeof a.mechanism, hash);
    hash = Fnv1a(a.parts.data(), a.parts.size() * sizeof(PartId), hash);
  }
  out.hash = hash;
  return out;
}

}  // namespace seam
