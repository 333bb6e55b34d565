#pragma once
/// A copy-on-write sequence in pages: copies share unchanged pages, which are neither copied nor
/// read again.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "common/base/check.h"

namespace seam {

/// A shared page never changes; Remake replaces it by a new one.
template <class T>
class Paged {
 public:
  static constexpr std::size_t kPage = 32;  ///< elements of a page
  using Page = std::array<T, kPage>;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return (*pages_[i / kPage])[i % kPage]; }
  std::size_t page_count() const { return pages_.size(); }
  /// True if both have the same page there, so that its elements are equal.
  bool Shares(const Paged& other, std::size_t page) const {
    return page < other.pages_.size() && pages_[page] == other.pages_[page];
  }
  /// A page holds the elements from `begin(page)` up to, but not including, `end(page)`.
  std::size_t begin(std::size_t page) const { return page * kPage; }
  std::size_t end(std::size_t page) const {
    const std::size_t last = (page + 1) * kPage;
    return last < size_ ? last : size_;
  }

  /// Sets the number of elements and drops all pages: each has to be made.
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
  /// Makes a page from the values `at(i)` of its elements.
  template <class At>
  void Remake(std::size_t page, const At& at) {
    SEAM_ASSERT(page < pages_.size());
    pages_[page] = nullptr;
    Remake(
        page, [](std::size_t) { return true; }, at);
  }
  /// Makes a page from the elements that are `changed`; the rest is copied from the old page, if
  /// there is one.
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
