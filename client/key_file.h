#pragma once
/// The key of a player's place, kept in a file that nobody else may read, so that the player has
/// the place back after a restart.

#include <cstdint>
#include <string>

namespace seam {

class KeyFile {
 public:
  /// Reads the file if it is there. Throws OperatorError when it is not a plain file of ours that
  /// nobody else may touch, holds something else than a key, or could not be created; a symbolic
  /// link is not followed.
  explicit KeyFile(const std::string& path);
  ~KeyFile();
  KeyFile(const KeyFile&) = delete;
  KeyFile& operator=(const KeyFile&) = delete;

  /// What was read or written last; 0: none.
  std::int64_t key() const { return key_; }
  /// Creates the file (mode 0600) if need be; then too nothing is followed or taken over. Throws
  /// OperatorError when it cannot be written.
  void Write(std::int64_t key);

 private:
  void Close();
  void Open(int more_flags);
  void Check() const;
  void Read();

  const std::string path_;
  int fd_ = -1;
  std::int64_t key_ = 0;
};

}  // namespace seam
