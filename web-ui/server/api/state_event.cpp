#include "web-ui/server/api/state_event.hpp"

#include "runtime/core/digest.hpp"
#include "runtime/core/text_table.hpp"

namespace flexrf::panel {
namespace {

constexpr std::string_view event_head = R"({"event":"state",)";

std::int64_t milliseconds(Duration duration) noexcept {
  return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count();
}

double microseconds(Duration duration) noexcept {
  return static_cast<double>(duration.count()) * 1e-3;
}

}  // namespace

std::uint64_t StateEvent::signature() const noexcept {
  const Control& control = executive_->control();
  const Application& application = executive_->cell().application();
  Digest digest;
  digest.add(static_cast<std::uint64_t>(control.mode()));
  digest.add((control.motion_stopped() ? 2U : 0U) + (control.may_move() ? 1U : 0U));
  digest.add(control.faults());
  std::uint64_t in_fault = 0;
  for (ComponentIndex i = 0; i < application.component_count(); ++i)
    in_fault += application.component_state(i).is_in_fault() ? 1U : 0U;
  digest.add(in_fault);
  for (const ThreadState& thread : application.thread_states)
    digest.add(static_cast<std::uint64_t>(thread.longest_standstill.load(std::memory_order_relaxed)));
  digest.add(static_cast<std::uint64_t>(control.longest_standstill().count()));
  digest.add(access_->revision());
  digest.add(edits_->revision());
  digest.add(executive_->saver().revision());
  digest.add(executive_->audit().revision());
  return digest.value();
}

std::size_t StateEvent::fault_places(const Application& application) noexcept {
  return application.component_count() + application.threads.size() + 1;
}

/// A standstill that was longer than those before is a new one.
void StateEvent::note_faults(Time now) noexcept {
  const Application& application = executive_->cell().application();
  std::size_t place = 0;
  const auto note = [this, now, &place](std::int64_t extent) {
    Fault& fault = faults_[place++];
    if (extent != fault.extent) fault = {extent, now};
  };
  for (ComponentIndex i = 0; i < application.component_count(); ++i)
    note(application.component_state(i).is_in_fault() ? 1 : 0);
  for (std::size_t i = 0; i < application.threads.size(); ++i)
    note(application.thread_states[i].longest_standstill.load(std::memory_order_relaxed));
  note(executive_->control().longest_standstill().count());
}

void StateEvent::update(Time now) {
  const std::uint64_t signed_now = signature();
  if (signed_now == seen_ && now < next_) return;
  seen_ = signed_now;
  // Values are due at whole multiples of their intervals; what has no such haste goes in between, and delays
  // none.
  next_ = Time{now.time_since_epoch() / interval * interval} + interval + beside_values;
  ++version_;
  note_faults(now);
  holder_ = access_->holder();
  wanted_by_ = access_->wanted_by();
  editor_ = edits_->owner();
  write(texts_[0], holder_, now);
  write(texts_[1], wanted_by_, now);
  write(texts_[2], no_session, now);
}

std::string_view StateEvent::event_for(SessionIndex session) const noexcept {
  if (session != no_session && session == holder_) return texts_[0];
  if (session != no_session && session == wanted_by_) return texts_[1];
  return texts_[2];
}

std::string_view StateEvent::members_for(SessionIndex session) const noexcept {
  return event_for(session).substr(event_head.size());
}

void StateEvent::write_session(JsonWriter& json, SessionIndex session, SessionIndex you) const {
  const SessionInfo* const info = session == no_session ? nullptr : access_->session(session);
  if (info == nullptr) {
    json.null();
    return;
  }
  json.begin_object().member("name", info->name).member("user", info->user).member("address", info->address);
  json.member("local", info->local).member("you", session == you).end_object();
}

void StateEvent::write_faults(JsonWriter& json) const {
  const Application& application = executive_->cell().application();
  json.key("faults").begin_array();
  std::size_t place = 0;
  // As note_faults() saw them: each has the time since when it is there.
  const auto write = [this, &json, &place](const char* kind, const char* name, const auto& cause) {
    const Fault& fault = faults_[place++];
    if (fault.extent == 0) return;
    json.begin_object().member("component", name).member("kind", kind).member("cause", cause(fault.extent));
    json.member("since_ns", fault.since.time_since_epoch().count()).end_object();
  };
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    const ComponentState& state = application.component_state(i);
    write(application.component(i).kind, application.component(i).name,
          [&state](std::int64_t) { return std::string{state.fault.read().cause()}; });
  }
  const auto standstill = [](std::int64_t longest) {
    return "stood still for " + duration_text(Duration{longest});
  };
  for (const ThreadRecord& thread : application.threads) write("thread", thread.name, standstill);
  write("process", application.name, standstill);
  json.end_array();
}

void StateEvent::write_values(JsonWriter& json) const {
  const SaveState state = executive_->saver().state();
  json.key("values").begin_object().member("file", state.has_file);
  json.member("on", state.on_change ? "change" : "command").member("unsaved", state.unsaved);
  json.key("saved_at_ms");
  if (state.saved_at == 0) {
    json.null();
  } else {
    json.value(state.saved_at);
  }
  json.member("failure", state.failure.cause()).end_object();
}

void StateEvent::write(std::string& text, SessionIndex you, Time now) const {
  const Control& control = executive_->control();
  text.assign(event_head);
  // What follows are the members of the object that the head has opened.
  const std::size_t head = text.size();
  JsonWriter json(std::move(text));
  json.begin_object();
  json.member("mode", name_of(control.mode())).member("cause", name_of(control.cause()));
  json.key("motion").begin_object().member("stopped", control.motion_stopped());
  json.member("may_move", control.may_move()).key("stopped_by");
  if (const auto stop = executive_->audit().stopped_by(); stop && control.motion_stopped()) {
    json.begin_object()
        .member("who", static_cast<const char*>(stop->who))
        .member("at_ms", stop->at)
        .end_object();
  } else {
    json.null();
  }
  json.end_object();
  write_faults(json);
  write_values(json);
  json.key("control").begin_object().key("holder");
  write_session(json, holder_, you);
  json.key("wanted_by");
  write_session(json, wanted_by_, you);
  json.member("answer_within_ms", wanted_by_ == no_session ? 0 : milliseconds(access_->answer_within(now)));
  json.end_object().key("edit");
  if (edits_->is_open()) {
    json.begin_object().key("holder");
    write_session(json, editor_, you);
    json.key("components").begin_array();
    for (const ComponentIndex component : edits_->components()) json.value(directory_->entry(component).name);
    json.end_array().member("left_ms", milliseconds(edits_->left(now))).end_object();
  } else {
    json.null();
  }
  json.key("server").begin_object().member("connections", figures_.connections);
  json.member("places", figures_.places).key("loop_delay_us").begin_object();
  json.member("p99", microseconds(figures_.loop_delay_p99));
  json.member("max", microseconds(figures_.loop_delay_max)).end_object().end_object().end_object();
  text = json.release();
  text.erase(head, 1);  // the second opening bracket
}

}  // namespace flexrf::panel
