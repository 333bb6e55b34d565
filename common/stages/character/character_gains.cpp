#include "common/stages/character/character_gains.h"

namespace seam {
namespace {

struct NamedGain {
  const char* name;
  float CharacterGains::*gain;
};

constexpr NamedGain kGains[] = {
#define SEAM_GAIN(name, value) {#name, &CharacterGains::name},
#include "common/stages/character/character_gains.inc"
#undef SEAM_GAIN
};

}  // namespace

std::vector<std::string> GainNames() {
  std::vector<std::string> names;
  for (const NamedGain& each : kGains) names.emplace_back(each.name);
  return names;
}

float* FindGain(CharacterGains* gains, const std::string& name) {
  for (const NamedGain& each : kGains) {
    if (name == each.name) return &(gains->*each.gain);
  }
  return nullptr;
}

}  // namespace seam
