// Which hosts a browser may believe us to be, and which pages may change something.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/status.hpp"
#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

/// A name that is not ours may be a foreign page's, pointed at our address (DNS rebinding): such requests get
/// 421. A page of another origin may not change anything here: 403. Any thread, while none calls declare().
class HostRules {
 public:
  /// `names`: what else we are called, as check_name() takes it. `secure`: by TLS.
  HostRules(bool secure, std::vector<std::string> names);

  /// This machine's own names: host name, its first label, and that with ".local".
  static std::vector<std::string> names_of_machine();
  /// A name or an IPv4 address, without port, as `--panel-host` and `--panel-hosts` give it;
  /// invalid_argument says what is wrong with it.
  static Status check_name(std::string_view name);
  /// The name or address in a Host header, without port and brackets; none: the header is malformed.
  static std::optional<std::string> name_in(std::string_view host);

  /// Further hosts of ours, as check_name() takes them, in place of those declared before.
  void declare(std::vector<std::string> hosts) { declared_ = std::move(hosts); }
  /// The Host header (with or without port), on a connection that arrived at this address of ours:
  /// "localhost", one of the names, a declared host, or that very address. Names compare without case. Any
  /// port: a tunnel's other end has its own.
  bool allows_host(std::string_view host, const Address& local_end) const noexcept;
  /// The Origin header of a change or an upgrade, whose Host is allowed: none (it is no page), or this
  /// Host's.
  bool allows_origin(std::string_view origin, std::string_view host) const noexcept;

 private:
  bool secure_;
  std::vector<std::string> names_;
  std::vector<std::string> declared_;
};

}  // namespace flexrf::panel
