#include "image/claim/host_declaration.hpp"

#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "base/json_writer.hpp"
#include "runtime/json/json_reader.hpp"
#include "web-ui/server/access/host_file.hpp"
#include "web-ui/server/machine/helper_client.hpp"

namespace flexrf::claim {
namespace {

constexpr Duration patience = std::chrono::seconds{10};
constexpr std::chrono::milliseconds between_looks{10};

/// The status in an answer of the helper.
Status outcome_of(const std::string& text) {
  const auto reader = std::make_unique<JsonReader>();
  const Result<JsonObject> said = reader->object(text);
  if (!said) return said.status();
  Fields fields(*said);
  if (fields.boolean("ok")) return {};
  const std::string why{fields.text_or("why", "the PC's helper does not say why")};
  return fields.status() ? Status::error(StatusCode::unavailable, "%s", why.c_str()) : fields.status();
}

}  // namespace

Status HostDeclaration::declare(const Admin& admin, const std::string& host) const {
  Result<panel::DeclaredHosts> declared = panel::read_hosts(hosts_file_);
  if (!declared) return declared.status();
  std::vector<std::string>& list = declared->list;
  const std::size_t before = list.size();
  if (const Status added = panel::add_host(list, host); !added) return added;
  if (list.size() == before) return {};
  std::string hosts;
  for (const std::string& one : list) hosts.append(hosts.empty() ? "" : " ").append(one);
  return ask(admin, hosts);
}

Status HostDeclaration::ask(const Admin& admin, const std::string& hosts) const {
  panel::HelperClient helper(socket_, nullptr);
  if (const Status started = helper.start(); !started) return started;
  std::string text;
  text.reserve(2 * panel::HelperClient::longest_line);  // no copy of the password is left behind
  JsonWriter json(std::move(text));
  json.begin_object().member("verb", "hosts").member("user", admin.user).member("password", admin.password);
  json.member("hosts", hosts).end_object();
  helper.ask(json.release(), patience, false);
  std::optional<panel::HelperClient::Answer> answer;
  // There is one, by the end of its patience at the latest.
  while (!(answer = helper.pop())) std::this_thread::sleep_for(between_looks);
  return answer->status ? outcome_of(answer->text) : answer->status;
}

}  // namespace flexrf::claim
