#include "web-ui/server/api/api.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include "web-ui/server/api/live_session.hpp"
#include "web-ui/server/api/rest_handler.hpp"

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

struct Api::Parts final : public ControlWatcher, public SessionWatcher {
  Parts(Executive& executive_to_serve, AccessControl& access_control, LaterReplies& replies,
        std::uint32_t places, const ApiTimeouts& limits, Doorbell* server_bell)
      : executive(executive_to_serve),
        bell(server_bell),
        access(access_control),
        timeouts(limits),
        clients(places),
        answers(clients, replies) {}

  /// What needs the cell's objects, which Executive::prepare() constructs.
  void make();

  void on_tick(Time now);
  Duration until_next(Time now) const;
  void on_control_changed(SessionIndex from, SessionIndex to) override;
  void on_session_ended(SessionIndex session) override;

  /// All that is made of the application, in the order in which one builds on the other.
  struct Made {
    Made(Parts& parts, Executive& executive, AccessControl& access);

    Directory directory;
    ObservedSlots slots;
    ComponentValues values;
    ImageWorker images;
    ImageRequests pictures;
    ParameterOperations parameters;
    EditOperations edits;
    MotionOperations motion;
    LifecycleOperations lifecycle;
    SaveOperations saving;
    Operations operations;
    StateEvent state;
    TopicBodies topics;
    FrameWriter frames;
    Subscriptions subscriptions;
    LiveSession live;
    RestHandler rest;
  };

  Executive& executive;
  Doorbell* bell;  // null: whoever ticks looks by himself
  AccessControl& access;
  ApiTimeouts timeouts;
  Clients clients;
  Answers answers;
  Permission permission{access, answers};
  JsonReader reader;
  std::string boot = new_boot();
  std::optional<Made> made;
};

Api::Parts::Made::Made(Parts& parts, Executive& executive, AccessControl& access)
    : directory(executive.cell()),
      slots(executive.cell()),
      values(executive.cell(), directory, slots),
      images(executive.cell(), parts.bell),
      pictures(images, parts.answers, parts.timeouts.picture),
      parameters(executive.cell(), directory, slots, values, parts.answers, parts.permission, parts.boot,
                 parts.timeouts.answer),
      edits(executive, parts.bell, directory, values, parts.answers, parts.permission, parts.timeouts.edit),
      motion(executive, access, parts.answers, parts.permission, parameters, edits),
      lifecycle(executive, parts.bell, directory, parts.answers, parts.permission),
      saving(executive, parts.answers, parts.permission),
      operations{directory, parts.answers, parameters, motion, edits, lifecycle, saving},
      state(executive, directory, access, edits),
      topics(executive.cell()),
      frames(executive.cell(), slots, images),
      subscriptions(parts.clients, directory, executive.cell().application(), images, parts.answers),
      live({executive, access, parts.clients, parts.reader, operations, subscriptions, state, topics, frames,
            parts.boot}),
      rest({executive, access, parts.reader, operations, parts.permission, slots, values, images, pictures,
            state, topics, parts.boot}) {}

void Api::Parts::make() {
  made.emplace(*this, executive, access);
}

void Api::Parts::on_tick(Time now) {
  made->slots.begin_turn();
  made->parameters.tick(now);
  made->edits.tick(now);
  made->lifecycle.tick();
  made->saving.tick(now);
  made->pictures.tick(now);
  made->state.update(now);
  made->live.send_all(now, MonotonicClock::now() + sending_time);
}

Duration Api::Parts::until_next(Time now) const {
  // Other threads ring when they have answered; who waits in vain is told in one of the next turns.
  const Time next = std::min(made->live.next(now), made->state.next());
  return next > now ? next - now : Duration{};
}

void Api::Parts::on_control_changed(SessionIndex from, SessionIndex to) {
  AuditIntake& audit = executive.cell().audit();
  if (to == no_session) {
    audit.note(who_of(access.session(from)), "has control no longer");
  } else if (from == no_session) {
    audit.note(who_of(access.session(to)), "took control");
  } else {
    audit.note(who_of(access.session(to)), "took control from", who_of(access.session(from)));
  }
  if (from == no_session) return;
  made->parameters.end_holds_of_session(from, MonotonicClock::now());
  made->edits.on_control_lost(from);
}

void Api::Parts::on_session_ended(SessionIndex session) {
  made->parameters.end_holds_of_session(session, MonotonicClock::now());
  made->edits.on_control_lost(session);
  made->live.close_session(session);
}

Api::Api(Executive& executive, AccessControl& access, LaterReplies& replies, std::uint32_t places,
         const ApiTimeouts& timeouts, Doorbell* bell)
    : parts_(std::make_unique<Parts>(executive, access, replies, places, timeouts, bell)) {}

Api::~Api() = default;

Status Api::prepare() {
  parts_->make();
  if (parts_->bell != nullptr) parts_->executive.saver().set_bell(*parts_->bell);
  return parts_->made->parameters.prepare(parts_->bell);
}

Status Api::start() {
  return parts_->made->images.start();
}

void Api::stop() noexcept {
  if (parts_->made) parts_->made->images.stop();
}

Handled Api::handle(const Request& request, Reply& reply, Ticket ticket) {
  return parts_->made->rest.handle(request, reply, ticket);
}

void Api::on_open(LiveLink& link) {
  parts_->made->live.on_open(link);
}

void Api::on_text(LiveLink& link, std::string_view text) {
  parts_->made->live.on_text(link, text);
}

void Api::on_writable(LiveLink& link) {
  parts_->made->live.on_writable(link);
}

void Api::on_close(LiveLink& link) {
  parts_->made->live.on_close(link);
}

void Api::on_tick(Time now) {
  parts_->on_tick(now);
}

Duration Api::until_next(Time now) const {
  return parts_->until_next(now);
}

ControlWatcher& Api::control_watcher() noexcept {
  return *parts_;
}

SessionWatcher& Api::session_watcher() noexcept {
  return *parts_;
}

void Api::set_figures(const ServerFigures& figures) noexcept {
  parts_->made->state.set_figures(figures);
}

}  // namespace flexrf::panel
