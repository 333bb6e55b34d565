#pragma once
/// Whether something is as it must be, and if not, why not: one line of text.

#include <string>
#include <utility>

namespace seam {

class [[nodiscard]] Status {
 public:
  Status() = default;  ///< good
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
