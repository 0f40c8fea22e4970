#include "web-ui/server/panel_options.hpp"

#include <string_view>

#include "runtime/executive/options.hpp"

namespace flexrf::panel {

constinit const std::array<Option, 9> panel_options{
    Option{"--panel", OptionKind::text, "ADDRESS:PORT|off",
           "where the panel listens (default 127.0.0.1:8080)"},
    Option{"--panel-users", OptionKind::file, "FILE",
           "who may log in to the panel (`./flexrf password` writes it)"},
    Option{"--panel-host", OptionKind::text, "NAME", "another name of this machine in the panel's address"},
    Option{"--panel-hosts", OptionKind::text, "FILE",
           "more names and IPv4 addresses of this machine, one a line; it need not be there"},
    Option{"--helper", OptionKind::text, "SOCKET",
           "what updates and restarts this PC listens there (flexrf-helper)"},
    Option{"--panel-edit-timeout", OptionKind::duration, "DURATION",
           "how long an edit may be left open (default `5min`)"},
    Option{"--tls-certificate", OptionKind::file, "FILE", "serve the panel by TLS: certificate (PEM)"},
    Option{"--tls-key", OptionKind::file, "FILE", "and its key (PEM)"},
    Option{"--insecure-http", OptionKind::flag, nullptr, "let other machines use the panel without TLS"},
};

Result<bool> is_panel_wanted(const Options& options) {
  const char* const where = options.values().text("--panel");
  if (where == nullptr) return !options.virtual_time;
  if (std::string_view{where} == "off") return false;
  if (std::string_view{where}.find(':') == std::string_view::npos) {
    return Status::error(StatusCode::invalid_argument, "--panel %s: give ADDRESS:PORT or off", where);
  }
  if (options.virtual_time) {
    return Status::error(
        StatusCode::invalid_argument,
        "--panel %s with --virtual-time: there is no panel on a simulated clock; leave one of them away",
        where);
  }
  return true;
}

}  // namespace flexrf::panel
