#pragma once
/// A file that appears whole or not at all, or stdout.

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace seam {

class OutputFile {
 public:
  /// `path` "" or "-": stdout. Else what is written goes to a file beside it until Finish. Throws
  /// OperatorError when that cannot be made, when something is at `path` and `force` is not given
  /// or it is no regular file, and when it is one of the files `read`, which must not be replaced.
  OutputFile(const std::string& path, bool force, const std::vector<std::string>& read);
  /// Without Finish nothing is left of it, and what was at `path` is as it was.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws OperatorError when it cannot be written, and after a stop signal (process.h).
  void Write(std::string_view text);
  /// Throws OperatorError when the file cannot be completed.
  void Finish();
  /// Written so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  [[noreturn]] void Fail(int error) const;

  std::string path_, unfinished_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
};

}  // namespace seam
