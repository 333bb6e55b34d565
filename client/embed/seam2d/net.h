#pragma once
/// Datagrams: UdpNet, MemoryNetwork (inside one process), ImpairedNet (delay and loss around both).

#include "common/net/impair.h"
#include "common/net/memory.h"
#include "common/net/udp.h"
