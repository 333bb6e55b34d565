/// The assertions of the header are checked whenever the library is built.

#include "common/sync/limits.h"
