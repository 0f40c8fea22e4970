// Threads of a generated application: their memory and their records.
#include "config-gen/emit/application_parts.hpp"
#include "config-gen/model/memory.hpp"

namespace flexrf::config_gen {
namespace {

// The lowest page is the guard; what the table asks for lies above it.
std::size_t stack_size(const Thread& thread) {
  return (thread.stack + page - 1) / page * page + page;
}

std::string source_text(const ApplicationNames& names, const SourceReference& source) {
  return source.queue ? "{.queue = " + names.source(source.index) + "}"
                      : "{.slot = &slot_" + names.slot(source.index) + "}";
}

std::string optional_duration(std::string_view field, const std::optional<Nanoseconds>& value) {
  return value ? ", ." + std::string(field) + " = " + duration_literal(*value) : "";
}

// The trigger as an initialiser; writes the array of its sources beforehand.
struct TriggerText {
  const ApplicationNames& names;
  const std::string& thread;
  Text& out;

  std::string operator()(const PeriodTrigger& trigger) const {
    return "{.kind = TriggerKind::period, .period = " + duration_literal(trigger.period) +
           ", .phase = " + duration_literal(trigger.phase) + ", .sources = {}}";
  }
  std::string operator()(const SlotsTrigger& trigger) const {
    return "{.kind = TriggerKind::slots" + optional_duration("min_interval", trigger.min_interval) +
           optional_duration("timeout", trigger.timeout) + ", .sources = " + sources(trigger.sources) + "}";
  }
  std::string operator()(const DeviceTrigger& trigger) const {
    return "{.kind = TriggerKind::device" + optional_duration("min_interval", trigger.min_interval) +
           optional_duration("timeout", trigger.timeout) +
           ", .sources = {}, .device = " + std::to_string(trigger.device) + "}";
  }
  std::string operator()(const BackoffTrigger& trigger) const {
    return "{.kind = TriggerKind::backoff, .sources = " + sources({trigger.source}) +
           ", .shortest = " + duration_literal(trigger.shortest) +
           ", .longest = " + duration_literal(trigger.longest) +
           ", .tries = " + std::to_string(trigger.tries) + "}";
  }
  std::string operator()(const FreeTrigger&) const { return "{.kind = TriggerKind::free, .sources = {}}"; }

  std::string sources(const std::vector<SourceReference>& all) const {
    const std::string list =
        list_of(all, [&](const SourceReference& one) { return source_text(names, one); });
    emit_array("constexpr TriggerSource", "sources_" + thread, list, out);
    return array_or_none("sources_" + thread, list);
  }
};

// What the table says, or the time until the next release.
Nanoseconds deadline_of(const Thread& thread) {
  if (thread.deadline) return *thread.deadline;
  if (const auto* period = std::get_if<PeriodTrigger>(&thread.trigger)) return period->period;
  if (const auto* slots = std::get_if<SlotsTrigger>(&thread.trigger)) return slots->min_interval.value_or(0);
  if (const auto* device = std::get_if<DeviceTrigger>(&thread.trigger))
    return device->min_interval.value_or(0);
  return 0;
}

std::string overrun_policy(const Overrun& overrun) {
  switch (overrun.policy) {
    case Overrun::Policy::skip:
      return "skip";
    case Overrun::Policy::catch_up:
      return "catch_up";
    case Overrun::Policy::fault:
      break;
  }
  return "fault";
}

std::string overrun_limit(const Overrun& overrun) {
  switch (overrun.limit) {
    case Overrun::Limit::none:
      return "{}";
    case Overrun::Limit::consecutive:
      return "{false, " + std::to_string(overrun.consecutive) + ", 0}";
    case Overrun::Limit::leaky:
      break;
  }
  return "{true, " + std::to_string(overrun.leaky_limit) + ", " + std::to_string(overrun.leaky_drain) + "}";
}

}  // namespace

void emit_threads_memory(const Model& model, const ApplicationNames& names, Text& out,
                         std::vector<std::string>& sizes) {
  if (model.threads.empty()) return;
  out << "\n// ---- Threads: what their units are told, what they sleep on, their stacks\n\n";
  for (Index i = 0; i < model.threads.size(); ++i) {
    const std::string& name = names.thread(i);
    out << "alignas(cache_line) constinit StepContext context_" << name << "{};\n"
        << "alignas(cache_line) constinit Doorbell bell_" << name << "{};\n"
        << "alignas(page) std::byte stack_" << name << "[" << stack_size(model.threads[i]) << "];\n";
    sizes.push_back("sizeof(stack_" + name + ")");
  }
}

void emit_thread_records(const Model& model, const ApplicationNames& names, Text& out) {
  if (model.threads.empty()) return;
  out << "\n";
  const auto number = [](Index index) { return std::to_string(index); };
  Text records;
  for (Index i = 0; i < model.threads.size(); ++i) {
    const Thread& thread = model.threads[i];
    const std::string& name = names.thread(i);
    const std::string units = list_of(thread.units, number);
    const std::string devices = list_of(thread.devices, number);
    emit_array("constexpr std::uint16_t", "thread_units_" + name, units, out);
    emit_array("constexpr std::uint16_t", "thread_devices_" + name, devices, out);
    const std::string trigger = std::visit(TriggerText{names, name, out}, thread.trigger);
    records << "    {.name = \"" << thread.name << "\",\n     .summary = " << string_literal(thread.summary)
            << ",\n     .trigger = " << trigger << ",\n     .priority = " << thread.priority
            << ",\n     .above_interrupts = " << bool_literal(thread.above_interrupts)
            << ",\n     .role = CpuRole::" << name_of(thread.role)
            << ",\n     .overrun = OverrunPolicy::" << overrun_policy(thread.overrun)
            << ",\n     .limit = " << overrun_limit(thread.overrun)
            << ",\n     .budget = " << duration_literal(thread.demand)
            << ",\n     .deadline = " << duration_literal(deadline_of(thread))
            << ",\n     .hang_timeout = " << duration_literal(thread.hang_timeout.value_or(0))
            << ",\n     .units = " << array_or_none("thread_units_" + name, units)
            << ",\n     .devices = " << array_or_none("thread_devices_" + name, devices)
            << ",\n     .stack = stack_" << name << ",\n     .stack_size = sizeof(stack_" << name
            << "),\n     .context = &context_" << name << ",\n     .bell = &bell_" << name << "},\n";
  }
  out << "constexpr ThreadRecord threads_table[] = {\n" << records.str() << "};\n";
}

}  // namespace flexrf::config_gen
