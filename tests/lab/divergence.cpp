#include "tests/lab/divergence.h"

#include <cstring>
#include <set>
#include <utility>

namespace seam {
namespace {

struct FloatField {
  const char* name;
  const char* unit;
  std::vector<float> View::*values;
};
constexpr FloatField kFloatFields[] = {
    {"x", "m", &View::x},     {"y", "m", &View::y},     {"angle", "rad", &View::angle},
    {"vx", "m/s", &View::vx}, {"vy", "m/s", &View::vy}, {"spin", "rad/s", &View::spin}};

bool SameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Of body i of `a` and body j of `b`: fills field, unit and values of `d`. True when they differ.
bool BodyDiffers(const View& a, std::size_t i, const View& b, std::size_t j, RunDifference* d) {
  for (const FloatField& field : kFloatFields) {
    const float left = (a.*field.values)[i], right = (b.*field.values)[j];
    if (SameBits(left, right)) continue;
    d->field = field.name;
    d->unit = field.unit;
    d->a = left;
    d->b = right;
    return true;
  }
  const auto whole_differs = [d](const char* field, int left, int right) {
    if (left == right) return false;
    d->field = field;
    d->a = left;
    d->b = right;
    return true;
  };
  if (whole_differs("role", a.role[i], b.role[j])) return true;
  if (whole_differs("authority", a.authority[i], b.authority[j])) return true;
  return false;
}

/// The same of two views of a tick and peer; ids ascend in both.
bool ViewDiffers(const View& a, const View& b, RunDifference* d) {
  std::size_t i = 0, j = 0;
  while (i < a.id.size() || j < b.id.size()) {
    const bool only_a = j == b.id.size() || (i < a.id.size() && a.id[i] < b.id[j]);
    const bool only_b = !only_a && (i == a.id.size() || b.id[j] < a.id[i]);
    d->body = only_b ? b.id[j] : a.id[i];
    d->only_in_a = only_a;
    if (only_a || only_b || BodyDiffers(a, i, b, j, d)) return true;
    ++i;
    ++j;
  }
  return false;
}

const View* ViewOf(const Recording& recording, int peer, std::int64_t tick) {
  const auto views = recording.views.find(peer);
  if (views == recording.views.end()) return nullptr;
  const auto view = views->second.find(tick);
  return view == views->second.end() ? nullptr : &view->second;
}

/// Tick and peer of every view of either.
std::set<std::pair<std::int64_t, int>> Places(const Recording& a, const Recording& b, int wanted) {
  std::set<std::pair<std::int64_t, int>> places;
  for (const Recording* recording : {&a, &b}) {
    for (const auto& [peer, views] : recording->views) {
      if (wanted >= 0 && peer != wanted) continue;
      for (const auto& [tick, view] : views) places.emplace(tick, peer);
    }
  }
  return places;
}

}  // namespace

Comparison CompareViews(const Recording& a, const Recording& b, int peer, bool common) {
  Comparison result;
  for (const auto& [tick, who] : Places(a, b, peer)) {
    const View* left = ViewOf(a, who, tick);
    const View* right = ViewOf(b, who, tick);
    if (common && (left == nullptr || right == nullptr)) continue;
    RunDifference divergence;
    divergence.tick = tick;
    divergence.peer = who;
    divergence.only_in_a = right == nullptr;
    if (left == nullptr || right == nullptr || ViewDiffers(*left, *right, &divergence)) {
      result.first = divergence;
      return result;
    }
    ++result.equal_views;
  }
  return result;
}

}  // namespace seam
