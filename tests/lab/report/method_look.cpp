#include "tests/lab/report/method_look.h"

#include <array>
#include <cstddef>

#include "common/base/bytes.h"

namespace seam {
namespace {

struct Known {
  const char* name;
  Look look;
};

/// Colours of Okabe and Ito ("Color Universal Design", 2008), without their yellow, which is
/// too light for a line on white; no two have colour and dash in common.
const std::array<Known, 13>& Methods() {
  static const std::array<Known, 13> methods = {{
      {"oracle", {"#999999", "solid", 1.0, 0, 0.6}},
      {"central", {"#000000", "solid", 1.5, 4, 0.7}},
      {"central/own", {"#000000", "(6,3)", 1.5, 4, 0.7}},
      {"central/all", {"#000000", "solid", 2.0, 3, 0.7}},
      {"strict", {"#000000", "(2,3)", 1.5, 1, 0.7}},
      {"snap", {"#999999", "(6,3)", 1.5, 2, 0.7}},
      {"interleave", {"#56b4e9", "(8,4)", 1.5, 6, 0.6}},
      {"compensated", {"#e69f00", "(8,3,2,3)", 1.5, 10, 0.7}},
      {"fade", {"#009e73", "solid", 1.7, 9, 0.7}},
      {"spring", {"#cc79a7", "solid", 1.5, 14, 0.7}},
      {"retrospect", {"#d55e00", "(8,3)", 1.7, 7, 0.7}},
      {"rollback", {"#d55e00", "solid", 2.6, 13, 0.7}},
      {"buffer", {"#d55e00", "(2,2)", 1.5, 7, 0.5}},
  }};
  return methods;
}

std::string Base(const std::string& method) { return method.substr(0, method.find(", ")); }

}  // namespace

Look MethodLook(const std::string& method) {
  const std::string base = Base(method);
  for (const Known& known : Methods()) {
    if (base != known.name) continue;
    Look look = known.look;
    if (base != method) look.dash = "(1,2)";
    return look;
  }
  const std::array<const char*, 3> spare = {"#8b4513", "#708090", "#556b2f"};
  return {spare[Fnv1a(method.data(), method.size()) % spare.size()], "(4,2)", 1.5, 3, 0.7};
}

std::vector<std::string> KnownMethods() {
  std::vector<std::string> names;
  for (const Known& known : Methods()) names.push_back(known.name);
  return names;
}

int MethodOrder(const std::string& method) {
  const std::string base = Base(method);
  const auto& methods = Methods();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (base == methods[i].name) return static_cast<int>(i);
  }
  return static_cast<int>(methods.size());
}

}  // namespace seam
