#pragma once
/// What counts once: the keys of a join, and connect tokens. Each is remembered until it would be
/// too old to count again, so the memory is bounded by the joins of that time.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

namespace seam {

class UsedOnce {
 public:
  /// First bytes of something that cannot be guessed.
  using Tag = std::array<std::uint8_t, 16>;
  static Tag TagOf(const std::uint8_t* bytes) {
    Tag tag;
    std::copy(bytes, bytes + tag.size(), tag.begin());
    return tag;
  }

  bool Has(const Tag& tag) const { return used_.count(tag) != 0; }
  /// Notes it. It may be forgotten from `until_us` on.
  void Note(std::int64_t now_us, const Tag& tag, std::int64_t until_us) {
    if (now_us >= sweep_us_) {
      for (auto it = used_.begin(); it != used_.end();) {
        it = it->second <= now_us ? used_.erase(it) : std::next(it);
      }
      sweep_us_ = now_us + kForgetUs;
    }
    used_[tag] = until_us;
  }

 private:
  static constexpr std::int64_t kForgetUs = 1000000;
  std::map<Tag, std::int64_t> used_;
  std::int64_t sweep_us_ = 0;
};

}  // namespace seam
