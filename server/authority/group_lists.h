#pragma once
/// Members of each group, in flat arrays.

#include <vector>

namespace seam {

class GroupLists {
 public:
  /// `lowest`: by member, the lowest member of its group, which serves as the group's number.
  explicit GroupLists(const std::vector<int>& lowest)
      : begin_(lowest.size() + 1, 0), members_(lowest.size()) {
    for (const int g : lowest) ++begin_[static_cast<std::size_t>(g) + 1];
    for (std::size_t g = 0; g < lowest.size(); ++g) begin_[g + 1] += begin_[g];
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t m = 0; m < lowest.size(); ++m) {
      const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(lowest[m])]++);
      members_[at] = static_cast<int>(m);
    }
  }

  /// Group numbers are below this.
  std::size_t count() const { return members_.size(); }
  /// 0: there is no group of that number.
  std::size_t SizeOf(std::size_t group) const {
    return static_cast<std::size_t>(begin_[group + 1] - begin_[group]);
  }
  /// Members of a group, ascending.
  struct Members {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };
  Members Of(std::size_t group) const {
    return {members_.data() + begin_[group], members_.data() + begin_[group + 1]};
  }

 private:
  std::vector<int> begin_, members_;
};

}  // namespace seam
