#include "web-ui/server/access/host_watch.hpp"

#include "runtime/log/log.hpp"
#include "web-ui/server/access/host_file.hpp"

namespace flexrf::panel {

std::optional<std::vector<std::string>> HostFileWatch::read() const {
  if (watch_.file().empty()) return std::vector<std::string>{};
  Result<DeclaredHosts> hosts = read_hosts(watch_.file());
  if (!hosts) {
    log_warning("panel", "the declared hosts stay as they were: {}", hosts.status().cause());
    return std::nullopt;
  }
  for (const std::string& damage : hosts->damages) log_warning("panel", "{}; the line is skipped", damage);
  return std::move(hosts->list);
}

std::optional<std::vector<std::string>> HostFileWatch::update(Time now) {
  if (!watch_.has_changed(now)) return std::nullopt;
  std::optional<std::vector<std::string>> hosts = read();
  if (hosts) log_info("panel", "{} hosts are declared in {}", hosts->size(), watch_.file());
  return hosts;
}

}  // namespace flexrf::panel
