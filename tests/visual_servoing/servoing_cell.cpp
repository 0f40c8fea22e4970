#include "tests/visual_servoing/servoing_cell.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::visual_servoing {
namespace {

Options options_for(std::uint64_t seed) {
  Options options;
  options.virtual_time = std::chrono::hours(24);  // run() says when it ends
  options.realtime = false;
  options.digest = true;
  options.seed = seed;
  return options;
}

template <class Records>
std::size_t index_of(const Records& records, const char* name) {
  for (std::size_t i = 0; i < records.size(); ++i)
    if (std::strcmp(records[i].name, name) == 0) return i;
  throw fixture::CheckFailed{std::string{"the application has no "} + name};
}

}  // namespace

ServoingCell::ServoingCell(std::uint64_t seed) : executive_(application::application, options_for(seed)) {
  const Status status = executive_.prepare();
  if (!status) throw fixture::CheckFailed{std::string{"prepare: "} + status.cause()};
  requester_ = executive_.cell().add_requester(answers_);
  const Application& application = executive_.cell().application();
  const std::size_t control = index_of(application.threads, "control");
  clock_ = application.threads[control].context;
  cycles_ = &application.thread_states[control].cycles;
  picker_ = &told_by<PartPickerFeedback>("picker");
  table_ = &told_by<SceneFeedback>("table");
}

RunSummary ServoingCell::run(Duration longest, std::function<void()> look_too) {
  look_ = std::move(look_too);
  std::function<void()> job;
  job = [this, longest, &job] {
    look();
    const bool is_over = place_ == steps_.size() && !steps_.empty();
    if (is_over || now_ - began_ > longest || !problem_.empty()) executive_.request_end();
    executive_.lifecycle().post(job);
  };
  executive_.lifecycle().post(job);
  const RunSummary summary = executive_.run();
  if (!problem_.empty()) throw fixture::CheckFailed{problem_};
  if (place_ < steps_.size())
    throw fixture::CheckFailed{"it waits in vain for: " + steps_[place_].what +
                               "; the picker says: " + message()};
  return summary;
}

/// On the thread of the virtual time, between two events: nothing else runs.
void ServoingCell::look() {
  const std::uint64_t cycle = cycles_->load();
  if (cycle == cycle_) return;
  cycle_ = cycle;
  now_ = clock_->now;
  if (began_ == Time{}) began_ = stepped_at_ = now_;
  ParameterAnswer answer;
  while (answers_.pop(answer))
    if (answer.kind != AnswerKind::accepted) problem_ = std::string{"refused: "} + answer.reason;
  try {
    if (look_) look_();
    if (place_ < steps_.size() && steps_[place_].condition()) {
      const Step& step = steps_[place_++];
      stepped_at_ = now_;
      if (step.act) step.act();
    }
  } catch (const fixture::CheckFailed& failed) {
    problem_ = failed.message;
  }
}

ServoingCell& ServoingCell::when(std::string what, std::function<bool()> condition,
                                 std::function<void()> act) {
  steps_.push_back({std::move(what), std::move(condition), std::move(act)});
  return *this;
}

ServoingCell& ServoingCell::after(Duration pause, std::function<void()> act) {
  return when(
      "a pause", [this, pause] { return now_ - stepped_at_ >= pause; }, std::move(act));
}

ServoingCell& ServoingCell::when_in(PickerState state, std::function<void()> act) {
  return when(
      "state " + std::to_string(static_cast<int>(state)), [this, state] { return picker_->state == state; },
      std::move(act));
}

ComponentIndex ServoingCell::component(const char* name) {
  const Application& application = executive_.cell().application();
  for (std::size_t i = 0; i < application.units.size(); ++i)
    if (std::strcmp(application.units[i].name, name) == 0) return static_cast<ComponentIndex>(i);
  return static_cast<ComponentIndex>(application.units.size() + index_of(application.devices, name));
}

std::uint16_t ServoingCell::parameter(ComponentIndex component, const char* name) {
  const auto parameters = executive_.cell().component_type(component).runtime.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (std::strcmp(parameters[i].field->name, name) == 0) return static_cast<std::uint16_t>(i);
  throw fixture::CheckFailed{std::string{"there is no parameter "} + name};
}

ParameterMemory ServoingCell::memory_of(const char* name) {
  return executive_.cell().component(component(name)).parameter_memory();
}

void ServoingCell::copy_newest(const char* slot, void* value, std::size_t size) {
  const Application& application = executive_.cell().application();
  const SlotRecord& record = application.slots[index_of(application.slots, slot)];
  const auto lock = executive_.cell().observe();
  if (record.observer->newest() != nullptr) std::memcpy(value, record.observer->payload(), size);
}

void ServoingCell::press(const char* name, const char* button) {
  ParameterRequest request;
  request.kind = RequestKind::press;
  request.component = component(name);
  CHECK(request.add_presses(parameter(request.component, button)));
  send(request);
}

void ServoingCell::change(const char* name, const char* changed, const void* value, std::size_t size) {
  ParameterRequest request;
  request.kind = RequestKind::set;
  request.component = component(name);
  CHECK(request.add(parameter(request.component, changed), 0, value, size));
  send(request);
}

void ServoingCell::send(ParameterRequest request) {
  request.requester = requester_;
  executive_.cell().send(request);
}

void ServoingCell::initialise(const char* name) {
  executive_.act(ComponentAction::initialise, component(name), [this](const Status& status) {
    if (!status) problem_ = std::string{"initialise: "} + status.cause();
  });
}

}  // namespace flexrf::visual_servoing
