#include "web-ui/server/api/state_event.hpp"

#include "runtime/core/digest.hpp"

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
  Digest digest;
  digest.add(static_cast<std::uint64_t>(control.mode()));
  digest.add((control.motion_stopped() ? 2U : 0U) + (control.may_move() ? 1U : 0U));
  digest.add_text(control.check_start().cause());
  digest.add(control.faults());
  for (std::size_t place = 0; place < places_.count(); ++place)
    digest.add(static_cast<std::uint64_t>(places_.extent(place)));
  digest.add(access_->revision());
  digest.add(edits_->revision());
  digest.add(executive_->saver().revision());
  digest.add(executive_->audit().revision());
  return digest.value();
}

/// A standstill that was longer than those before is a new one.
void StateEvent::note_faults(Time now) noexcept {
  for (std::size_t place = 0; place < places_.count(); ++place) {
    if (const std::int64_t extent = places_.extent(place); extent != faults_[place].extent)
      faults_[place] = {extent, now};
  }
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

/// As note_faults() saw them: each has the time since when it is there.
void StateEvent::write_faults(JsonWriter& json) const {
  json.key("faults").begin_array();
  for (std::size_t place = 0; place < places_.count(); ++place) {
    if (faults_[place].extent == 0) continue;
    const FaultPlaces::Fault fault = places_.at(place);
    json.begin_object().member("component", fault.name).member("kind", fault.kind);
    json.member("cause", fault.cause).member("since_ns", nanoseconds(faults_[place].since)).end_object();
  }
  json.end_array();
}

void StateEvent::write_values(JsonWriter& json) const {
  const SaveState state = executive_->saver().state();
  json.key("values").begin_object().member("file", state.has_file);
  json.member("on", state.on_change ? "change" : "command").member("unsaved", state.unsaved);
  json.key("saved_at_ms");
  state.saved_at == 0 ? json.null() : json.value(state.saved_at);
  json.member("writings", state.writings).member("failure", state.failure.cause()).end_object();
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
  json.member("may_move", control.may_move());
  json.member("start_refused", control.check_start().cause()).key("stopped_by");
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
