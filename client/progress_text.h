#pragma once
/// The lines of seam-client about its state, for people.

#include <string>

#include "client/client.h"

namespace seam {

/// Formats a number: "10", "0.5".
std::string SecondsText(double seconds);

/// Returns "ann: 12 s, 8.3 m/s, peer 1, round trip 100 ms, loss 1.0 %, 12 corrections, 0
/// rejoin(s)"; the speed only if there is a vehicle. Requires a running client.
std::string ProgressText(const Client& client, double elapsed_s);

/// Returns the state before the room runs: "ann: 3 s, waiting for bob". `told`: the server's last
/// line; "": none.
std::string WaitingText(const Client& client, const std::string& told, double elapsed_s);

}  // namespace seam
