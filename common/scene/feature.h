#pragma once
/// Holders for optional parts of a Scene, which then need not know their types: only users of a
/// feature include its header and are recompiled when it changes.

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace seam {

/// A T that is replaced as a whole; copies share it. Reads as T{} when unset.
template <class T>
class Feature {
 public:
  const T& operator*() const {
    static const T none{};
    return value_ != nullptr ? *value_ : none;
  }
  const T* operator->() const { return &**this; }
  void Set(T value) { value_ = std::make_shared<const T>(std::move(value)); }

 private:
  std::shared_ptr<const T> value_;
};

/// A list of T that only grows; copies share it until one of them grows.
template <class T>
class FeatureList {
 public:
  FeatureList() = default;
  FeatureList(std::initializer_list<T> values)
      : values_(std::make_shared<const std::vector<T>>(values)) {}
  FeatureList(std::vector<T> values)  // NOLINT: implicit on purpose
      : values_(std::make_shared<const std::vector<T>>(std::move(values))) {}

  bool empty() const { return values_ == nullptr || values_->empty(); }
  std::size_t size() const { return values_ == nullptr ? 0 : values_->size(); }
  const T* begin() const { return values_ == nullptr ? nullptr : values_->data(); }
  const T* end() const { return begin() + size(); }
  /// Requires i < size().
  const T& operator[](std::size_t i) const { return (*values_)[i]; }
  const T& back() const { return values_->back(); }
  void push_back(T value) {
    std::vector<T> grown(begin(), end());
    grown.push_back(std::move(value));
    values_ = std::make_shared<const std::vector<T>>(std::move(grown));
  }

 private:
  std::shared_ptr<const std::vector<T>> values_;
};

}  // namespace seam
