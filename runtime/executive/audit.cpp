#include "runtime/executive/audit.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>

namespace flexrf {
namespace {

constexpr timespec turn_interval{0, 20'000'000};
constexpr Duration retry_interval = std::chrono::seconds{1};
constexpr std::size_t most_unwritten = std::size_t{64} << 10;
constexpr std::size_t most_pending = 64;
constexpr std::size_t most_holds = 64;

std::int64_t wall_clock_of(Time time, Time now) noexcept {
  timespec wall{};
  clock_gettime(CLOCK_REALTIME, &wall);
  const std::int64_t milliseconds = static_cast<std::int64_t>(wall.tv_sec) * 1000 + wall.tv_nsec / 1'000'000;
  return milliseconds - std::chrono::duration_cast<std::chrono::milliseconds>(now - time).count();
}

bool is_act(const AuditRecord& record) noexcept {
  return record.kind != AuditRecord::Kind::change;
}

AuditEntry loss(const char* how, std::uint64_t count, Time now) {
  AuditEntry entry;
  entry.who = "FlexRF";
  entry.record.did = how;
  entry.record.at = now;
  entry.count = count;
  return entry;
}

std::string file_of(const Options& options) {
  if (options.virtual_time || options.audit_file == "off") return {};
  if (!options.audit_file.empty()) return options.audit_file;
  return options.configuration_file.empty() ? std::string{} : options.configuration_file + ".audit";
}

}  // namespace

Audit::Audit(Cell& cell, const Options& options)
    : cell_(cell), on_(!options.virtual_time), named_(!options.audit_file.empty()), file_(file_of(options)) {
  if (on_) cell_.audit().open();
}

Audit::~Audit() {
  ends_.store(true, std::memory_order_release);
  thread_.join();
}

Status Audit::prepare() {
  if (!on_) return {};
  if (const Status status = file_.check(); !status) {
    // Nobody asked for this file: beside a configuration that is only read the cell runs without it.
    if (named_ || status.code() != StatusCode::not_permitted)
      return Status::error(StatusCode::invalid_argument, "%s", status.cause());
    std::fprintf(stderr, "who did what is not written down: %s\n", status.cause());
  }
  for (std::string& line : file_.last_lines(most_recent)) {
    recent_.push_back(std::move(line));
    ++last_;
  }
  return {};
}

Status Audit::start() noexcept {
  if (!on_) return {};
  ThreadSettings settings;
  settings.name = "audit";
  return thread_.start(
      settings, [](void* self) { static_cast<Audit*>(self)->run(); }, this);
}

void Audit::begin_end() noexcept {
  ends_.store(true, std::memory_order_release);
}

void Audit::run() {
  while (!ends_.load(std::memory_order_acquire)) {
    turn(MonotonicClock::now());
    nanosleep(&turn_interval, nullptr);
  }
  const Time now = MonotonicClock::now();
  turn(now);
  tell_due(now, true);
  retry_at_ = {};
  write(now);
  conclude();
  ended_.store(true, std::memory_order_release);
}

void Audit::conclude() {
  const auto left = static_cast<std::uint64_t>(std::count(unwritten_.begin(), unwritten_.end(), '\n'));
  if (left + lost_ == 0) return;
  failure_ = Status::error(StatusCode::unavailable, "%llu entries of the audit are not written down: %s",
                           static_cast<unsigned long long>(left + lost_),
                           told_ ? "for a time its file could not be written" : told_.cause());
}

void Audit::turn(Time now) {
  AuditRecord record;
  for (std::uint32_t i = 0; i < AuditIntake::capacity && cell_.audit().take(record); ++i) take(record, now);
  if (const std::uint64_t dropped = cell_.audit().dropped(); dropped != dropped_told_) {
    tell(loss("lost entries: too many at a time", dropped - dropped_told_, now), now);
    dropped_told_ = dropped;
  }
  tell_due(now, false);
  write(now);
}

/// Of the end of a hold only the lease is known.
std::string Audit::owner_of(const AuditRecord& record) {
  if (record.kind != AuditRecord::Kind::hold_begin && record.kind != AuditRecord::Kind::hold_end)
    return record.who;
  if (record.kind == AuditRecord::Kind::hold_begin) {
    if (holds_.size() == most_holds) holds_.pop_front();
    holds_.push_back({record.number, record.who});
    return record.who;
  }
  const auto found = std::find_if(holds_.begin(), holds_.end(),
                                  [&](const OpenHold& hold) { return hold.number == record.number; });
  if (found == holds_.end()) return "somebody";
  std::string who = std::move(found->who);
  holds_.erase(found);
  return who;
}

Audit::Pending* Audit::find(const AuditRecord& record, std::string_view who) {
  // Each hold is told, its begin and its end.
  if (record.kind == AuditRecord::Kind::hold_begin || record.kind == AuditRecord::Kind::hold_end)
    return nullptr;
  const auto found = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    const AuditRecord& one = pending.entry.record;
    return one.kind == record.kind && one.block == record.block && one.component == record.component &&
           one.offset == record.offset && one.size == record.size && pending.entry.who == who &&
           std::strcmp(one.did, record.did) == 0 && std::strcmp(one.what, record.what) == 0;
  });
  return found == pending_.end() ? nullptr : &*found;
}

void Audit::take(const AuditRecord& record, Time now) {
  const std::string who = owner_of(record);
  note_stop(record, wall_clock_of(record.at, now));
  const std::uint64_t times = record.kind == AuditRecord::Kind::press ? record.number : 1;
  if (Pending* const pending = find(record, who); pending != nullptr) {
    if (is_act(record)) {
      pending->entry.count += times;
    } else {
      std::memcpy(pending->entry.record.after, record.after, sizeof(record.after));
    }
    pending->entry.record.at = record.at;
    pending->last = now;
    return;
  }
  AuditEntry entry{record, who, times};
  if (is_act(record)) {
    // In the order in which it happened.
    tell_changes(now);
    tell(entry, now);
    entry.count = 0;
  }
  if (record.kind == AuditRecord::Kind::hold_begin || record.kind == AuditRecord::Kind::hold_end) return;
  if (pending_.size() == most_pending) tell_due(now, true);
  pending_.push_back({std::move(entry), is_act(record), now, now});
}

bool Audit::is_over(const Pending& pending, Time now, bool all) noexcept {
  return all || now - pending.last >= quiet || now - pending.first >= longest_wait;
}

void Audit::tell_changes(Time now) {
  std::erase_if(pending_, [&](const Pending& pending) {
    if (is_act(pending.entry.record)) return false;
    tell(pending.entry, now);
    return true;
  });
}

void Audit::tell_due(Time now, bool all) {
  std::erase_if(pending_, [&](const Pending& pending) {
    if (!is_over(pending, now, all)) return false;
    if (pending.entry.count > 0) tell(pending.entry, now);
    return true;
  });
}

void Audit::tell(const AuditEntry& entry, Time now) {
  // Dragged there and back.
  const AuditRecord& record = entry.record;
  if (!is_act(record) && std::memcmp(record.before, record.after, record.size) == 0) return;
  std::string json = audit_json(cell_, entry, wall_clock_of(record.at, now));
  log_info("audit", "{}", std::string_view{audit_words(cell_, entry)});
  unwritten_ += json;
  unwritten_ += '\n';
  const std::lock_guard lock(mutex_);
  recent_.push_back(std::move(json));
  if (recent_.size() > most_recent) recent_.pop_front();
  ++last_;
}

void Audit::note_stop(const AuditRecord& record, std::int64_t at) {
  if (record.kind != AuditRecord::Kind::stop && record.kind != AuditRecord::Kind::clear) return;
  const std::lock_guard lock(mutex_);
  // Who stops what is stopped already is not the one to be asked.
  if (record.kind == AuditRecord::Kind::stop && stop_) return;
  stop_.reset();
  if (record.kind == AuditRecord::Kind::stop) {
    Stop stop;
    std::memcpy(stop.who, record.who, sizeof(record.who));
    stop.at = at;
    stop_ = stop;
  }
  revision_.fetch_add(1, std::memory_order_release);
}

/// A cause that stays is told once.
void Audit::write(Time now) {
  if (now < retry_at_) return keep_what_fits();
  while (!unwritten_.empty()) {
    const Status status = file_.append(unwritten_);
    if (!status) {
      if (std::strcmp(status.cause(), told_.cause()) != 0)
        log_error("audit", "who did what is not written down: {}; the cell goes on", status.cause());
      told_ = status;
      retry_at_ = now + retry_interval;
      return keep_what_fits();
    }
    unwritten_.clear();
    if (!told_) log_info("audit", "who did what is written down again");
    told_ = {};
    retry_at_ = {};
    if (lost_ == lost_told_) return;
    tell(loss("lost entries: they could not be written for too long", lost_ - lost_told_, now), now);
    lost_told_ = lost_;
  }
}

void Audit::keep_what_fits() {
  if (unwritten_.size() <= most_unwritten) return;
  const auto surplus = static_cast<std::ptrdiff_t>(unwritten_.find('\n', unwritten_.size() - most_unwritten));
  lost_ += static_cast<std::uint64_t>(std::count(unwritten_.begin(), unwritten_.begin() + surplus + 1, '\n'));
  unwritten_.erase(0, static_cast<std::size_t>(surplus) + 1);
}

std::optional<Audit::Stop> Audit::stopped_by() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

std::uint64_t Audit::visit(std::uint64_t after,
                           const std::function<void(std::uint64_t, std::string_view)>& entry) const {
  const std::lock_guard lock(mutex_);
  std::uint64_t number = last_ - recent_.size();
  for (const std::string& json : recent_) {
    if (++number > after) entry(number, json);
  }
  return last_;
}

}  // namespace flexrf
