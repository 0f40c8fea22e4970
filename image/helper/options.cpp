#include "image/helper/options.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

namespace flexrf::helper {
namespace {

template <class Number>
bool parse(std::string_view text, Number least, Number most, Number& number) {
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && rest == text.data() + text.size() && number >= least && number <= most;
}

std::string* text_option(Options& options, std::string_view word) {
  Files& files = options.files;
  const std::pair<std::string_view, std::string*> all[] = {
      {"--word", &files.word},
      {"--users", &files.users},
      {"--folder", &files.choice},
      {"--kernel-command-line", &files.command_line},
      {"--certificate", &files.certificate},
      {"--version-file", &files.version},
      {"--notices", &files.notices},
      {"--boot-id", &files.boot_id},
      {"--data", &files.data},
      {"--update-folder", &files.update.folder},
      {"--results", &files.update.results},
      {"--network-kept", &files.network.kept},
      {"--network-used", &files.network.used},
      {"--socket", &options.socket},
      {"--peer", &options.peer},
      {"--systemctl", &options.systemctl},
      {"--journalctl", &options.journalctl},
  };
  const auto* const found =
      std::find_if(std::begin(all), std::end(all), [&](const auto& one) { return one.first == word; });
  return found == std::end(all) ? nullptr : found->second;
}

/// Empty: the value is taken.
std::string take_number(Options& options, const std::string& word, const std::string& value) {
  if (word == "--port")
    return parse<std::uint16_t>(value, 1, 65535, options.port) ? "" : "--port is a number from 1 to 65535";
  int seconds = 0;
  if (!parse(value, 1, 86'400, seconds)) return word + " is a number of seconds, from 1 to 86400";
  (word == "--trial" ? options.limits.trial : options.limits.healthy) = std::chrono::seconds{seconds};
  return "";
}

}  // namespace

std::variant<Options, std::string> parse_options(const std::vector<std::string>& words) {
  Options options;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h") {
      options.wants_help = true;
      return options;
    }
    std::string* const text = text_option(options, word);
    const bool is_number = word == "--port" || word == "--healthy-for" || word == "--trial";
    if (text == nullptr && !is_number) return "there is no option '" + word + "'";
    if (++i == words.size()) return word + " needs a value";
    if (text != nullptr) {
      *text = words[i];
    } else if (std::string wrong = take_number(options, word, words[i]); !wrong.empty()) {
      return wrong;
    }
  }
  return options;
}

const char* const usage =
    "flexrf-helper [OPTION...]\n"
    "Says whether anything may move on this PC, confirms the version that runs when it is healthy, and does\n"
    "for an admin what only root may: takes an update, chooses the version that boots, sets addresses, "
    "declares\n"
    "hosts, restarts the PC.\n"
    "options:\n"
    "  --word FILE                  gets the word; else /run/flexrf-helper/motion\n"
    "  --users FILE                 who may log in; else /data/flexrf/panel-users\n"
    "  --folder DIR                 the boot choice; else /boot/efi/flexrf\n"
    "  --kernel-command-line FILE   tells which version runs; else /proc/cmdline\n"
    "  --certificate FILE           the panel's; else /data/flexrf/panel.crt\n"
    "  --port N                     the panel's; else 8443\n"
    "  --healthy-for SECONDS        until a version confirms itself; else 60\n"
    "  --trial SECONDS              until one that does not gives up its turn; else 600\n"
    "  --socket FILE                where it can be asked; else /run/flexrf-helper/socket\n"
    "  --peer USER                  may ask, beside root; else flexrf\n"
    "  --version-file FILE          names what runs; else /usr/lib/flexrf/version\n"
    "  --notices DIR                with files of lines for a person; else /run/flexrf-notices\n"
    "  --update-folder DIR          gets bundles; else /data/update. Root's alone\n"
    "  --results DIR                how verifying and installing go; else /run/flexrf-update\n"
    "  --network-kept DIR           files of systemd-networkd that are used from boot on, and panel-hosts; "
    "else\n"
    "                               /data/network\n"
    "  --network-used DIR           those that are used now; else /run/systemd/network\n"
    "  --data DIR                   the partition for data; else /data\n"
    "  --boot-id FILE               names this boot in the journal; else /proc/sys/kernel/random/boot_id\n"
    "  --systemctl FILE             starts units and restarts the PC; else /usr/bin/systemctl\n"
    "  --journalctl FILE            reads the journal; else /usr/bin/journalctl\n"
    "Exit code: 0 ended by a signal; 1 wrong usage.\n";

}  // namespace flexrf::helper
