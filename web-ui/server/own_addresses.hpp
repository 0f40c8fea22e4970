// By which addresses a browser on another machine reaches the panel.
#pragma once

#include <string>
#include <vector>

#include "web-ui/server/listen_address.hpp"

namespace flexrf::panel {

/// The IPv4 addresses of this machine's interfaces but loopback, as "192.168.1.17"; empty: it has none, or
/// the kernel does not tell. Any thread that is not real-time.
std::vector<std::string> own_addresses();

/// What to type into a browser on another machine, the best first; empty: no other machine reaches the panel
/// yet. `declared`: names that somebody vouched for (--panel-host). The host name is none of them: nothing
/// says that a server resolves it. Link-local addresses come where there is nothing else. Any thread.
std::vector<std::string> reachable_hosts(const ListenAddress& listen,
                                         const std::vector<std::string>& declared,
                                         const std::vector<std::string>& own);

}  // namespace flexrf::panel
