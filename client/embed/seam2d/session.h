#pragma once
/// LocalSession: a server and its clients in one process and in virtual time.

#include "client/embed/local_session.h"
