#include "web-ui/server/api/topic_bodies.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>

#include "runtime/executive/schedulability.hpp"
#include "runtime/realtime/machine_file.hpp"
#include "runtime/realtime/process_statistics.hpp"

namespace flexrf::panel {
namespace {

std::int64_t number(Duration duration) noexcept {
  return duration.count();
}

/// CPU time of a thread of this process, as the kernel counts it; −1: unknown. The clock's number is made as
/// pthread_getcpuclockid(3) makes it, from the thread's number in place of its handle.
std::int64_t cpu_time(pid_t thread) noexcept {
  constexpr unsigned per_thread_scheduled = 6;
  timespec used{};
  const auto clock = static_cast<clockid_t>((~static_cast<unsigned>(thread) << 3) | per_thread_scheduled);
  if (thread <= 0 || clock_gettime(clock, &used) != 0) return -1;
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

void write_histogram(JsonWriter& json, const Histogram& histogram) {
  json.begin_object().member("count", histogram.count());
  json.member("p50_ns", number(histogram.quantile(0.5))).member("p99_ns", number(histogram.quantile(0.99)));
  json.member("p99.9_ns", number(histogram.quantile(0.999))).member("max_ns", number(histogram.maximum()));
  json.key("buckets").begin_array();
  for (std::uint32_t bucket = 0; bucket < Histogram::buckets; ++bucket) {
    const std::uint64_t count = histogram.in_bucket(bucket);
    if (count != 0) json.value(bucket).value(count);
  }
  json.end_array().end_object();
}

}  // namespace

const char* name_of(Topic topic) noexcept {
  switch (topic) {
    case Topic::components:
      return "components";
    case Topic::slots:
      return "slots";
    case Topic::queues:
      return "queues";
    case Topic::threads:
      return "threads";
    case Topic::log:
      return "log";
  }
  return "unknown";
}

TopicBodies::TopicBodies(Executive& executive)
    : executive_(&executive),
      application_(&executive.cell().application()),
      readers_(readers_of_slots(*application_)),
      response_estimates_(application_->threads.size()),
      figures_(application_->threads.size()) {
  // Ordinary threads are promised nothing.
  if (!executive.options().realtime) return;
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (!machine) return;
  const auto estimates = estimate_response_times(*application_, *machine);
  for (std::size_t i = 0; i < estimates.size() && i < response_estimates_.size(); ++i) {
    if (estimates[i] && estimates[i]->result.response != Duration::max())
      response_estimates_[i] = estimates[i]->result.response;
  }
}

/// Why it does less than it was commanded now, and how often that was so.
void TopicBodies::write_restraint(JsonWriter& json, const SharedRestraint& shared) {
  const Restraint restraint = shared.read();
  char numbers[80] = "";
  if (restraint.reason != nullptr && !std::isnan(restraint.asked))
    std::snprintf(numbers, sizeof(numbers), ": %.4g asked for, %.4g done", restraint.asked, restraint.given);
  char text[200] = "";
  if (restraint.reason != nullptr) std::snprintf(text, sizeof(text), "%.110s%s", restraint.reason, numbers);
  json.member("restraint", text).member("restraints", shared.count());
}

std::string_view TopicBodies::body(Topic topic, Time now) {
  Body& body = bodies_[static_cast<std::size_t>(topic)];
  if (body.version != 0 && now < body.made_at + shortest_interval) return body.text;
  body.made_at = now;
  std::swap(body.text, body.former);
  body.text.clear();
  JsonWriter json(std::move(body.text));
  write(json, topic, now);
  body.text = json.release();
  // Nearly all of it are names, which stay: numbers that grow, also by a standstill, find room from now on.
  if (body.version == 0) {
    body.text.reserve(2 * body.text.size());
    body.former.reserve(body.text.capacity());
  }
  if (body.version == 0 || body.text != body.former) ++body.version;
  return body.text;
}

void TopicBodies::write(JsonWriter& json, Topic topic, Time now) {
  switch (topic) {
    case Topic::components:
      json.begin_array();
      for (ComponentIndex i = 0; i < executive_->cell().component_count(); ++i) write_component(json, i);
      json.end_array();
      return;
    case Topic::slots:
      return write_slots(json);
    case Topic::queues:
      return write_queues(json);
    case Topic::threads:
      return write_threads(json, now);
    case Topic::log:
      break;
  }
}

void TopicBodies::write_component(JsonWriter& json, ComponentIndex component) const {
  const ComponentRecord& record = application_->component(component);
  const ComponentState& state = application_->component_state(component);
  json.begin_object().member("name", record.name).member("kind", record.kind);
  if (state.driver == nullptr) {
    json.member("type", state.type->name);
  } else {
    json.member("driver", state.driver->name);
  }
  write_life(json, state);
  write_restraint(json, state.restraint);
  write_steps(json, record, state);
  json.end_object();
}

void TopicBodies::write_life(JsonWriter& json, const ComponentState& state) {
  const Life life = state.life.load(std::memory_order_acquire);
  json.member("life", flexrf::name_of(life))
      .member("fault", life == Life::fault ? state.fault.read().cause() : "");
}

void TopicBodies::write_steps(JsonWriter& json, const ComponentRecord& record,
                              const ComponentState& state) const {
  const std::uint64_t steps = state.steps.load(std::memory_order_relaxed);
  const std::int64_t total = state.execution_total.load(std::memory_order_relaxed);
  json.member("active", state.active.load(std::memory_order_relaxed)).key("member");
  if (record.population == no_index) {
    json.null();
  } else {
    json.begin_object().member("population", application_->populations[record.population].name);
    json.member("index", record.member).end_object();
  }
  json.member("steps", steps).key("execution").begin_object();
  json.member("mean_ns", steps == 0 ? 0 : total / static_cast<std::int64_t>(steps));
  json.member("max_ns", state.execution_maximum.load(std::memory_order_relaxed)).end_object();
}

void TopicBodies::write_devices(JsonWriter& json) const {
  json.begin_array();
  for (std::size_t i = 0; i < application_->devices.size(); ++i) {
    const DeviceRecord& device = application_->devices[i];
    const DeviceState& state = application_->device_states[i];
    const DriverRecord& driver = executive_->cell().driver(static_cast<std::uint16_t>(i));
    json.begin_object().member("name", device.name).member("interface", device.interface);
    json.member("driver", driver.name).member("kind", flexrf::name_of(driver.kind));
    json.member("actuates", driver.actuates);
    json.member("unit", device.unit == no_index ? "" : application_->units[device.unit].name);
    json.member("bus", device.bus == no_index ? "" : application_->devices[device.bus].name);
    json.member("thread", application_->threads[device.thread].name);
    write_life(json, state);
    json.member("inhibited", driver.actuates && state.device->is_inhibited()).end_object();
  }
  json.end_array();
}

void TopicBodies::write_readers(JsonWriter& json, std::uint16_t slot) const {
  json.begin_array();
  for (const SlotInput& reader : readers_[slot]) {
    const InputCounters counters = reader.counters(*application_);
    json.begin_object().member("name", reader.name).member("read", counters.read);
    json.member("missed", counters.missed).end_object();
  }
  json.end_array();
}

void TopicBodies::write_slots(JsonWriter& json) const {
  json.begin_array();
  for (std::size_t i = 0; i < application_->slots.size(); ++i) {
    const SlotRecord& slot = application_->slots[i];
    json.begin_object()
        .member("name", slot.name)
        .member("published", slot.control->published())
        .key("readers");
    write_readers(json, static_cast<std::uint16_t>(i));
    json.end_object();
  }
  json.end_array();
}

void TopicBodies::write_queues(JsonWriter& json) const {
  json.begin_array();
  for (const QueueRecord& queue : application_->queues) {
    json.begin_object().member("name", queue.name).member("capacity", queue.capacity);
    json.key("writers").begin_array();
    for (std::size_t i = 0; i < queue.sinks.size(); ++i) {
      const QueueCounters counters = queue.sinks[i]->counters();
      json.begin_object().member("name", queue.writers[i]).member("pushed", counters.pushed);
      json.member("popped", counters.popped).member("dropped", counters.dropped).end_object();
    }
    json.end_array().key("readers").begin_array();
    for (const char* const reader : queue.readers) json.value(reader);
    json.end_array().end_object();
  }
  json.end_array();
}

void TopicBodies::write_threads(JsonWriter& json, Time now) {
  const bool look_up = figures_at_ == Time{} || now >= figures_at_ + std::chrono::seconds{1};
  if (look_up) figures_at_ = now;
  json.begin_array();
  for (std::size_t i = 0; i < application_->threads.size(); ++i) {
    const ThreadRecord& thread = application_->threads[i];
    const ThreadState& state = application_->thread_states[i];
    const pid_t id = state.thread_id.load(std::memory_order_relaxed);
    if (look_up && id != 0) {
      if (const Result<ThreadStatistics> statistics = read_thread_statistics(id); statistics)
        figures_[i] = {statistics->cpu, statistics->minor_faults, statistics->major_faults};
    }
    json.begin_object().member("name", thread.name).member("cycles", state.cycles.load());
    json.member("overruns", state.overruns.load()).member("skipped", state.skipped.load());
    json.member("skipped_time_ns", state.skipped_time.load());
    json.member("longest_standstill_ns", state.longest_standstill.load());
    json.member("allocations", state.allocations.load()).member("budget_ns", number(thread.budget));
    json.key("response_estimate_ns");
    response_estimates_[i] ? json.value(number(*response_estimates_[i])) : json.null();
    json.key("cpu");
    figures_[i].cpu >= 0 ? json.value(figures_[i].cpu) : json.null();
    const std::int64_t used = cpu_time(id);
    json.key("cpu_time_ns");
    used >= 0 ? json.value(used) : json.null();
    json.member("minor_faults", figures_[i].minor_faults).member("major_faults", figures_[i].major_faults);
    json.key("lateness");
    write_histogram(json, state.lateness);
    json.key("execution");
    write_histogram(json, state.execution);
    json.end_object();
  }
  json.end_array();
}

}  // namespace flexrf::panel
