#pragma once
/// What each client's sessions came to, for people: kept after a session is over, by name.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seam {

/// Of all sessions under one name.
struct ClientAccount {
  std::string name;
  int peer = 0;                                 ///< of the newest session
  bool player = false;                          ///< of the scene; else a spectator
  int sessions = 0;                             ///< so many got ready
  std::int64_t bytes_in = 0, bytes_out = 0;     ///< UDP payload
  std::int64_t dropped = 0;                     ///< datagrams and messages of it that were dropped
  std::int64_t corrections = 0;                 ///< of the server's copy of its bodies
  std::int64_t readings = 0;                    ///< of round trip and loss, one a second
  std::int64_t rtt_us_sum = 0, rtt_us_max = 0;  ///< over the readings
  std::int64_t loss_ppm_sum = 0;                ///< on the way to the server, over the readings

  /// Means over the readings; -1 without one.
  std::int64_t rtt_us() const { return readings > 0 ? rtt_us_sum / readings : -1; }
  std::int64_t loss_ppm() const { return readings > 0 ? loss_ppm_sum / readings : -1; }
  /// `rtt_us`: -1, not known yet, is no reading.
  void Read(std::int64_t read_rtt_us, std::int64_t read_loss_ppm);
};

class AccountBook {
 public:
  /// Names with an account of their own; all further ones share the last, "others". A session costs
  /// no more memory than that, however many names are tried.
  static constexpr std::size_t kAccountsMax = 1024;

  /// The account of a name, which stays where it is.
  ClientAccount& Of(const std::string& name);
  /// By peer, and those of one peer by name.
  std::vector<ClientAccount> List() const;

 private:
  std::map<std::string, ClientAccount> accounts_;
};

}  // namespace seam
