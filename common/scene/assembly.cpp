#include "common/scene/assembly.h"

#include <algorithm>
#include <map>

#include "common/base/bytes.h"
#include "common/base/disjoint_sets.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

std::vector<Assembly> WeldParts(const Scene& scene) {
  DisjointSets sets(scene.parts.size());
  for (const Joint& joint : scene.joints) {
    if (!joint.gone && IsRigid(joint, scene.solver)) sets.Unite(joint.a, joint.b);
  }
  std::map<int, Assembly> welded;
  for (const Part& part : scene.parts) {
    if (part.gone) continue;
    Assembly& assembly = welded[sets.Find(part.id)];
    const bool heavier =
        assembly.parts.empty() ||
        PartMass(part) > PartMass(scene.parts[static_cast<std::size_t>(assembly.id)]);
    if (heavier) assembly.id = part.id;
    assembly.anchored = assembly.anchored || part.anchored;
    assembly.parts.push_back(part.id);
  }
  std::vector<Assembly> assemblies;
  for (auto& [name, assembly] : welded) assemblies.push_back(std::move(assembly));
  std::sort(assemblies.begin(), assemblies.end(),
            [](const Assembly& x, const Assembly& y) { return x.id < y.id; });
  return assemblies;
}

int OwnerOf(const Scene& scene, const Composition& composition, const Mechanism& mechanism) {
  std::vector<PartId> parts;
  for (const int assembly : mechanism.assemblies) {
    const auto& members = composition.assemblies[static_cast<std::size_t>(assembly)].parts;
    parts.insert(parts.end(), members.begin(), members.end());
  }
  std::sort(parts.begin(), parts.end());
  for (const PartId part : parts) {
    const int owner = scene.parts[static_cast<std::size_t>(part)].owner;
    if (owner >= 0) return owner;
  }
  return -1;
}

void JoinAssemblies(const Scene& scene, Composition* composition) {
  std::vector<Assembly>& assemblies = composition->assemblies;
  DisjointSets sets(assemblies.size());
  for (const Joint& joint : scene.joints) {
    if (joint.gone) continue;
    const int a = composition->assembly_of_part[static_cast<std::size_t>(joint.a)];
    const int b = composition->assembly_of_part[static_cast<std::size_t>(joint.b)];
    const bool both_move = !assemblies[static_cast<std::size_t>(a)].anchored &&
                           !assemblies[static_cast<std::size_t>(b)].anchored;
    if (both_move) sets.Unite(a, b);
  }
  // A set is named by its lowest index, and indices ascend with ids: mechanisms come out ascending.
  std::map<int, int> mechanism_of_set;
  for (std::size_t i = 0; i < assemblies.size(); ++i) {
    if (assemblies[i].anchored) continue;
    const int set = sets.Find(static_cast<int>(i));
    const auto [found, added] =
        mechanism_of_set.emplace(set, static_cast<int>(composition->mechanisms.size()));
    if (added) {
      composition->mechanisms.push_back({});
      composition->mechanisms.back().id = assemblies[i].id;
    }
    assemblies[i].mechanism = found->second;
    composition->mechanisms[static_cast<std::size_t>(found->second)].assemblies.push_back(
        static_cast<int>(i));
  }
  for (Mechanism& mechanism : composition->mechanisms) {
    mechanism.owner = OwnerOf(scene, *composition, mechanism);
  }
}

std::uint64_t HashOf(const Composition& composition) {
  std::uint64_t hash = Fnv1a(nullptr, 0);
  const auto add = [&hash](std::int32_t value) {
    // Byte by byte, lowest first: the same on every machine.
    for (int shift = 0; shift < 32; shift += 8) {
      const auto byte = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> shift);
      hash = Fnv1a(&byte, 1, hash);
    }
  };
  add(static_cast<std::int32_t>(composition.assemblies.size()));
  for (const Assembly& assembly : composition.assemblies) {
    add(assembly.id);
    add(assembly.anchored ? 1 : 0);
    add(assembly.mechanism);
    add(static_cast<std::int32_t>(assembly.parts.size()));
    for (const PartId part : assembly.parts) add(part);
  }
  add(static_cast<std::int32_t>(composition.mechanisms.size()));
  for (const Mechanism& mechanism : composition.mechanisms) {
    add(mechanism.id);
    add(mechanism.owner);
    add(static_cast<std::int32_t>(mechanism.assemblies.size()));
    for (const int assembly : mechanism.assemblies) add(assembly);
  }
  for (const int assembly : composition.assembly_of_part) add(assembly);
  return hash;
}

}  // namespace

float PartMass(const Part& part) { return static_cast<float>(PartProperties(part).mass); }

Composition Compose(const Scene& scene) {
  Composition composition;
  composition.assemblies = WeldParts(scene);
  composition.assembly_of_part.assign(scene.parts.size(), -1);
  for (std::size_t i = 0; i < composition.assemblies.size(); ++i) {
    for (const PartId part : composition.assemblies[i].parts) {
      composition.assembly_of_part[static_cast<std::size_t>(part)] = static_cast<int>(i);
    }
  }
  JoinAssemblies(scene, &composition);
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    if (scene.joints[i].gone || HoldOf(scene.joints[i].kind) != JointHold::kImposed) continue;
    const auto part = static_cast<std::size_t>(scene.joints[i].b);
    const auto assembly = static_cast<std::size_t>(composition.assembly_of_part[part]);
    if (composition.assembly_of_part[part] < 0) continue;
    Assembly& moved = composition.assemblies[assembly];
    if (moved.anchored) moved.kinematic = static_cast<int>(i);
  }
  composition.hash = HashOf(composition);
  return composition;
}

std::vector<int> BodyOfAssembly(const Composition& composition) {
  std::vector<int> bodies;
  int next = 0;
  for (const Assembly& a : composition.assemblies) bodies.push_back(a.anchored ? -1 : next++);
  return bodies;
}

}  // namespace seam
