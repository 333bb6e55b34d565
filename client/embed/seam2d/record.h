#pragma once
/// Recordings: ReadRecording, MemoryRecorder, RoomLog (a log with checksums), Sink (LCM bus, log).

#include "common/record/recording.h"
#include "common/record/room_log.h"
#include "common/record/sink.h"
