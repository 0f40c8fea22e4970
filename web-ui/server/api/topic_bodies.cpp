#include "web-ui/server/api/topic_bodies.hpp"

#include <algorithm>
#include <ctime>

#include "runtime/face/json_parts.hpp"
#include "runtime/realtime/process_statistics.hpp"

namespace flexrf::panel {
namespace {

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
  json.begin_object();
  write_quantiles(json, histogram);
  json.key("buckets").begin_array();
  for (std::uint32_t bucket = 0; bucket < Histogram::buckets; ++bucket) {
    const std::uint64_t count = histogram.in_bucket(bucket);
    if (count != 0) json.value(bucket).value(count);
  }
  json.end_array().end_object();
}

void write_life(JsonWriter& json, const ComponentFigures& component) {
  json.member("life", flexrf::name_of(component.life)).member("fault", component.fault.cause());
}

/// Below 0 it is not known.
void write_known(JsonWriter& json, const char* name, std::int64_t number) {
  json.key(name);
  number >= 0 ? json.value(number) : json.null();
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
    case Topic::steps:
      return "steps";
    case Topic::log:
      return "log";
  }
  return "unknown";
}

TopicBodies::TopicBodies(Cell& cell)
    : cell_(&cell),
      statistics_(cell),
      response_estimates_(response_estimates(cell, cell.options().realtime)),
      figures_(response_estimates_.size()),
      steps_(std::min(StepTrace::most, most_steps / std::max<std::size_t>(figures_.size(), 1))) {
  cell.keep_step_traces();
  constexpr std::size_t longest_score = 25;  // "-1.7976931348623157e+308,"
  for (const QueueFigures& queue : statistics_.queues()) {
    if (queue.is_by_score())
      room_of_scores_ += longest_score * std::min<std::size_t>(queue.record->capacity, most_scores);
  }
}

/// Beyond twice what the first one takes.
std::size_t TopicBodies::room_to_grow(Topic topic) const noexcept {
  constexpr std::size_t usual_step = 24;  // "123,1234567890,123456789,"
  if (topic == Topic::queues) return room_of_scores_;
  return topic == Topic::steps ? usual_step * steps_.size() * figures_.size() : 0;
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
    body.text.reserve(2 * body.text.size() + room_to_grow(topic));
    body.former.reserve(body.text.capacity());
  }
  if (body.version == 0 || body.text != body.former) ++body.version;
  return body.text;
}

void TopicBodies::write(JsonWriter& json, Topic topic, Time now) {
  switch (topic) {
    case Topic::components:
      json.begin_array();
      for (ComponentIndex i = 0; i < cell_->component_count(); ++i) write_component(json, i);
      json.end_array();
      return;
    case Topic::slots:
      return write_slots(json);
    case Topic::queues:
      return write_queues(json);
    case Topic::threads:
      return write_threads(json, now);
    case Topic::steps:
      return write_steps(json, now);
    case Topic::log:
      break;
  }
}

void TopicBodies::write_component(JsonWriter& json, ComponentIndex index) const {
  const ComponentFigures component = statistics_.component(index);
  const ComponentRecord& record = *component.record;
  json.begin_object().member("name", record.name).member("kind", record.kind);
  const bool has_driver = component.driver[0] != '\0';
  json.member(has_driver ? "driver" : "type", has_driver ? component.driver : component.type->name);
  write_life(json, component);
  json.member("restraint", RestraintText(component.restraint).text)
      .member("restraints", component.restraints)
      .member("budget_overruns", component.budget_overruns);
  json.member("active", component.active).key("member");
  if (component.population == nullptr) {
    json.null();
  } else {
    json.begin_object().member("population", component.population);
    json.member("index", record.member).end_object();
  }
  json.member("steps", component.steps).key("execution").begin_object();
  json.member("mean_ns", component.execution_mean.count());
  json.member("max_ns", component.execution_maximum.count()).end_object().end_object();
}

void TopicBodies::write_devices(JsonWriter& json) const {
  json.begin_array();
  for (const DeviceFigures& device : statistics_.devices()) {
    json.begin_object().member("name", device.record->name).member("interface", device.device->interface);
    json.member("driver", device.driver).member("kind", flexrf::name_of(device.chosen->kind));
    json.member("actuates", device.chosen->actuates).member("unit", device.unit).member("bus", device.bus);
    json.member("thread", device.thread);
    write_life(json, device);
    json.member("inhibited", device.inhibited).end_object();
  }
  json.end_array();
}

void TopicBodies::write_slots(JsonWriter& json) const {
  json.begin_array();
  for (const SlotFigures& slot : statistics_.slots()) {
    json.begin_object().member("name", slot.record->name).member("published", slot.published);
    write_readers(json, slot);
    json.end_object();
  }
  json.end_array();
}

void TopicBodies::write_queues(JsonWriter& json) const {
  json.begin_array();
  for (const QueueFigures& queue : statistics_.queues()) {
    json.begin_object().member("name", queue.record->name);
    write_queue(json, queue);
    json.end_object();
  }
  json.end_array();
}

void TopicBodies::write_threads(JsonWriter& json, Time now) {
  const bool look_up = figures_at_ == Time{} || now >= figures_at_ + std::chrono::seconds{1};
  if (look_up) figures_at_ = now;
  json.begin_array();
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    const ThreadFigures thread = statistics_.thread(i);
    if (look_up && thread.id != 0) {
      if (const Result<ThreadStatistics> kernel = read_thread_statistics(thread.id); kernel)
        figures_[i] = {kernel->cpu, kernel->minor_faults, kernel->major_faults};
    }
    json.begin_object().member("name", thread.record->name);
    write_cycles(json, thread);
    json.member("allocations", thread.allocations).member("budget_ns", thread.record->budget.count());
    const Duration response = response_estimates_[i].value_or(Duration::max());
    write_known(json, "response_estimate_ns", response == Duration::max() ? -1 : response.count());
    write_known(json, "cpu", figures_[i].cpu);
    write_known(json, "cpu_time_ns", cpu_time(thread.id));
    json.member("minor_faults", figures_[i].minor_faults).member("major_faults", figures_[i].major_faults);
    write_backoff(json, thread);
    json.key("lateness");
    write_histogram(json, *thread.lateness);
    json.key("execution");
    write_histogram(json, *thread.execution);
    json.end_object();
  }
  json.end_array();
}

void TopicBodies::write_steps(JsonWriter& json, Time now) {
  StepTraces& traces = *cell_->step_traces();
  traces.ask(now + traced_for);
  const std::span<const ThreadRecord> threads = cell_->application().threads;
  json.begin_array();
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const auto [count, cut] = traces.of(i).copy(now - told_for, steps_);
    const std::span<const TracedStep> told = std::span<const TracedStep>{steps_}.first(count);
    const Time begin = told.empty() ? Time{} : told[0].begin;
    json.begin_object().member("thread", threads[i].name).member("begin_ns", nanoseconds(begin));
    json.member("cut", cut).key("steps").begin_array();
    for (const TracedStep& step : told)
      json.value(step.unit).value((step.begin - begin).count()).value(step.took.count());
    json.end_array().end_object();
  }
  json.end_array();
}

}  // namespace flexrf::panel
