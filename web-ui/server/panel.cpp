#include "web-ui/server/panel.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/realtime/instance_lock.hpp"
#include "runtime/realtime/thread_setup.hpp"
#include "web-ui/server/access/access_endpoints.hpp"
#include "web-ui/server/access/entrance.hpp"
#include "web-ui/server/access/host_watch.hpp"
#include "web-ui/server/access/password_helper.hpp"
#include "web-ui/server/access/start_rules.hpp"
#include "web-ui/server/api/api.hpp"
#include "web-ui/server/encryption.hpp"
#include "web-ui/server/files.hpp"
#include "web-ui/server/listen_address.hpp"
#include "web-ui/server/ordinary_memory.hpp"
#include "web-ui/server/own_addresses.hpp"
#include "web-ui/server/panel_options.hpp"
#include "web-ui/server/server.hpp"

namespace flexrf::panel {
namespace {

const PanelRecord& record_of(const Application& application) noexcept {
  static constexpr PanelRecord defaults{};
  return application.panel == nullptr ? defaults : *application.panel;
}

/// Puts server, access control and API together, and gives each what is for it; owns the server's thread.
class Panel final : public Observer, public Service {
 public:
  explicit Panel(Executive& executive)
      : executive_(executive), record_(record_of(executive.cell().application())) {}
  ~Panel() override { Panel::stop(); }

  Status prepare() override;
  Status start() override;
  void stop() noexcept override;

  // ---- the server's thread
  bool admit(const Request& request, SessionIndex& session, Reply& reply) override {
    return entrance_->admit(request, session, reply);
  }
  void on_connection_closed(std::uint32_t place) override { entrance_->on_connection_closed(place); }
  Handled handle(const Request& request, Reply& reply, Ticket ticket) override;
  LiveService& live() noexcept override { return api_->live(); }
  void on_tick(Time now) override;
  Duration until_next(Time now) const override {
    return std::min(endpoints_->until_next(now), api_->until_next(now));
  }

 private:
  Status read_options();
  Status listen();
  void make_access();
  std::vector<Address> local_addresses() const;
  Status make_api();
  void print_address();
  std::string certificate_host() const;
  std::string address_of(const std::string& host) const;
  std::string address_with(const OneTimeToken* token) const;
  void write_address(const OneTimeToken& token);
  void print_certificate_command() const;

  Executive& executive_;
  const PanelRecord& record_;
  ListenAddress address_;
  Users users_;
  UserFileWatch user_watch_;
  std::unique_ptr<net::ssl::context> encryption_;
  bool is_secure_ = false;
  std::vector<std::string> host_names_;
  HostFileWatch host_watch_;
  std::optional<Server> server_;
  std::optional<PanelAccess> access_;
  std::optional<HostRules> rules_;
  LoginLimits limits_;
  PasswordCheck password_check_;
  std::optional<Entrance> entrance_;
  std::optional<AccessEndpoints> endpoints_;
  std::optional<Files> files_;
  std::optional<Api> api_;
  RunningThread thread_;
  bool api_runs_ = false;
  std::string address_file_;  // empty: there is none
};

Status Panel::prepare() {
  if (!prepare_cryptography()) {
    return Status::error(StatusCode::unavailable, "the panel: this system has no source of randomness");
  }
  if (const Status status = read_options(); !status) return status;
  if (const Status status = listen(); !status) return status;
  make_access();
  if (const Status status = make_api(); !status) return status;
  print_address();
  return {};
}

Status Panel::read_options() {
  const OptionValues given = executive_.options().values();
  const Result<ListenAddress> address = parse_listen_address(given.text("--panel", default_listen_address));
  if (!address) return address.status();
  address_ = *address;
  for (const GivenOption& option : executive_.options().given) {
    if (option.option->name != std::string_view{"--panel-host"}) continue;
    if (const Status status = HostRules::check_name(option.value); !status) return status;
    host_names_.push_back(option.value);
  }
  host_watch_ = HostFileWatch{given.text("--panel-hosts", "")};
  is_secure_ = given.has("--tls-certificate");
  if (is_secure_ != given.has("--tls-key")) {
    return Status::error(StatusCode::invalid_argument,
                         "--tls-certificate and --tls-key go together; one of them is missing");
  }
  Exposure exposure;
  exposure.address = Address::parse(address_.address).value_or(Address{});
  exposure.has_users = given.has("--panel-users");
  exposure.secure = is_secure_;
  exposure.insecure_http = given.has("--insecure-http");
  if (const Status status = check_exposure(exposure); !status) {
    if (!is_secure_) {
      std::fprintf(stderr, "A certificate of your own:\n  %s\n",
                   certificate_command(address_.address).c_str());
    }
    return status;
  }
  if (exposure.has_users) {
    const std::string file = given.text("--panel-users");
    user_watch_ = UserFileWatch{file};
    Result<Users> users = users_to_start_with(file);
    if (!users) return users.status();
    users_ = std::move(*users);
  }
  if (!is_secure_) return {};
  Result<std::unique_ptr<net::ssl::context>> encryption =
      make_encryption(given.text("--tls-certificate"), given.text("--tls-key"));
  if (!encryption) {
    print_certificate_command();
    return encryption.status();
  }
  encryption_ = std::move(*encryption);
  return {};
}

Status Panel::listen() {
  ServerSettings settings;
  settings.places = record_.connections;
  settings.local = local_addresses();
  settings.loopback_is_local = record_.loopback_is_local;
  // Of an update's parts; the API takes them there alone.
  settings.body_types.push_back("application/octet-stream");
  server_.emplace(settings, std::move(encryption_), *this);
  Status status = server_->listen(address_);
  // Nobody asked for the default address: another application's panel is no reason not to start.
  if (status.code() == StatusCode::busy && !executive_.options().values().has("--panel")) {
    const std::string taken = address_.text();
    address_.port = 0;
    status = server_->listen(address_);
    if (status) {
      std::fprintf(stderr, "%s is another program's; the panel takes a port that is free.\n", taken.c_str());
    }
  }
  address_.port = server_->port();
  return status;
}

std::vector<Address> Panel::local_addresses() const {
  std::vector<Address> addresses;
  for (const char* local : record_.local) {
    if (const std::optional<Address> address = Address::parse(local)) addresses.push_back(*address);
  }
  return addresses;
}

void Panel::make_access() {
  AccessSettings settings;
  settings.needs_login = !users_.list.empty();
  settings.secure = is_secure_;
  settings.port = address_.port;
  settings.audit = &executive_.cell().audit();
  settings.sessions.idle = record_.session_timeout;
  settings.sessions.absolute = record_.session_length;
  settings.token_renewed = [this](const OneTimeToken& token) { write_address(token); };
  // Each connection may be another's, and others come back to theirs.
  settings.sessions.places = std::size_t{2} * record_.connections;
  settings.local = local_addresses();
  settings.loopback_is_local = record_.loopback_is_local;
  access_.emplace(settings);
  std::vector<std::string> names = HostRules::names_of_machine();
  names.insert(names.end(), host_names_.begin(), host_names_.end());
  rules_.emplace(is_secure_, std::move(names));
  if (auto hosts = host_watch_.read()) rules_->declare(std::move(*hosts));
  entrance_.emplace(*access_, limits_, *rules_, record_.connections);
  endpoints_.emplace(*access_, limits_, users_, user_watch_, password_check_, *server_);
}

Status Panel::make_api() {
  files_.emplace(page_files(), record_.files);
  ApiTimeouts timeouts;
  timeouts.edit = executive_.options().values().duration("--panel-edit-timeout").value_or(timeouts.edit);
  api_.emplace(executive_, *access_, *server_, record_.connections, timeouts, &server_->bell(),
               executive_.options().values().text("--helper", ""));
  access_->watch(*api_);
  return api_->prepare();
}

Handled Panel::handle(const Request& request, Reply& reply, Ticket ticket) {
  if (AccessEndpoints::is_for(request.path)) return endpoints_->handle(request, reply, ticket);
  if (request.path.starts_with("/api/")) return api_->handle(request, reply, ticket);
  return files_->handle(request, reply, ticket);
}

void Panel::on_tick(Time now) {
  if (auto hosts = host_watch_.update(now)) rules_->declare(std::move(*hosts));
  endpoints_->on_tick(now);
  api_->set_figures(server_->figures());
  api_->on_tick(now);
}

/// The name that the certificate is to have.
std::string Panel::certificate_host() const {
  if (!address_.is_any()) return address_.address;
  const std::vector<std::string> names = HostRules::names_of_machine();
  return names.empty() ? "localhost" : names.front();
}

void Panel::print_certificate_command() const {
  std::fprintf(stderr, "A certificate and its key of your own:\n  %s\n",
               certificate_command(certificate_host()).c_str());
}

std::string Panel::address_of(const std::string& host) const {
  return (is_secure_ ? "https://" : "http://") + ListenAddress{host, address_.port}.text() + "/";
}

/// The best one, by which this machine itself reaches it at least.
std::string Panel::address_with(const OneTimeToken* token) const {
  const std::vector<std::string> hosts = reachable_hosts(address_, host_names_, own_addresses());
  const std::string address = address_of(hosts.empty() ? "localhost" : hosts.front());
  return token == nullptr ? address : address + "?token=" + std::string{token->text()};
}

/// For whoever runs the application, and nobody else: a folder of this user's, or root's.
void Panel::write_address(const OneTimeToken& token) {
  char folder[lock_directory_size];
  const LockScope scope = executive_.cell().real_actuator() != nullptr ? LockScope::machine : LockScope::user;
  if (!find_lock_directory(scope, folder)) return;
  address_file_ = std::string{folder} + "/flexrf-" + executive_.cell().application().name + ".address";
  if (const Status status = replace_file(address_file_, address_with(&token) + "\n", 0600); !status) {
    log_warning("panel", "the next address to come in by is not written down: {}", status.cause());
    address_file_.clear();
  }
}

void Panel::print_address() {
  // Whoever can read this terminal started the application, and may control it.
  const OneTimeToken* const token = access_->one_time_token();
  std::string text;
  const std::vector<std::string> hosts = reachable_hosts(address_, host_names_, own_addresses());
  const bool is_industrial_pc = executive_.options().values().has("--helper");
  if (token != nullptr || (hosts.empty() && !is_industrial_pc)) {
    text = "Panel: " + address_with(token) + "\n";
  } else {
    for (const std::string& host : hosts) text += "Panel: " + address_of(host) + "\n";
  }
  // Nobody browses on an industrial PC itself: its own localhost would mislead.
  if (hosts.empty())
    text += "No other machine reaches the panel before this one has an address; the port is " +
            std::to_string(address_.port) + "\n";
  if (token != nullptr) write_address(*token);
  if (!address_file_.empty()) text += "Once that was opened, the next address is in " + address_file_ + "\n";
  if (!tell_at_once(text)) log_warning("panel", "nobody reads standard error, where its address belongs");
}

Status Panel::start() {
  unlock_libraries();
  if (const Status status = api_->start(); !status) return status;
  api_runs_ = true;
  ThreadSettings settings;
  settings.name = "panel";
  settings.stack_size = observer_stack_size;
  return thread_.start(
      settings, [](void* server) { static_cast<Server*>(server)->run(); }, &*server_);
}

void Panel::stop() noexcept {
  if (thread_.is_started()) {
    server_->stop();
    thread_.join();
  }
  if (std::exchange(api_runs_, false)) api_->stop();
  if (!address_file_.empty()) std::remove(address_file_.c_str());
  address_file_.clear();
}

std::unique_ptr<Observer> make_panel(Executive& executive) {
  return std::make_unique<Panel>(executive);
}

}  // namespace

constinit const ObserverPart observer{"Panel", panel_options, &is_panel_wanted, &make_panel};

std::optional<int> run_helper(int argument_count, char** arguments) {
  return run_password_helper(argument_count, arguments);
}

}  // namespace flexrf::panel
