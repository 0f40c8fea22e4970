// flexrf-claim: serves the page by which somebody claims a new industrial PC, and ends when that is done
// (docs/image.md).

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>

#include "base/standard_descriptors.hpp"
#include "image/claim/claim_service.hpp"
#include "image/claim/host_declaration.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/user_file.hpp"
#include "web-ui/server/encryption.hpp"
#include "web-ui/server/listen_address.hpp"
#include "web-ui/server/own_addresses.hpp"
#include "web-ui/server/server.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::claim;

constexpr const char* usage =
    "flexrf-claim [OPTION...]\n"
    "Serves the page by which somebody sets a new PC's first password, with a code that is shown here.\n"
    "options:\n"
    "  --users FILE               gets the first user; else /data/flexrf/panel-users. It must not be there\n"
    "  --listen ADDRESS:PORT      else 0.0.0.0:8443\n"
    "  --tls-certificate FILE     else /data/flexrf/panel.crt\n"
    "  --tls-key FILE             else /data/flexrf/panel.key\n"
    "  --helper SOCKET            of flexrf-helper; else /run/flexrf-helper/socket\n"
    "  --hosts FILE               of declared hosts, as the helper writes it; else "
    "/data/network/panel-hosts\n"
    "  --code-file FILE           gets the code, for the PC's screen; else /run/flexrf-claim/code\n"
    "  --check-users              only says whether the file of users can be read: 0 yes, 2 no, and why\n"
    "Exit code: 0 claimed; 1 wrong usage; 2 something failed; 3 ended by a signal before anybody came.\n";

struct Arguments {
  std::string users = "/data/flexrf/panel-users";
  std::string listen = "0.0.0.0:8443";
  std::string certificate = "/data/flexrf/panel.crt";
  std::string key = "/data/flexrf/panel.key";
  std::string helper = "/run/flexrf-helper/socket";
  std::string hosts = "/data/network/panel-hosts";
  std::string code_file = "/run/flexrf-claim/code";
  bool checks_users = false;
};

/// Whoever stands before the PC reads this.
void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// Hands the code to flexrf-screen, which shows it in large letters.
void write_code(const std::string& file, const std::string& code) {
  if (const Status written = replace_file(file, code + '\n', 0600); !written)
    say(std::string{"The PC's screen cannot show the code: "} + written.cause());
}

int fail(int code, const std::string& why) {
  std::fprintf(stderr, "flexrf-claim: %s\n%s", why.c_str(), code == 1 ? usage : "");
  return code;
}

/// "https://192.168.1.7:8443/ https://192.168.2.1:8443/": by which others reach this PC; empty: none yet.
std::string pages_at(const panel::ListenAddress& listen) {
  std::string all;
  for (const std::string& host : panel::reachable_hosts(listen, {}, panel::own_addresses()))
    all.append(all.empty() ? "" : " ")
        .append("https://" + panel::ListenAddress{host, listen.port}.text() + "/");
  return all;
}

std::string machine_name() {
  std::array<char, 65> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "This PC";
}

/// Says the code again when this PC gets another address: only then it is known where to go.
class TellingService final : public panel::Service {
 public:
  TellingService(ClaimService& service, Claim& claim, std::string code_file, panel::ListenAddress listen)
      : service_(service), claim_(claim), code_file_(std::move(code_file)), listen_(std::move(listen)) {}

  bool admit(const panel::Request& request, panel::SessionIndex& session, panel::Reply& reply) override {
    return service_.admit(request, session, reply);
  }
  void on_connection_closed(std::uint32_t place) override { service_.on_connection_closed(place); }
  panel::Handled handle(const panel::Request& request, panel::Reply& reply, panel::Ticket ticket) override {
    return service_.handle(request, reply, ticket);
  }
  panel::LiveService& live() noexcept override { return service_.live(); }
  Duration until_next(Time now) const override { return service_.until_next(now); }
  void on_tick(Time now) override;

  void use(panel::Server& server) noexcept { server_ = &server; }

 private:
  ClaimService& service_;
  Claim& claim_;
  std::string code_file_;
  panel::ListenAddress listen_;
  panel::Server* server_ = nullptr;
  std::string pages_;
  std::string code_;
  Time next_look_{};
};

volatile std::sig_atomic_t asked_to_end = 0;

void TellingService::on_tick(Time now) {
  service_.on_tick(now);
  if (service_.may_end() || asked_to_end != 0) server_->stop();
  if (now < next_look_ || claim_.is_done()) return;
  next_look_ = now + std::chrono::seconds{2};
  const std::string pages = pages_at({listen_.address, server_->port()});
  const std::string code = claim_.code().text();
  if (pages == pages_ && code == code_) return;
  if (code != code_) write_code(code_file_, code);
  pages_ = pages;
  code_ = code;
  say("Nobody has claimed this PC. The code is  " + code +
      (pages.empty() ? "  and this PC has no address yet" : "  at " + pages));
}

}  // namespace

int main(int argument_count, char** words) {
  hold_standard_descriptors();
  Arguments arguments;
  for (int i = 1; i < argument_count; ++i) {
    const std::string word = words[i];
    if (word == "--help" || word == "-h") {
      std::fputs(usage, stdout);
      return 0;
    }
    if (word == "--check-users") {
      arguments.checks_users = true;
      continue;
    }
    std::string* const value = word == "--users"             ? &arguments.users
                               : word == "--listen"          ? &arguments.listen
                               : word == "--tls-certificate" ? &arguments.certificate
                               : word == "--tls-key"         ? &arguments.key
                               : word == "--helper"          ? &arguments.helper
                               : word == "--hosts"           ? &arguments.hosts
                               : word == "--code-file"       ? &arguments.code_file
                                                             : nullptr;
    if (value == nullptr) return fail(1, "there is no option '" + word + "'");
    if (++i == argument_count) return fail(1, word + " needs a value");
    *value = words[i];
  }
  if (arguments.checks_users) {
    const Result<panel::Users> users = panel::read_users(arguments.users);
    if (!users) return fail(2, users.status().cause());
    return users->list.empty() ? fail(2, arguments.users + " names nobody") : 0;
  }
  const Result<panel::ListenAddress> address = panel::parse_listen_address(arguments.listen);
  if (!address) return fail(1, std::string{"--listen: "} + address.status().cause());
  if (access(arguments.users.c_str(), F_OK) == 0)
    return fail(2, arguments.users + " is there: this PC is claimed already");
  if (!panel::prepare_cryptography()) return fail(2, "this system has no source of randomness");
  auto encryption = panel::make_encryption(arguments.certificate, arguments.key);
  if (!encryption) return fail(2, encryption.status().cause());

  const auto end = [](int) { asked_to_end = 1; };
  std::signal(SIGTERM, end);
  std::signal(SIGINT, end);
  std::signal(SIGPIPE, SIG_IGN);
  Claim claim(arguments.users);
  const HostDeclaration declaration(arguments.helper, arguments.hosts);
  ClaimService service(claim, machine_name(), [&](const Admin& admin, const std::string& host) {
    Status status = declaration.declare(admin, host);
    say(status ? "The panel answers at " + host + ", too, by which this PC was claimed."
               : "The panel may not answer at " + host + ", by which this PC was claimed: " + status.cause());
    return status;
  });
  TellingService telling(service, claim, arguments.code_file, *address);
  panel::ServerSettings settings;
  settings.slow_call = std::chrono::seconds{10};
  settings.body_types = {"application/x-www-form-urlencoded"};
  panel::Server server(settings, std::move(*encryption), telling);
  telling.use(server);
  if (const Status listens = server.listen(*address); !listens) return fail(2, listens.cause());
  server.run();
  if (!claim.is_done()) return 3;
  say("This PC is claimed.");
  return 0;
}
