// Declares the host by which a PC was claimed, so that its panel answers there, too.
#pragma once

#include <string>
#include <utility>

#include "base/status.hpp"

namespace flexrf::claim {

/// The admin whom the claim has created. Hosts are declared in the name of this admin.
struct Admin {
  std::string user;
  std::string password;
};

/// Adds a host to the declared ones of this PC. The page has no right to write their file, because the
/// network configuration lies beside it: it asks flexrf-helper.
class HostDeclaration {
 public:
  /// `socket`: where the helper listens. `hosts_file`: of declared hosts, which the helper writes.
  HostDeclaration(std::string socket, std::string hosts_file)
      : socket_(std::move(socket)), hosts_file_(std::move(hosts_file)) {}

  /// Ok: the host is declared, on the disk; else why not: it is neither a name nor an IPv4 address, there are
  /// eight already, or the helper's own words. Blocks for at most 10 s. Any thread.
  Status declare(const Admin& admin, const std::string& host) const;

 private:
  Status ask(const Admin& admin, const std::string& hosts) const;

  std::string socket_;
  std::string hosts_file_;
};

}  // namespace flexrf::claim
