#pragma once
/// A sequence in pages that copies share: what nothing has changed is neither copied nor read
/// again.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "common/base/check.h"

namespace seam {

/// Pages are never changed once they are shared; whoever changes one makes it anew (Remake).
template <class T>
class Paged {
 public:
  static constexpr std::size_t kPage = 32;  ///< elements of a page
  using Page = std::array<T, kPage>;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return (*pages_[i / kPage])[i % kPage]; }
  std::size_t page_count() const { return pages_.size(); }
  /// Whether both have the same page there, so that it is equal.
  bool Shares(const Paged& other, std::size_t page) const {
    return page < other.pages_.size() && pages_[page] == other.pages_[page];
  }
  /// Elements before `end(page)` and from `begin(page)` on are those of a page.
  std::size_t begin(std::size_t page) const { return page * kPage; }
  std::size_t end(std::size_t page) const {
    const std::size_t last = (page + 1) * kPage;
    return last < size_ ? last : size_;
  }

  /// As many elements as that, none known: every page has to be made.
  void Resize(std::size_t size) {
    size_ = size;
    pages_.assign((size + kPage - 1) / kPage, nullptr);
  }
  void Take(const std::vector<T>& all) {
    Resize(all.size());
    for (std::size_t page = 0; page < pages_.size(); ++page) {
      Remake(page, [&](std::size_t i) { return all[i]; });
    }
  }
  /// Makes a page of what `at` says of each of its elements.
  template <class At>
  void Remake(std::size_t page, const At& at) {
    SEAM_ASSERT(page < pages_.size());
    pages_[page] = nullptr;
    Remake(
        page, [](std::size_t) { return true; }, at);
  }
  /// The same, but elements that are not `changed` are copied, unless there is no such page yet.
  template <class Changed, class At>
  void Remake(std::size_t page, const Changed& changed, const At& at) {
    SEAM_ASSERT(page < pages_.size());
    const Page* before = pages_[page].get();
    auto made = before != nullptr ? std::make_shared<Page>(*before) : std::make_shared<Page>();
    for (std::size_t i = begin(page); i < end(page); ++i) {
      if (before == nullptr || changed(i)) (*made)[i - begin(page)] = at(i);
    }
    pages_[page] = std::move(made);
  }

 private:
  std::size_t size_ = 0;
  std::vector<std::shared_ptr<const Page>> pages_;
};

}  // namespace seam
