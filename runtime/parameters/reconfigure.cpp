#include "runtime/parameters/reconfigure.hpp"

#include <algorithm>
#include <cstring>

#include "base/nearest_name.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {
namespace {

// The configuration of one component, before and after.
struct Staged {
  std::uint16_t index;
  Component* component;
  std::vector<std::byte> before;
  std::vector<std::byte> after;
};

Status stage_value(const ConfigurationChange& change, const Staged& staged, std::byte* values) {
  const ParameterBlock& block = staged.component->type_in_force().configuration;
  const std::string name = change.parameter.substr(0, change.parameter.find_first_of(".["));
  NearestName nearest(name);
  for (const ParameterDescriptor& parameter : block.parameters) {
    nearest.offer(parameter.field->name);
    if (name != parameter.field->name) continue;
    const Result<FieldPlace> place = find_field(*block.type, change.parameter);
    if (!place) return place.status();
    ValueRange range{};
    const bool is_member = change.parameter.find('.') != std::string::npos;
    return write_text(*place, values, change.value, is_member ? nullptr : range_of(parameter, range));
  }
  const std::string best(nearest.best());
  return Status::error(StatusCode::not_found, "no configuration parameter '%s'%s%s%s", name.c_str(),
                       best.empty() ? "" : "; did you mean '", best.c_str(), best.empty() ? "" : "'?");
}

class Transaction {
 public:
  explicit Transaction(ReconfigureHost& host) : host_(host) {}

  ReconfigureResult run(std::span<const ConfigurationChange> changes);

 private:
  Staged* staged_of(std::uint16_t index);
  void stage(const ConfigurationChange& change);
  bool stop_all();
  bool initialise_all();
  void roll_back();
  void write(std::vector<std::byte> Staged::*values, std::span<const std::uint16_t> but = {});
  std::string name_of_owner(std::uint16_t owner) { return host_.component(owner)->name(); }
  void blame(std::uint16_t owner, const char* act, const Status& status) {
    culprit_ = owner;
    first_cause_ = name_of_owner(owner) + ": " + act + ": " + status.cause();
    result_.causes.push_back(first_cause_);
  }

  ReconfigureHost& host_;
  ReconfigureResult result_;
  std::vector<Staged> staged_;
  std::size_t stopped_ = 0;      // of result_.owners, from the front
  std::size_t initialised_ = 0;  // of result_.owners, from the back
  std::uint16_t culprit_ = 0;
  std::string first_cause_;
};

Staged* Transaction::staged_of(std::uint16_t index) {
  for (Staged& staged : staged_)
    if (staged.index == index) return &staged;
  Component* component = host_.component(index);
  if (component == nullptr) return nullptr;
  const ParameterBlock& block = component->type_in_force().configuration;
  const auto* memory = static_cast<const std::byte*>(component->parameter_memory().configuration);
  std::vector<std::byte> values;
  if (block.type != nullptr && memory != nullptr) values.assign(memory, memory + block.type->size);
  staged_.push_back({index, component, values, values});
  return &staged_.back();
}

void Transaction::stage(const ConfigurationChange& change) {
  Staged* staged = staged_of(change.component);
  if (staged == nullptr) {
    result_.causes.push_back("there is no component number " + std::to_string(change.component));
    return;
  }
  const Status status = stage_value(change, *staged, staged->after.data());
  if (!status) result_.causes.push_back(std::string(staged->component->name()) + ": " + status.cause());
}

ReconfigureResult Transaction::run(std::span<const ConfigurationChange> changes) {
  for (const ConfigurationChange& change : changes) stage(change);
  if (!result_.causes.empty()) {
    result_.outcome = ReconfigureOutcome::refused;
    return result_;
  }
  std::erase_if(staged_, [](const Staged& staged) { return staged.before == staged.after; });
  if (staged_.empty()) return result_;
  std::vector<std::uint16_t> changed;
  changed.reserve(staged_.size());
  for (const Staged& staged : staged_) changed.push_back(staged.index);
  result_.owners = host_.owners_of(changed);

  if (!stop_all()) {
    roll_back();
    return result_;
  }
  write(&Staged::after);
  if (!initialise_all()) roll_back();
  return result_;
}

bool Transaction::stop_all() {
  for (const std::uint16_t owner : result_.owners) {
    const Status status = host_.stop(owner);
    if (!status) {
      blame(owner, "stop", status);
      return false;
    }
    ++stopped_;
  }
  return true;
}

bool Transaction::initialise_all() {
  while (initialised_ < stopped_) {
    const std::uint16_t owner = result_.owners[stopped_ - 1 - initialised_];
    const Status status = host_.initialise(owner);
    if (!status) {
      blame(owner, "initialise", status);
      return false;
    }
    ++initialised_;
  }
  return true;
}

void Transaction::roll_back() {
  result_.outcome = ReconfigureOutcome::rolled_back;
  const auto fail = [this](std::uint16_t owner, const char* act, const Status& status) {
    const std::string cause = name_of_owner(owner) + ": " + act + ": " + status.cause();
    result_.causes.push_back(cause);
    result_.outcome = ReconfigureOutcome::fault;
    host_.fault(owner,
                Status::error(status.code(), "%s; before that, %s", cause.c_str(), first_cause_.c_str()));
  };
  // An owner that will not stop keeps running on values that it may read at any time: they stay as they were.
  if (stopped_ < result_.owners.size()) {
    result_.outcome = ReconfigureOutcome::fault;
    host_.fault(culprit_, Status::error(StatusCode::timeout, "%s", first_cause_.c_str()));
  }
  std::vector<std::uint16_t> running;
  for (std::size_t i = stopped_ - initialised_; i < stopped_; ++i) {
    const std::uint16_t owner = result_.owners[i];
    const Status status = host_.stop(owner);
    if (!status) {
      fail(owner, "stop to return to the old values", status);
      running.push_back(owner);
    }
  }
  write(&Staged::before, running);
  for (std::size_t i = stopped_; i > 0; --i) {
    const std::uint16_t owner = result_.owners[i - 1];
    if (std::find(running.begin(), running.end(), owner) != running.end()) continue;
    const Status status = host_.initialise(owner);
    if (!status) fail(owner, "initialise with the old values", status);
  }
}

void Transaction::write(std::vector<std::byte> Staged::*values, std::span<const std::uint16_t> but) {
  for (const Staged& staged : staged_) {
    if (std::find(but.begin(), but.end(), staged.index) != but.end()) continue;
    const std::vector<std::byte>& bytes = staged.*values;
    std::memcpy(staged.component->parameter_memory().configuration, bytes.data(), bytes.size());
  }
}

}  // namespace

const char* name_of(ReconfigureOutcome outcome) noexcept {
  switch (outcome) {
    case ReconfigureOutcome::done:
      return "done";
    case ReconfigureOutcome::refused:
      return "refused";
    case ReconfigureOutcome::rolled_back:
      return "rolled back";
    case ReconfigureOutcome::fault:
      return "fault";
  }
  return "unknown";
}

ReconfigureResult reconfigure(ReconfigureHost& host, std::span<const ConfigurationChange> changes) {
  return Transaction(host).run(changes);
}

Status write_configuration(ReconfigureHost& host, const ConfigurationChange& change) {
  Component* component = host.component(change.component);
  if (component == nullptr)
    return Status::error(StatusCode::not_found, "there is no component number %u",
                         static_cast<unsigned>(change.component));
  if (host.is_initialised(change.component))
    return Status::error(
        StatusCode::not_permitted,
        "'%s' of %s is configuration, and %s is initialised: use reconfigure, which stops it and "
        "initialises it again",
        change.parameter.c_str(), component->name(), component->name());
  auto* memory = static_cast<std::byte*>(component->parameter_memory().configuration);
  const Status status = stage_value(change, {change.component, component, {}, {}}, memory);
  return status ? status : Status::error(status.code(), "%s: %s", component->name(), status.cause());
}

}  // namespace flexrf
