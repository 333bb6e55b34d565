#include "common/sync/rest/rest_table.h"

#include <algorithm>
#include <utility>

#include "common/base/bytes.h"

namespace seam {
namespace {

template <class T>
std::uint64_t Add(const T& value, std::uint64_t hash) {
  return Fnv1a(&value, sizeof value, hash);
}

}  // namespace

void RestTable::Commit(int body, std::int32_t epoch, std::int64_t tick, const BodyState& pose) {
  RestRecord& record = records_[static_cast<std::size_t>(body)];
  record = {true, epoch, tick, pose};
  record.pose.velocity.setZero();
  record.pose.spin = 0;
  hashed_ = false;
}

void RestTable::Clear() {
  records_.assign(records_.size(), RestRecord{});
  hashed_ = false;
}

void RestTable::Remap(const std::vector<BodyOrigin>& origins) {
  std::vector<RestRecord> records;
  for (const BodyOrigin& origin : origins) {
    const bool same = origin.body >= 0 && origin.same;
    records.push_back(same ? at(origin.body) : RestRecord{});
  }
  records_ = std::move(records);
  hashed_ = false;
}

std::uint64_t RestTable::Hash(const World& world) const {
  if (hashed_) return hash_;
  std::uint64_t hash = Fnv1a("", 0);
  bool any = false;
  for (int body = 0; body < world.body_count(); ++body) {
    const RestRecord& record = at(body);
    if (!record.committed) continue;
    any = true;
    hash = Add(world.id(body), hash);
    hash = Add(record.epoch, hash);
    hash = Add(record.pose.position.x(), hash);
    hash = Add(record.pose.position.y(), hash);
    hash = Add(record.pose.angle, hash);
  }
  hashed_ = true;
  hash_ = any ? hash : 0;
  return hash_;
}

std::vector<Rest> RestTable::Pack(const World& world, int peer, std::vector<int> bodies) const {
  std::stable_sort(bodies.begin(), bodies.end(),
                   [this](int a, int b) { return at(a).tick < at(b).tick; });
  std::vector<Rest> out;
  for (const int body : bodies) {
    const RestRecord& record = at(body);
    if (out.empty() || out.back().tick != record.tick || out.back().id.size() >= kRestBodiesMax) {
      out.emplace_back();
      out.back().peer = peer;
      out.back().tick = record.tick;
      out.back().revision = world.topology().revision();
      out.back().composition = static_cast<std::int64_t>(world.composition().hash);
    }
    Rest& rest = out.back();
    rest.id.push_back(world.id(body));
    rest.epoch.push_back(record.epoch);
    rest.x.push_back(record.pose.position.x());
    rest.y.push_back(record.pose.position.y());
    rest.angle.push_back(record.pose.angle);
  }
  return out;
}

}  // namespace seam
