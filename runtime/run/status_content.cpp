#include "runtime/run/status_content.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "runtime/core/text_table.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

using Style = StatusLine::Style;

/// The table's text as lines; the first is its title.
std::vector<StatusLine> lines_of(const TextTable& table) {
  std::vector<StatusLine> lines;
  const std::string text = table.text("");
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back({lines.empty() ? Style::faint : Style::plain, text.substr(begin, end - begin)});
    begin = end + 1;
  }
  return lines;
}

std::string number_text(double number, bool whole) {
  char text[40];
  std::snprintf(text, sizeof(text), whole ? "%.0f" : "%.4g", number);
  return text;
}

/// Text for a glance: four digits, the unit of measure behind.
std::string glance_at(const FieldDescriptor& field, const void* structure) {
  constexpr std::uint32_t most_elements = 8;
  const FieldPlace place = whole(field);
  if (field.scalar == Scalar::structure) return {};
  if (field.scalar == Scalar::text || field.scalar == Scalar::boolean || field.scalar == Scalar::enumeration)
    return text_of(place, structure);
  const bool is_whole = field.scalar != Scalar::f32 && field.scalar != Scalar::f64;
  std::string text;
  for (std::uint32_t i = 0; i < std::min(place.count, most_elements); ++i) {
    const Result<double> number = read_number(place, structure, i);
    if (!number) return {};
    text += (i == 0 ? "" : " ") + number_text(*number, is_whole);
  }
  if (place.count > most_elements) text += " ...";
  if (*field.unit != '\0' && std::strcmp(field.unit, "1") != 0) text += std::string{" "} + field.unit;
  return text;
}

/// "moving true, motions 3"
std::string feedback_text(const TypeDescriptor& type, const void* values) {
  std::string text;
  for (const FieldDescriptor& field : type.fields) {
    const std::string value = glance_at(field, values);
    if (value.empty()) continue;
    text += (text.empty() ? "" : ", ") + std::string{field.name} + " " + value;
  }
  return text;
}

}  // namespace

StatusContent::StatusContent(Cell& cell) : cell_(&cell), cycles_(cell.application().threads.size()) {}

StatusLine StatusContent::heading(Time now) const {
  const Control& control = cell_->control();
  std::string text = std::string{cell_->application().name} + "  " + phrase_of(control.mode());
  if (begun_ != Time{}) text += "  " + duration_text(now - begun_);
  if (control.motion_stopped()) {
    text += "  motion: Stop is latched";
  } else {
    text += control.may_move() ? "  motion: allowed" : "  motion: inhibited until Start";
  }
  return {control.motion_stopped() ? Style::alarm : Style::title, text};
}

std::vector<StatusLine> StatusContent::faults() const {
  std::vector<StatusLine> lines;
  const Application& application = cell_->application();
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    const ComponentState& state = application.component_state(i);
    if (state.is_in_fault())
      lines.push_back({Style::alarm, "fault: " + std::string{application.component(i).name} + ": " +
                                         state.fault.read().cause()});
  }
  return lines;
}

StatusContent::Section StatusContent::threads(Time now) {
  const Application& application = cell_->application();
  TextTable table({"thread", "per second", "cycles", "overruns", "late p50", "late p99", "step p50",
                   "step p99", "budget"});
  const double elapsed = last_ == Time{} ? 0 : seconds(now - last_);
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    const ThreadState& state = application.thread_states[i];
    const std::uint64_t cycles = state.cycles.load(std::memory_order_relaxed);
    const std::string rate =
        elapsed > 0 ? number_text(static_cast<double>(cycles - cycles_[i]) / elapsed, true) : std::string{};
    cycles_[i] = cycles;
    std::vector<std::string> cells{application.threads[i].name, rate, std::to_string(cycles),
                                   std::to_string(state.overruns.load(std::memory_order_relaxed))};
    if (cycles > 0) {
      for (const Histogram* histogram : {&state.lateness, &state.execution}) {
        cells.push_back(duration_text(histogram->quantile(0.5)));
        cells.push_back(duration_text(histogram->quantile(0.99)));
      }
      const Duration budget = application.threads[i].budget;
      cells.push_back(budget.count() > 0 ? duration_text(budget) : "");
    }
    table.add(std::move(cells));
  }
  return {lines_of(table), "threads"};
}

StatusContent::Section StatusContent::units() const {
  const Application& application = cell_->application();
  TextTable table({"unit", "<life", "steps", "longest", "budget", "<device"});
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    const UnitState& state = application.unit_states[i];
    if (!state.active.load(std::memory_order_relaxed)) continue;
    std::string devices;
    for (const std::uint16_t device : cell_->devices_of(static_cast<std::uint16_t>(i))) {
      devices += (devices.empty() ? "" : ", ") + std::string{application.devices[device].name} + " (" +
                 cell_->driver(device).name + ")";
    }
    const Duration budget = application.units[i].budget;
    table.add({application.units[i].name, name_of(state.life.load(std::memory_order_acquire)),
               std::to_string(state.steps.load(std::memory_order_relaxed)),
               duration_text(Duration{state.execution_maximum.load(std::memory_order_relaxed)}),
               budget.count() > 0 ? duration_text(budget) : "", devices});
  }
  return {lines_of(table), "units"};
}

StatusContent::Section StatusContent::feedback() const {
  const Application& application = cell_->application();
  const auto lock = cell_->observe();
  TextTable table({"feedback", "<"});
  const auto add = [&](const char* name, const SlotControl* control) {
    if (control == nullptr) return;
    for (const SlotRecord& slot : application.slots) {
      if (slot.control != control || slot.observer == nullptr) continue;
      // The writer's state is not asked: the last feedback of a unit in fault is what one wants to see.
      if (slot.observer->newest() == nullptr) return;
      const std::string text = feedback_text(*control->type(), slot.observer->payload());
      if (!text.empty()) table.add({name, text});
      return;
    }
  };
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    if (application.component_state(i).active.load(std::memory_order_relaxed))
      add(application.component(i).name, application.component(i).feedback_slot);
  }
  if (table.is_empty()) return {};
  return {lines_of(table), "values"};
}

/// Who reads keys says in its summary what they do.
StatusLine StatusContent::keys() const {
  std::string text = "Ctrl-C ends.";
  for (const UnitRecord& unit : cell_->application().units) {
    for (const PortDescriptor& port : unit.type->ports) {
      using Direction = PortDescriptor::Direction;
      if (port.direction == Direction::queue_input && std::strcmp(port.type, "KeyEvent") == 0) {
        text += std::string{"  "} + unit.name + ": " + unit.summary;
      } else if (port.direction == Direction::device && std::strcmp(port.type, "Keyboard") == 0) {
        text += std::string{"  "} + unit.name + ": " + port.summary;
      }
    }
  }
  return {Style::faint, text};
}

std::vector<StatusLine> StatusContent::lines(Time now, std::size_t rows) {
  if (begun_ == Time{} && cell_->control().mode() >= Mode::running) begun_ = now;
  std::vector<StatusLine> lines{heading(now)};
  for (StatusLine& fault : faults()) lines.push_back(std::move(fault));
  lines.push_back(keys());
  std::vector<Section> sections;
  sections.push_back(threads(now));
  sections.push_back(units());
  sections.push_back(feedback());
  last_ = now;
  for (Section& section : sections) {
    if (section.lines.empty() || lines.size() >= rows) continue;
    const std::size_t room = rows - lines.size();
    if (section.lines.size() > room) {
      // A title with nothing below it tells nobody anything.
      if (room < 3) continue;
      const std::size_t left_out = section.lines.size() - (room - 1);
      section.lines.resize(room - 1);
      section.lines.push_back({Style::faint, "... " + std::to_string(left_out) + " more " + section.what});
    }
    std::move(section.lines.begin(), section.lines.end(), std::back_inserter(lines));
  }
  if (lines.size() > rows) lines.resize(rows);
  return lines;
}

}  // namespace flexrf
