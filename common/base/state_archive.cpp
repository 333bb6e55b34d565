#include "common/base/state_archive.h"

namespace seam {

Bytes StateDraft::Finish() {
  if (gaps_.empty()) return std::move(bytes_);
  Bytes all;
  std::size_t from = 0;
  const auto copy_to = [&](std::size_t end) {
    const auto begin = bytes_.begin();
    all.insert(all.end(), begin + static_cast<std::ptrdiff_t>(from),
               begin + static_cast<std::ptrdiff_t>(end));
    from = end;
  };
  for (const Gap& gap : gaps_) {
    copy_to(gap.at);
    StateArchive a;
    gap.write(a);
    const Bytes part = a.Take();
    all.insert(all.end(), part.begin(), part.end());
  }
  copy_to(bytes_.size());
  return all;
}

StateDraft StateArchive::TakeDraft() {
  StateDraft draft;
  to_.resize(used_);
  used_ = 0;
  draft.bytes_ = std::exchange(to_, {});
  draft.gaps_ = std::exchange(gaps_, {});
  return draft;
}

void StateArchive::Later(std::function<void(StateArchive&)> write) {
  SEAM_ASSERT(!reading_);
  gaps_.push_back({used_, std::move(write)});
}

void StateArchive::Grow(std::size_t size) {
  to_.resize(std::max<std::size_t>(4096, 2 * (used_ + size)));
}

bool StateArchive::Get(void* data, std::size_t size) {
  if (!ok()) return false;
  if (size > left()) {
    Fail("it ends too early");
    return false;
  }
  std::memcpy(data, from_.data + at_, size);
  at_ += size;
  return true;
}

void StateArchive::Section(const char* name) {
  section_ = name;
  std::uint64_t mark = Fnv1a(name, std::strlen(name));
  if (!reading_) return Put(&mark, sizeof mark);
  std::uint64_t read = 0;
  if (Get(&read, sizeof read)) Require(read == mark, "it does not begin here");
}

void StateArchive::Require(bool condition, const char* what) {
  if (condition) return;
  SEAM_ASSERT(reading_);
  Fail(what);
}

void StateArchive::Fail(const std::string& what) {
  if (ok()) status_ = Status::Error(std::string(section_) + ": " + what);
}

void StateArchive::Flag(bool* value) {
  std::uint8_t byte = *value ? 1 : 0;
  Int(&byte, 0, 1);
  *value = byte != 0;
}

void StateArchive::Word(std::uint64_t* value) {
  if (!reading_) return Put(value, sizeof *value);
  if (!Get(value, sizeof *value)) *value = 0;
}

void StateArchive::Real(float* value, float most) {
  if (!reading_) return Put(value, sizeof *value);
  float read = 0;
  if (!Get(&read, sizeof read)) return Zero(value);
  Require(std::fabs(read) <= most, "a number is out of range");  // false for NaN
  *value = ok() ? read : 0;
}

void StateArchive::Real(double* value, double most) {
  if (!reading_) return Put(value, sizeof *value);
  double read = 0;
  if (!Get(&read, sizeof read)) return Zero(value);
  Require(std::fabs(read) <= most, "a number is out of range");
  *value = ok() ? read : 0;
}

void StateArchive::Text(std::string* text, std::size_t most) {
  const std::size_t size = Count(text->size(), most);
  if (!reading_) return Put(text->data(), size);
  text->assign(size, '\0');
  if (size > 0 && !Get(&(*text)[0], size)) text->clear();
}

std::size_t StateArchive::Count(std::size_t count, std::size_t most) {
  auto number = static_cast<std::uint32_t>(count);
  Int(&number, 0, static_cast<std::int64_t>(most));
  if (reading_) Require(number <= left(), "a list is longer than all that follows");
  return ok() ? number : 0;
}

}  // namespace seam
