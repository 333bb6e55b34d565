#pragma once
/// Keeps the key of a player's place in a private file, so that the player gets the place back
/// after a restart.

#include <cstdint>
#include <string>

namespace seam {

class KeyFile {
 public:
  /// Reads the file if it exists. Throws OperatorError if it is not a plain file of ours without
  /// access for others, does not contain a key, or could not be created. Does not follow symbolic
  /// links.
  explicit KeyFile(const std::string& path);
  ~KeyFile();
  KeyFile(const KeyFile&) = delete;
  KeyFile& operator=(const KeyFile&) = delete;

  /// Returns the key that was read or written last; 0: none.
  std::int64_t key() const { return key_; }
  /// Creates the file (mode 0600) if need be, without following links or overwriting anything.
  /// Throws OperatorError if it cannot be written.
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
