#pragma once
/// Client: a player or spectator, as a function of the time and of its datagrams.

#include "client/client.h"
#include "common/base/entropy.h"
