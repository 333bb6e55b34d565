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
  /// `path` "" or "-": stdout. Else writes to a temporary file beside `path` until Finish. Throws
  /// OperatorError when that cannot be created, when `path` exists and `force` is false or it is no
  /// regular file, and when `path` is one of the input files `read`.
  OutputFile(const std::string& path, bool force, const std::vector<std::string>& read);
  /// Without Finish, removes the temporary file and leaves `path` unchanged.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Throws OperatorError when it cannot be written, and after a stop signal (process.h).
  void Write(std::string_view text);
  /// Throws OperatorError when the file cannot be completed.
  void Finish();
  /// Returns the number of bytes written so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  [[noreturn]] void Fail(int error) const;

  std::string path_, unfinished_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
};

}  // namespace seam
