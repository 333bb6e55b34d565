#pragma once
/// Writer of MCAP files (version 0 of the format, https://mcap.dev/spec) of protocol buffers:
/// chunks compressed by zstd, with an index and checksums, so that a reader can seek.

#include <cstdint>
#include <string>
#include <vector>

#include "render/export/output_file.h"

namespace seam {

/// Returns the CRC-32 of zip, gzip and PNG (ISO 3309). `crc`: of the preceding bytes, 0 at first.
std::uint32_t Crc32(std::string_view bytes, std::uint32_t crc = 0);

class McapWriter {
 public:
  /// Begins the file. `library`: name of the writing program.
  McapWriter(OutputFile* out, const std::string& library);
  /// Returns the schema's number. `name`: full name of a message in `set`, an encoded
  /// google.protobuf.FileDescriptorSet.
  std::uint16_t AddSchema(const std::string& name, const std::string& set);
  /// Returns the channel's number.
  std::uint16_t AddChannel(std::uint16_t schema, const std::string& topic);
  /// Adds an encoded message. Requires a channel that was added.
  void AddMessage(std::uint16_t channel, std::uint64_t time_ns, const std::string& message);
  /// Ends the file: index, statistics, footer. Nothing may follow.
  void Finish();

 private:
  struct Channel {
    std::string record;
    std::uint64_t messages = 0;
    std::string index;  ///< (time, offset) of its messages in the open chunk
  };
  void EndChunk();
  void Write(const std::string& bytes);
  void WriteSummary();

  OutputFile* out_;
  std::uint32_t data_crc_ = 0;
  std::vector<std::string> schemas_;  ///< records, by number - 1
  std::vector<Channel> channels_;     ///< by number - 1
  std::string chunk_;                 ///< records of the open chunk
  std::vector<std::string> chunk_indexes_;
  std::uint64_t chunk_first_ns_ = 0, chunk_last_ns_ = 0, chunk_messages_ = 0;
  std::uint64_t first_ns_ = 0, last_ns_ = 0, messages_ = 0;
};

}  // namespace seam
