#pragma once
/// What only some scenes have, held so that Scene need not know its type: whoever uses a feature
/// includes that feature's header, and a change of it concerns nobody else.

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace seam {

/// A T that is replaced as a whole; copies share it. Without one it reads as T{}.
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

/// A list of T that only grows; copies share it until one of them does.
template <class T>
class FeatureList {
 public:
  FeatureList() = default;
  FeatureList(std::initializer_list<T> values)
      : values_(std::make_shared<const std::vector<T>>(values)) {}
  FeatureList(std::vector<T> values)  // NOLINT: a list is as good as one
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
