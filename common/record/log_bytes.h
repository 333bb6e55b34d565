#pragma once
/// The bytes of an event of a log; the format is in log_file.h.

#include <cstdint>
#include <string>

#include "common/base/bytes.h"
#include "common/codec/log_seal.h"

namespace seam {

/// The end of an encoded LogSeal, and so of its event: log_crc, and with a key log_keyed before it.
constexpr std::size_t kSealCrcBytes = 4, kSealKeyedBytes = kLogKeyedBytes + kSealCrcBytes;

/// Appends an event to `log`.
void AppendEvent(Bytes* log, std::int64_t number, std::int64_t utime, const std::string& channel,
                 ByteView message);
/// Sets the number of the event that begins at `at`.
void SetEventNumber(Bytes* log, std::size_t at, std::int64_t number);
/// Returns false if an event of this channel and size does not fit a log.
bool FitsLog(const std::string& channel, ByteView message);

}  // namespace seam
