#include "runtime/run/status_content.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "base/quantity_text.hpp"
#include "base/text_table.hpp"
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

StatusLine StatusContent::heading(Time now) const {
  const Control& control = cell_->control();
  std::string text = std::string{cell_->application().name} + "  " + phrase_of(control.mode());
  if (begun_ != Time{}) text += "  " + duration_text(now - begun_);
  if (control.mode() == Mode::running) text += std::string{"  "} + phrase_of_motion(control);
  return {control.motion_stopped() ? Style::alarm : Style::title, text};
}

/// Of components: what stood still is long past.
std::vector<StatusLine> StatusContent::faults() const {
  std::vector<StatusLine> lines;
  for (std::size_t place = 0; place < faults_.thread(0); ++place) {
    if (faults_.extent(place) == 0) continue;
    const FaultPlaces::Fault fault = faults_.at(place);
    lines.push_back({Style::alarm, "fault: " + fault.who + ": " + fault.cause});
  }
  return lines;
}

StatusContent::Section StatusContent::threads(Time now) {
  TextTable table({"thread", "per second", "cycles", "overruns", "late p50", "late p99", "step p50",
                   "step p99", "budget"});
  const double elapsed = last_ == Time{} ? 0 : seconds(now - last_);
  for (std::size_t i = 0; i < cycles_.size(); ++i) {
    const ThreadFigures thread = statistics_.thread(i);
    const std::string rate =
        elapsed > 0 ? number_text(static_cast<double>(thread.cycles - cycles_[i]) / elapsed, true)
                    : std::string{};
    cycles_[i] = thread.cycles;
    std::vector<std::string> cells{thread.record->name, rate, std::to_string(thread.cycles),
                                   std::to_string(thread.overruns)};
    if (thread.cycles > 0) {
      for (const Histogram* histogram : {thread.lateness, thread.execution}) {
        cells.push_back(duration_text(histogram->quantile(0.5)));
        cells.push_back(duration_text(histogram->quantile(0.99)));
      }
      cells.push_back(duration_if_any(thread.record->budget));
    }
    table.add(std::move(cells));
  }
  return {lines_of(table), "threads"};
}

StatusContent::Section StatusContent::units() const {
  TextTable table({"unit", "<life", "steps", "longest", "budget", "<device"});
  for (const ComponentFigures& unit : statistics_.units()) {
    if (!unit.active) continue;
    const ComponentRecord& record = *unit.record;
    std::string devices;
    for (const std::uint16_t number : cell_->devices_of(record.index)) {
      const DeviceFigures device = statistics_.device(number);
      devices +=
          (devices.empty() ? "" : ", ") + std::string{device.record->name} + " (" + device.driver + ")";
    }
    table.add({record.name, name_of(unit.life), std::to_string(unit.steps),
               duration_text(unit.execution_maximum), duration_if_any(record.budget), devices});
  }
  return {lines_of(table), "units"};
}

StatusContent::Section StatusContent::feedback() {
  slots_.begin_turn();
  TextTable table({"feedback", "<"});
  for (ComponentIndex i = 0; i < directory_.component_count(); ++i) {
    const ComponentEntry& entry = directory_.entry(i);
    if (entry.feedback_slot == no_index || !statistics_.component(i).active) continue;
    // The last feedback of a unit in fault is what one wants to see.
    const void* const last = slots_.read(entry.feedback_slot).last;
    if (last == nullptr) continue;
    const std::string text = feedback_text(*entry.type->feedback.type, last);
    if (!text.empty()) table.add({entry.name, text});
  }
  if (table.is_empty()) return {};
  return {lines_of(table), "values"};
}

/// A unit that hears of what a person does says in its summary what comes of it; one that has the device
/// itself, in that of its port.
StatusLine StatusContent::operation() const {
  std::string text = "Ctrl-C ends.";
  for (ComponentIndex i = 0; i < directory_.component_count(); ++i) {
    const ComponentEntry& entry = directory_.entry(i);
    for (const PortDescriptor& port : entry.type->ports) {
      if (!port.operated) continue;
      const bool has_device = port.direction == PortDescriptor::Direction::device;
      text += std::string{"  "} + entry.name + ": " + (has_device ? port.summary : entry.record->summary);
    }
  }
  return {Style::faint, text};
}

std::vector<StatusLine> StatusContent::lines(Time now, std::size_t rows) {
  if (begun_ == Time{} && cell_->control().mode() >= Mode::running) begun_ = now;
  std::vector<StatusLine> lines{heading(now)};
  for (StatusLine& fault : faults()) lines.push_back(std::move(fault));
  lines.push_back(operation());
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
