#include "common/sync/edits/topology_snapshot.h"

#include <algorithm>
#include <utility>

namespace seam {
namespace {

std::size_t BytesOf(const Snapshot& m) {
  return kSnapshotBytes + kSnapshotEntryBytes * m.kind.size() +
         kSnapshotValueBytes * m.value.size() + m.text.size();
}

bool HasRoom(const Snapshot& m, const TopologyEntry& entry) {
  const std::size_t more = kSnapshotEntryBytes + kSnapshotValueBytes * ValuesOf(entry.kind);
  return BytesOf(m) + more + entry.text.size() <= kMessageBytesMax &&
         m.text.size() + entry.text.size() <= kEditTextBytesMax;
}

void Append(const TopologyEntry& entry, Snapshot* m) {
  const bool insert = entry.kind == TopologyEntry::Kind::kInsert;
  m->kind.push_back(static_cast<std::int8_t>(entry.kind));
  m->joint.push_back(entry.joint);
  m->a.push_back(
      static_cast<std::int32_t>(insert ? entry.text.size() : static_cast<std::size_t>(entry.a)));
  m->b.push_back(entry.b);
  const auto values = static_cast<std::ptrdiff_t>(ValuesOf(entry.kind));
  m->value.insert(m->value.end(), entry.value.begin(), entry.value.begin() + values);
  m->text += entry.text;
}

}  // namespace

std::vector<Snapshot> ToSnapshots(int revision, const std::vector<TopologyEntry>& entries) {
  std::vector<Snapshot> all(1);
  for (const TopologyEntry& entry : entries) {
    if (!HasRoom(all.back(), entry)) all.emplace_back();
    Append(entry, &all.back());
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].number = revision;
    all[i].part = static_cast<std::int32_t>(i);
    all[i].parts = static_cast<std::int32_t>(all.size());
  }
  return all;
}

Status SnapshotReader::Take(const Snapshot& part) {
  if (taken_ == 0) {
    parts_ = part.parts;
    revision_ = part.number;
  }
  if (part.part != taken_ || part.parts != parts_ || part.number != revision_) {
    return Status::Error("its parts do not follow each other");
  }
  std::vector<TopologyEntry> entries;
  Status status = ReadEntries(part, &entries);
  for (std::size_t i = 0; status.ok() && i < entries.size(); ++i) status = builder_.Add(entries[i]);
  if (!status.ok()) return status;
  ++taken_;
  return complete() ? builder_.Finish(revision_) : status;
}

Status ReadEntries(const Snapshot& part, std::vector<TopologyEntry>* entries) {
  std::size_t value = 0, text = 0;
  for (std::size_t i = 0; i < part.kind.size(); ++i) {
    if (part.kind[i] < 1 || part.kind[i] > static_cast<std::int8_t>(TopologyEntry::kKinds)) {
      return Status::Error("there is no such entry");
    }
    TopologyEntry entry;
    entry.kind = static_cast<TopologyEntry::Kind>(part.kind[i]);
    entry.joint = part.joint[i];
    entry.a = part.a[i];
    entry.b = part.b[i];
    const std::size_t values = ValuesOf(entry.kind);
    if (values > part.value.size() - value) return Status::Error("it lacks numbers");
    std::copy_n(part.value.begin() + static_cast<std::ptrdiff_t>(value), values,
                entry.value.begin());
    value += values;
    if (entry.kind == TopologyEntry::Kind::kInsert) {
      const auto bytes = static_cast<std::size_t>(std::max(entry.a, 0));
      if (bytes > part.text.size() - text) return Status::Error("it lacks text");
      entry.text = part.text.substr(text, bytes);
      text += bytes;
    }
    entries->push_back(std::move(entry));
  }
  const bool all = value == part.value.size() && text == part.text.size();
  return all ? Status::Ok() : Status::Error("it has more than its entries say");
}

}  // namespace seam
