#include "web-ui/server/access/host_file.hpp"

#include <algorithm>

#include "base/ascii.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/host_rules.hpp"

namespace flexrf::panel {
namespace {

constexpr const char* hosts_header =
    "# Further names and IPv4 addresses by which this machine is reached, one a line, at most 8.\n"
    "# The panel answers to them, too; it reads the file when it changes.\n";
constexpr std::string_view separators = " \t\r\n";

/// Without the blanks around it.
std::string_view without_blanks(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of(separators);
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(separators) + 1 - first);
}

}  // namespace

Status add_host(std::vector<std::string>& list, std::string_view host) {
  if (const Status status = HostRules::check_name(host); !status) return status;
  std::string name{host};
  std::transform(name.begin(), name.end(), name.begin(), lower_case);
  if (std::find(list.begin(), list.end(), name) != list.end()) return {};
  if (list.size() == DeclaredHosts::most)
    return Status::error(StatusCode::out_of_range, "'%s' is one too many: at most %zu hosts are declared",
                         name.c_str(), DeclaredHosts::most);
  list.push_back(std::move(name));
  return {};
}

Result<std::vector<std::string>> split_hosts(std::string_view text) {
  std::vector<std::string> list;
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    if (const Status status = add_host(list, text.substr(0, end)); !status) return status;
    text.remove_prefix(end);
  }
  return list;
}

DeclaredHosts parse_hosts(std::string_view text, const std::string& file) {
  DeclaredHosts hosts;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = without_blanks(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (line.empty() || line.starts_with('#')) continue;
    if (const Status status = add_host(hosts.list, line); !status)
      hosts.damages.push_back(file + ':' + std::to_string(number) + ": " + status.cause());
  }
  return hosts;
}

Result<DeclaredHosts> read_hosts(const std::string& file) {
  const Result<std::string> text = read_file(file);
  if (text) return parse_hosts(*text, file);
  if (text.status().code() == StatusCode::not_found) return DeclaredHosts{};
  return text.status();
}

Status write_hosts(const std::string& file, const std::vector<std::string>& list) {
  std::string text = hosts_header;
  for (const std::string& host : list) text.append(host).append("\n");
  return replace_file(file, text);
}

}  // namespace flexrf::panel
