#pragma once
/// The result of a check: ok, or one line of text with the reason for failure.

#include <string>
#include <utility>

namespace seam {

class [[nodiscard]] Status {
 public:
  Status() = default;  ///< ok
  static Status Ok() { return {}; }
  /// `why`: one line, not empty, for people.
  static Status Error(std::string why) {
    Status status;
    status.why_ = std::move(why);
    return status;
  }

  bool ok() const { return why_.empty(); }
  const std::string& why() const { return why_; }  ///< "" if ok

 private:
  std::string why_;
};

}  // namespace seam
