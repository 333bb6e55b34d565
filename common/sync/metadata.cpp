#include "common/sync/metadata.h"

#include <cfloat>
#include <cmath>

#include "common/base/check.h"
#include "common/base/state_archive.h"

namespace seam {
namespace {

void Append(const MetaKey& key, float value, std::int64_t utime, std::int64_t tick,
            std::vector<Meta>* messages) {
  if (messages->empty() || messages->back().id.size() == kMetaMax) {
    messages->emplace_back();
    messages->back().utime = utime;
    messages->back().tick = tick;
  }
  Meta& m = messages->back();
  m.kind.push_back(key.kind);
  m.id.push_back(key.id);
  m.key.push_back(key.key);
  m.value.push_back(value);
}

}  // namespace

float MetaTable::Get(const MetaKey& key) const {
  const auto found = values_.find(key);
  return found != values_.end() ? found->second : 0;
}

void MetaTable::Set(const MetaKey& key, float value) {
  SEAM_ASSERT(std::isfinite(value));
  values_[key] = value;
}

void MetaTable::Apply(const Meta& meta) {
  for (std::size_t i = 0; i < meta.id.size(); ++i) {
    values_[{meta.kind[i], meta.id[i], meta.key[i]}] = meta.value[i];
  }
}

void MetaTable::Announce(const Meta& meta) {
  Apply(meta);
  for (std::size_t i = 0; i < meta.id.size(); ++i) {
    told_[{meta.kind[i], meta.id[i], meta.key[i]}] = meta.value[i];
  }
}

std::vector<Meta> MetaTable::TakeChanges(std::int64_t utime, std::int64_t tick) {
  std::vector<Meta> messages;
  for (const auto& [key, value] : values_) {
    const auto told = told_.find(key);
    if (told != told_.end() && told->second == value) continue;
    told_[key] = value;
    Append(key, value, utime, tick, &messages);
  }
  return messages;
}

std::vector<Meta> MetaTable::Export(std::int64_t utime, std::int64_t tick) const {
  std::vector<Meta> messages;
  for (const auto& [key, value] : values_) Append(key, value, utime, tick, &messages);
  return messages;
}

void MetaTable::Persist(StateArchive& a) {
  a.Section("metadata");
  a.Entries(
      &values_, static_cast<std::size_t>(kIdsMax),
      [&](MetaKey* key) {
        a.Int(&key->kind, kMetaPart, kMetaPlayer);
        a.Int(&key->id, 0, kIdsMax - 1);
        a.Int(&key->key, 0, kMetaKeyMax);
      },
      [&](float* value) { a.Real(value, FLT_MAX); });
  if (a.reading()) told_ = values_;
}

}  // namespace seam
