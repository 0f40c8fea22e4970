#include "runtime/executive/value_saver.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <vector>

#include "runtime/blackboard/doorbell.hpp"
#include "runtime/executive/cell.hpp"
#include "runtime/executive/reconfiguration.hpp"
#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf {
namespace {

constexpr timespec look_interval{0, 20'000'000};
/// Of the end with a file system that does not answer.
constexpr Duration file_patience = std::chrono::seconds{10};
/// Writings in one run by which nobody sets values by hand any more.
constexpr std::uint64_t many_writings = 100;

std::int64_t milliseconds_since_1970() noexcept {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

bool has_same_cause(const Status& one, const Status& other) noexcept {
  return one.code() == other.code() && std::strcmp(one.cause(), other.cause()) == 0;
}

}  // namespace

ValueSaver::ValueSaver(Cell& cell) : cell_(&cell), tell_wear_at_(many_writings) {
  cell.set_saver(*this);
}

ValueSaver::~ValueSaver() {
  ends_.store(true, std::memory_order_release);
  thread_.join();
}

// ---- the start

Status ValueSaver::load() {
  const std::string& file = cell_->options().configuration_file;
  if (file.empty()) return {};
  const std::string target = resolved_path(file);
  if (const std::string folder = folder_of(target); access(folder.c_str(), W_OK | X_OK) == 0) {
    const std::string what = "configuration file " + file + " is used";
    if (const Status status = lock_.acquire_file((target + ".lock").c_str(), what.c_str()); !status)
      return status;
  } else {
    std::fprintf(stderr, "%s: its folder '%s' cannot be written (%s): what is set is not kept\n",
                 file.c_str(), folder.c_str(), strerrordesc_np(errno));
  }
  std::vector<ConfigurationComponent> components = configuration_components(*cell_);
  std::vector<ComponentSettings> settings(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    // Nothing runs yet: straight into the components.
    const ParameterMemory memory = cell_->component(static_cast<ComponentIndex>(i)).parameter_memory();
    components[i].configuration = memory.configuration;
    components[i].runtime = memory.runtime;
    components[i].configuration_marks = &settings[i].configuration_marks;
    components[i].runtime_marks = &settings[i].runtime_marks;
  }
  const ConfigurationReport report = load_configuration(file, configuration_identity(*cell_), components);
  for (const std::string& problem : report.problems) std::fprintf(stderr, "%s\n", problem.c_str());
  for (const std::string& notice : report.notices) std::fprintf(stderr, "%s\n", notice.c_str());
  if (report.source == ConfigurationSource::refused)
    return Status::error(StatusCode::invalid_argument, "--config %s: refused; nothing was started",
                         file.c_str());
  for (std::size_t i = 0; i < components.size(); ++i)
    cell_->restore_settings(static_cast<ComponentIndex>(i), settings[i]);
  saved_revision_.store(cell_->settings_revision());
  return {};
}

Status ValueSaver::start() noexcept {
  if (cell_->options().configuration_file.empty()) return {};
  ThreadSettings settings;
  settings.name = "saver";
  return thread_.start(
      settings, [](void* self) { static_cast<ValueSaver*>(self)->run(); }, this);
}

// ---- while the application runs

Result<std::uint64_t> ValueSaver::request() {
  if (cell_->options().configuration_file.empty())
    return Status::error(StatusCode::not_permitted,
                         "there is no configuration file: start the application with --config FILE");
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return Status::error(StatusCode::not_permitted, "the application has ended");
    number = wanted_.fetch_add(1, std::memory_order_acq_rel) + 1;
  }
  if (!thread_.is_started()) save();
  return number;
}

SaveState ValueSaver::state() const {
  SaveState state;
  {
    const std::lock_guard lock(mutex_);
    state = state_;
  }
  state.has_file = !cell_->options().configuration_file.empty();
  state.on_change = cell_->application().save.on_change;
  state.unsaved = state.has_file && is_unsaved();
  return state;
}

std::uint64_t ValueSaver::revision() const noexcept {
  return 2 * attempts_.load(std::memory_order_acquire) + (is_unsaved() ? 1 : 0);
}

bool ValueSaver::is_unsaved() const noexcept {
  return cell_->settings_revision() != saved_revision_.load(std::memory_order_acquire);
}

void ValueSaver::run() noexcept {
  while (!ends_.load(std::memory_order_acquire)) {
    std::uint64_t answered = 0;
    {
      const std::lock_guard lock(mutex_);
      answered = state_.answered;
    }
    if (answered != wanted_.load(std::memory_order_acquire) || is_due(MonotonicClock::now())) save();
    nanosleep(&look_interval, nullptr);
  }
  if (cell_->application().save.on_change || state_.answered != wanted_.load(std::memory_order_acquire))
    save();
  ended_.store(true, std::memory_order_release);
}

/// After quiet, or when there is none for long; and never more often than the interval says.
bool ValueSaver::is_due(Time now) noexcept {
  const SavePolicy& policy = cell_->application().save;
  if (!policy.on_change || !is_unsaved()) {
    first_change_ = {};
    return false;
  }
  if (const std::uint64_t revision = cell_->settings_revision();
      first_change_ == Time{} || revision != seen_revision_) {
    if (first_change_ == Time{}) first_change_ = now;
    seen_revision_ = revision;
    last_change_ = now;
  }
  const bool is_quiet = now - last_change_ >= policy.quiet || now - first_change_ >= policy.interval;
  return is_quiet && (last_attempt_ == Time{} || now - last_attempt_ >= policy.interval);
}

void ValueSaver::save() {
  const std::uint64_t number = wanted_.load(std::memory_order_acquire);
  // Before the values: what is set meanwhile is to be saved again.
  const std::uint64_t revision = cell_->settings_revision();
  const Status status = write_file();
  if (status) saved_revision_.store(revision, std::memory_order_release);
  last_attempt_ = MonotonicClock::now();
  first_change_ = {};
  bool asked = false;
  std::uint64_t writings = 0;
  {
    const std::lock_guard lock(mutex_);
    asked = number != state_.answered;
    state_.answered = number;
    state_.failure = status;
    if (status) state_.saved_at = milliseconds_since_1970();
    if (status) ++state_.writings;
    writings = state_.writings;
  }
  attempts_.fetch_add(1, std::memory_order_acq_rel);
  if (bell_ != nullptr) bell_->ring();
  tell(status, asked);
  tell_wear(writings);
}

Status ValueSaver::write_file() const {
  std::vector<ConfigurationComponent> components = configuration_components(*cell_);
  std::vector<ComponentSettings> settings(components.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    cell_->copy_settings(static_cast<ComponentIndex>(i), settings[i]);
    const auto values = [](std::vector<std::byte>& bytes) { return bytes.empty() ? nullptr : bytes.data(); };
    components[i].configuration = values(settings[i].configuration);
    components[i].runtime = values(settings[i].runtime);
    components[i].configuration_marks = &settings[i].configuration_marks;
    components[i].runtime_marks = &settings[i].runtime_marks;
  }
  return save_configuration(cell_->options().configuration_file, configuration_identity(*cell_), components);
}

/// A cause that stays is told once.
void ValueSaver::tell(const Status& status, bool asked) {
  const char* const name = cell_->application().name;
  if (!status && (asked || !has_same_cause(status, told_))) {
    log_error(name, "the values were not saved: {}", status.cause());
  } else if (status && asked) {
    log_info(name, "the values were saved, as was asked for");
  } else if (status && !told_) {
    log_info(name, "the values are saved again");
  }
  told_ = status;
}

/// Each time that there are twice as many.
void ValueSaver::tell_wear(std::uint64_t writings) {
  if (writings < tell_wear_at_) return;
  tell_wear_at_ *= 2;
  log_warning(
      cell_->application().name,
      "the configuration file was written {} times in this run, which wears out a disk: look for what "
      "sets values again and again, give these persist = false, or save on command only",
      writings);
}

// ---- the end

Status ValueSaver::finish() {
  if (cell_->options().configuration_file.empty()) return {};
  const char* const name = cell_->application().name;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  ends_.store(true, std::memory_order_release);
  if (thread_.is_started()) {
    const Time give_up = MonotonicClock::now() + file_patience;
    while (is_saving() && MonotonicClock::now() < give_up) nanosleep(&look_interval, nullptr);
    if (is_saving()) {
      const Status status = Status::error(StatusCode::timeout, "'%s': its file system does not answer",
                                          cell_->options().configuration_file.c_str());
      log_error(name, "the values were not saved: {}", status.cause());
      return status;
    }
  } else if (cell_->application().save.on_change) {
    save();
  }
  if (!cell_->application().save.on_change && is_unsaved())
    log_warning(name, "values were set since they were saved, and nobody asked to save them: they are lost");
  return state().failure;
}

}  // namespace flexrf
