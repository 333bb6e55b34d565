#pragma once
/// Server: a room, as a function of the time and of its datagrams.

#include "common/base/entropy.h"
#include "common/base/version.h"
#include "server/server.h"
