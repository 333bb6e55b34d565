#pragma once
/// Datagrams outside of any session: the handshake, and refusals. They are neither secret nor
/// authenticated, and every version of the protocol can read them.
///
///   0      4          8        16       24
///   magic  checksum   number   8 zeros  header u16 (bytes) | message | zeros
///   u32    u32        u64
///
/// All big-endian. docs/protocol.md is the reference.

#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// "SEA1".
constexpr std::uint32_t kLooseMagic = 0x53454131u;
constexpr std::size_t kLooseHeaderBytes = 24;
/// A client pads its hellos and joins to this length: three times the longest answer to a sender
/// that has not proved its address (challenge_t, 116 bytes).
constexpr std::size_t kHandshakeBytes = 360;

/// Returns a datagram of one message, with zeros after it up to `least_bytes`. `number` is the one
/// that the client has drawn.
Bytes LooseDatagram(std::uint64_t number, ByteView message, std::size_t least_bytes = 0);

/// Returns the number of a loose datagram with a right checksum; 0: it is none.
std::uint64_t LooseNumber(ByteView datagram);

/// Returns the message of a datagram for which LooseNumber is not 0; empty if it is not whole.
ByteView LooseMessage(ByteView datagram);

}  // namespace seam
