#include "common/sync/rest/rest_table.h"

#include <algorithm>
#include <numeric>

#include "common/base/bytes.h"
#include "common/scene/saved/persist_state.h"

namespace seam {
namespace {

template <class T>
std::uint64_t Add(const T& value, std::uint64_t hash) {
  static_assert(sizeof value == 4);
  return Fnv1a(&value, sizeof value, hash);
}

/// Hashes of bodies are added up, so each must be well mixed by itself: the last steps of
/// MurmurHash3's finalizer (Appleby, public domain) let every bit affect all lower ones too. Never
/// 0 for a body.
std::uint64_t HashOfBody(PartId id, const RestRecord& record) {
  std::uint64_t hash = Add(record.epoch, Add(id, Fnv1a("", 0)));
  hash = Add(record.pose.position.y(), Add(record.pose.position.x(), hash));
  hash = Add(record.pose.angle, hash);
  hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdULL;
  hash ^= hash >> 33;
  return hash == 0 ? 1 : hash;
}

}  // namespace

RestTable::RestTable(const BodyTable& table)
    : records_(table, BodyRule::kSame),  // an unchanged body keeps its id
      hashes_(table, BodyRule::kSame, 0),
      edited_(table, [this](const BodyRemap&) {
        sum_ = std::accumulate(hashes_.begin(), hashes_.end(), std::uint64_t{0});
      }) {}

void RestTable::SetHash(int body, std::uint64_t hash) {
  std::uint64_t& known = hashes_[body];
  sum_ += hash - known;
  known = hash;
}

void RestTable::Commit(int body, PartId id, std::int32_t epoch, std::int64_t tick,
                       const BodyState& pose) {
  RestRecord& record = records_[body];
  record = {true, epoch, tick, pose};
  record.pose.velocity.setZero();
  record.pose.spin = 0;
  SetHash(body, HashOfBody(id, record));
}

void RestTable::End(int body) {
  records_[body].committed = false;
  SetHash(body, 0);
}

void RestTable::Clear() {
  records_.Reset();
  hashes_.Reset();
  sum_ = 0;
}

std::vector<Rest> RestTable::Pack(const World& world, int peer, std::vector<int> bodies,
                                  std::int64_t least_tick) const {
  const auto tick = [&](int body) { return std::max(at(body).tick, least_tick); };
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) { return tick(a) < tick(b); });
  std::vector<Rest> out;
  for (const int body : bodies) {
    const RestRecord& record = at(body);
    if (out.empty() || out.back().tick != tick(body) || out.back().id.size() >= kRestBodiesMax) {
      out.emplace_back();
      out.back().peer = peer;
      out.back().tick = tick(body);
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

void RestTable::Persist(StateArchive& a, const World& world) {
  a.Section("rest");
  a.Exactly(&records_, [&](RestRecord* record) {
    a.Flag(&record->committed);
    a.Int(&record->epoch, 0, INT32_MAX);
    a.Tick(&record->tick);
    seam::Persist(a, &record->pose);
  });
  for (int body = 0; a.reading() && body < records_.size(); ++body) {
    if (at(body).committed) SetHash(body, HashOfBody(world.id(body), at(body)));
  }
}

}  // namespace seam
