#include "web-ui/server/api/api.hpp"

#include <algorithm>
#include <cstdio>
#include <random>
#include <utility>

namespace flexrf::panel {
namespace {

/// For sending in one turn: together with the rest it stays below what a turn may take.
constexpr Duration sending_time = std::chrono::milliseconds{3};

/// Tells this start of the application from all others.
std::string new_boot() {
  std::random_device random;
  char text[20];
  std::snprintf(text, sizeof(text), "%08x%08x", random(), random());
  return text;
}

}  // namespace

Api::Api(Executive& executive, AccessControl& access, LaterReplies& replies, std::uint32_t places,
         const ApiTimeouts& timeouts, Doorbell* bell, std::string helper)
    : executive_(executive),
      access_(access),
      bell_(bell),
      boot_(new_boot()),
      clients_(places),
      answers_(clients_, replies),
      permission_(access, answers_),
      directory_(executive.cell()),
      slots_(executive.cell()),
      values_(executive.cell(), directory_, slots_),
      images_(executive.cell(), directory_, bell),
      pictures_(images_, answers_, timeouts.picture),
      parameters_(executive.cell(), directory_, slots_, values_, answers_, permission_, boot_,
                  timeouts.answer),
      edits_(executive, bell, directory_, values_, answers_, permission_, timeouts.edit),
      motion_(executive, access, answers_, permission_, parameters_, edits_),
      lifecycle_(executive, bell, directory_, answers_, permission_),
      saving_(executive, answers_, permission_),
      machine_(std::move(helper), bell, executive.cell().audit(), access, reader_, answers_, permission_),
      subscriptions_(clients_, directory_, images_, answers_),
      operations_{directory_, answers_, parameters_, motion_, edits_, lifecycle_, saving_, subscriptions_},
      state_(executive, directory_, access, edits_),
      topics_(executive.cell()),
      frames_(executive.cell(), slots_, images_),
      live_({executive, access, clients_, reader_, operations_, state_, topics_, frames_, boot_,
             machine_.is_there()}),
      rest_({executive, access, reader_, operations_, machine_, permission_, slots_, values_, images_,
             pictures_, state_, topics_, boot_}) {}

Status Api::prepare() {
  if (bell_ != nullptr) executive_.saver().set_bell(*bell_);
  return parameters_.prepare(bell_);
}

Status Api::start() {
  if (const Status status = images_.start(); !status) return status;
  return machine_.start();
}

void Api::stop() noexcept {
  images_.stop();
  machine_.stop();
}

void Api::on_tick(Time now) {
  slots_.begin_turn();
  parameters_.tick(now);
  edits_.tick(now);
  lifecycle_.tick();
  saving_.tick(now);
  machine_.tick();
  pictures_.tick(now);
  state_.update(now);
  live_.send_all(now, MonotonicClock::now() + sending_time);
}

Duration Api::until_next(Time now) const {
  // Other threads ring when they have answered; who waits in vain is told in one of the next turns.
  const Time next = std::min(live_.next(now), state_.next());
  return next > now ? next - now : Duration{};
}

void Api::on_control_changed(SessionIndex from, SessionIndex to) {
  AuditIntake& audit = executive_.cell().audit();
  if (to == no_session) {
    audit.note(who_of(access_.session(from)), "has control no longer");
  } else if (from == no_session) {
    audit.note(who_of(access_.session(to)), "took control");
  } else {
    audit.note(who_of(access_.session(to)), "took control from", who_of(access_.session(from)));
  }
  if (from == no_session) return;
  parameters_.end_holds_of_session(from, MonotonicClock::now());
  edits_.on_control_lost(from);
}

void Api::on_session_ended(SessionIndex session) {
  parameters_.end_holds_of_session(session, MonotonicClock::now());
  edits_.on_control_lost(session);
  live_.close_session(session);
}

}  // namespace flexrf::panel
