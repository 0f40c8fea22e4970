// The file of declared hosts: further names and addresses by which people reach this machine.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"

namespace flexrf::panel {

/// Names in lower case and IPv4 addresses, each as HostRules::check_name() takes it. A line each; comments
/// from '#'.
struct DeclaredHosts {
  static constexpr std::size_t most = 8;

  std::vector<std::string> list;     ///< each once, in the order of the file
  std::vector<std::string> damages;  ///< one for each line that was skipped: file, line, what is wrong
};

/// Adds the host, in lower case, unless the list has it. invalid_argument: it is none; out_of_range: the list
/// has DeclaredHosts::most already. Any thread.
Status add_host(std::vector<std::string>& list, std::string_view host);
/// Hosts separated by blanks, maybe none; the error is that of add_host(). Any thread.
Result<std::vector<std::string>> split_hosts(std::string_view text);

/// `file` is for messages only. Any thread.
DeclaredHosts parse_hosts(std::string_view text, const std::string& file);
/// None if there is no such file; an error says why a file that is there cannot be read. Blocks.
Result<DeclaredHosts> read_hosts(const std::string& file);
/// Replaces the file, which everybody may read; on return it is on the disk. Blocks.
Status write_hosts(const std::string& file, const std::vector<std::string>& list);

}  // namespace flexrf::panel
