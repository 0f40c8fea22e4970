#include "image/helper/state_answer.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/json_writer.hpp"
#include "image/helper/driver_changes.hpp"
#include "image/helper/facts.hpp"
#include "image/helper/named_lines.hpp"
#include "image/helper/network.hpp"
#include "image/helper/update_progress.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/host_file.hpp"

namespace flexrf::helper {
namespace {

constexpr std::size_t most_notices = 16;
constexpr std::size_t longest_notice = 240;

std::int64_t seconds(Duration duration) {
  return duration / std::chrono::seconds{1};
}

void add_lines(std::vector<std::string>& notices, const std::string& file) {
  const Result<std::string> text = read_file(file);
  if (!text) return;  // nobody had anything to say
  std::string_view rest = *text;
  while (!rest.empty() && notices.size() < most_notices) {
    const std::size_t end = rest.find('\n');
    if (const std::string_view line = rest.substr(0, end); !line.empty())
      notices.emplace_back(line.substr(0, longest_notice));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
}

void write_changes(JsonWriter& json, const std::vector<DriverChange>& changes) {
  json.key("driver_changes").begin_array();
  for (const DriverChange& change : changes) {
    json.begin_object().member("device", change.device).member("from", change.from);
    json.member("to", change.to).end_object();
  }
  json.end_array();
}

void write_slots(JsonWriter& json, const Files& files, const Facts& facts, const NamedLines& running) {
  json.key("slots").begin_object();
  for (const boot::Slot slot : {boot::Slot::a, boot::Slot::b}) {
    const bool is_whole = facts.choice && facts.choice->of(slot).is_whole;
    const bool runs = facts.running.slot == slot;
    json.key(slot == boot::Slot::a ? "A" : "B").begin_object();
    const NamedLines lines = runs ? running : is_whole ? version_lines(files.update, slot) : NamedLines{};
    json.member("version", lines.text("version"));
    json.member("whole", is_whole).member("primary", facts.choice && facts.choice->primary == slot);
    write_changes(json, is_whole ? driver_changes(running.whole("drivers"), lines.whole("drivers"))
                                 : std::vector<DriverChange>{});
    json.end_object();
  }
  json.end_object();
}

void write_update(JsonWriter& json, const Progress& progress, const Upload::Received& upload,
                  const NamedLines& running) {
  const bool is_receiving = upload.is_under_way;
  const JobResult& bundle = progress.bundle;
  const std::uint64_t percent =
      is_receiving && upload.size > 0 ? upload.bytes * 100 / upload.size : progress.percent;
  json.key("update").begin_object();
  json.member("phase", name_of(is_receiving ? Phase::receiving : progress.phase));
  json.member("received", upload.bytes).member("size", upload.size).member("percent", percent);
  json.member("version", bundle.version).member("application", bundle.application);
  const bool is_known = bundle.state == JobState::done;
  json.member("older", is_known && bundle.built < running.number("built"));
  write_changes(json, is_known ? driver_changes(running.whole("drivers"), bundle.drivers)
                               : std::vector<DriverChange>{});
  json.member("why", progress.why).end_object();
}

void write_network(JsonWriter& json, const NetworkFiles& files, const OfThisMoment& moment) {
  json.key("network").begin_array();
  for (const Interface& one : moment.interfaces) {
    const AddressSetting setting = setting_of(files, one.name);
    json.begin_object().member("interface", one.name).member("mac", one.mac).member("link", one.has_link);
    json.key("addresses").begin_array();
    for (const std::string& address : one.addresses) json.value(address);
    json.end_array().member("setting", name_of(setting.way));
    json.member("address", setting.address).member("gateway", setting.gateway).end_object();
  }
  json.end_array();
  const AddressTrial trial = read_trial(files).value_or(AddressTrial{});
  json.key("network_trial").begin_object().member("interface", trial.interface);
  json.member("remaining_s", std::max<std::int64_t>(0, seconds(trial.until - moment.now))).end_object();
  const Result<panel::DeclaredHosts> hosts = panel::read_hosts(file_of_hosts(files));
  json.key("hosts").begin_array();
  if (hosts) {
    for (const std::string& host : hosts->list) json.value(host);
  }
  json.end_array();
}

void write_failure(JsonWriter& json, const Failure& failure, const FailureLines::Answer& lines) {
  json.key("last_failure").begin_object();
  json.member("slot", std::string(1, boot::letter_of(failure.slot))).member("version", failure.version);
  json.member("starts", failure.starts).member("start", failure.last.start);
  json.member("began", failure.last.began).member("reason", reason_of(failure));
  json.key("lines").begin_array();
  for (const std::string& line : lines.lines) json.value(line);
  json.end_array().member("why_no_lines", lines.why_none).end_object();
}

void write_data(JsonWriter& json, const DataUse& use) {
  json.key("data").begin_object().member("size", use.size).member("used", use.used).member("free", use.free);
  json.member("configuration", use.configuration).member("audit", use.audit);
  json.member("journal", use.journal).member("old_logs", use.old_logs);
  json.member("updates", use.updates).member("other", use.other);
  json.member("complete", use.is_complete).end_object();
}

}  // namespace

std::vector<std::string> notices_of(const Files& files) {
  std::vector<std::string> notices;
  std::vector<std::string> files_of_lines;
  std::error_code error;
  for (std::filesystem::directory_iterator file(files.notices, error), end; !error && file != end;
       file.increment(error))
    if (file->path().extension() != ".new") files_of_lines.push_back(file->path().string());
  std::sort(files_of_lines.begin(), files_of_lines.end());
  for (const std::string& one : files_of_lines) add_lines(notices, one);
  return notices;
}

std::string state_answer(const Files& files, const Facts& facts, const OfThisMoment& moment) {
  const Result<NamedLines> read = NamedLines::read(files.version);
  const NamedLines running = read ? *read : NamedLines{};
  JsonWriter json{std::string{}};
  json.begin_object().member("ok", true);
  json.member("application", running.text("application")).member("version", running.text("version"));
  json.member("built", running.number("built")).member("drivers", running.whole("drivers"));
  json.member("slot",
              facts.running.slot ? std::string(1, boot::letter_of(*facts.running.slot)) : std::string{});
  json.member("boot", facts.running.why.empty() ? "unknown" : facts.running.why);
  json.member("confirmed", is_confirmed(facts));
  write_slots(json, files, facts, running);
  json.member("claimed", facts.is_claimed);
  json.member("motion", moment.word.empty() ? permission_of(facts) : moment.word);
  json.member("development_key", running.text("development_key") == "yes");
  json.key("notices").begin_array();
  for (const std::string& notice : notices_of(files)) json.value(notice);
  json.end_array();
  json.member("healthy_for_s", seconds(moment.health.so_far));
  json.member("healthy_needed_s", seconds(moment.health_needed));
  json.member("why_not_healthy", moment.health.why_not);
  write_update(json, read_progress(files.update), moment.upload, running);
  write_network(json, files.network, moment);
  if (moment.data) write_data(json, *moment.data);
  if (moment.failure) write_failure(json, *moment.failure, moment.failure_lines);
  json.end_object();
  return json.release();
}

}  // namespace flexrf::helper
