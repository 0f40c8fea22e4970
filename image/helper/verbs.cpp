#include "image/helper/verbs.hpp"

#include <unistd.h>

#include <thread>
#include <utility>
#include <vector>

#include "image/boot/environment.hpp"
#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"
#include "image/helper/data_use.hpp"
#include "image/helper/driver_changes.hpp"
#include "image/helper/named_lines.hpp"
#include "image/helper/start_record.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "web-ui/server/access/host_file.hpp"
#include "web-ui/server/access/login_log.hpp"

namespace flexrf::helper {
namespace {

constexpr Duration wait_for_panel = std::chrono::seconds{2};
constexpr Duration between_questions = std::chrono::milliseconds{200};

/// While nobody may meddle with slots and bundles.
Answer check_not_installing(const Progress& progress) {
  if (progress.install.is_under_way())
    return refuse(409, "an update is being installed; wait until that is done");
  if (progress.phase == Phase::unknown)
    return refuse(
        409, "whether an update is being installed cannot be told: " + progress.why + "; restart the PC");
  return {};
}

/// As somebody sent it, in the journal.
std::string shown(const std::string& text) {
  return panel::shown_name(text).data();
}

/// "cell7 203.0.113.7", "none": a list that was accepted.
std::string shown_hosts(const std::string& hosts) {
  std::string line;
  if (const auto list = panel::split_hosts(hosts)) {
    for (const std::string& host : *list) line.append(line.empty() ? "" : " ").append(host);
  }
  return line.empty() ? "none" : line;
}

const char* const was_installed = "an update was installed; restart the PC first";

}  // namespace

Verbs::Verbs(Files files, const Surroundings& surroundings, MotionWord& word, std::function<Time()> clock)
    : files_(std::move(files)),
      surroundings_(surroundings),
      word_(word),
      clock_(std::move(clock)),
      admin_(files_.users),
      upload_(files_.update, surroundings.free_bytes),
      network_(files_, surroundings, clock_) {}

Answer Verbs::perform(const Request& request, const std::string& peer) {
  Answer answer = perform(request);
  say_outcome(request, peer, answer);
  return answer;
}

Answer Verbs::perform(const Request& request) {
  if (request.verb == Verb::part) return take_part(request);
  if (Answer admin = admin_.check(request.user, request.password, clock_()); !admin.is_done()) return admin;
  switch (request.verb) {
    case Verb::upload:
      return begin_upload(request);
    case Verb::install:
      return install(request);
    case Verb::choose:
      return choose(request);
    case Verb::network:
      return set_address(request);
    case Verb::keep_network:
      return keep_address(request.reached_by);
    case Verb::dismiss_failure:
      return dismiss_failure(request.slot);
    case Verb::make_room:
      return make_room(request.what);
    case Verb::hosts:
      return declare_hosts(request.hosts);
    default:
      return restart();
  }
}

Answer Verbs::begin_upload(const Request& request) {
  const Progress progress = read_progress(files_.update);
  if (Answer free = check_not_installing(progress); !free.is_done()) return free;
  if (progress.phase == Phase::installed) return refuse(409, was_installed);
  if (progress.phase == Phase::verifying)
    return refuse(409, "the bundle before this one is being verified; wait until that is done");
  Answer answer = upload_.begin(request.size, clock_());
  if (!answer.is_done()) return answer;
  said_part_.clear();
  // What they tell is of the bundle that is gone.
  for (const Job job : {Job::verify, Job::install}) {
    if (const Status removed = remove_result(files_.update, job); !removed) return answer_of(removed);
  }
  return answer;
}

Answer Verbs::take_part(const Request& request) {
  Answer answer = upload_.part(request.upload, request.offset, request.bytes, clock_());
  if (!answer.is_done() || !upload_.is_whole()) return answer;
  // Before the bundle has its name: never may it look like one that was verified.
  if (const Status written = write_starting(files_.update, Job::verify); !written) {
    upload_.finish();
    unlink(bundle_of(files_.update).c_str());
    return answer_of(written);
  }
  if (const std::string why = upload_.finish(); !why.empty()) {
    [[maybe_unused]] const Status removed = remove_result(files_.update, Job::verify);
    return refuse(503, why);
  }
  // The bytes are here, whatever becomes of verifying: `state` tells it.
  start(Job::verify);
  return answer;
}

Answer Verbs::install(const Request& request) {
  Deviation deviation;
  if (Answer fit = check_installable(request, deviation); !fit.is_done()) return fit;
  if (Answer held = hold_motion(installing); !held.is_done()) return held;
  Answer answer = answer_of(permit(deviation));
  if (answer.is_done()) answer = answer_of(write_starting(files_.update, Job::install));
  if (answer.is_done()) answer = start(Job::install);
  // Else the word is held until the unit has said something: what it begins with is to write its file anew.
  holds_for_unit_ = answer.is_done();
  if (!holds_for_unit_) word_.release();
  return answer;
}

Answer Verbs::check_installable(const Request& request, Deviation& deviation) const {
  const Progress progress = read_progress(files_.update);
  if (Answer free = check_not_installing(progress); !free.is_done()) return free;
  if (progress.phase == Phase::installed) return refuse(409, was_installed);
  if (upload_.received().is_under_way)
    return refuse(409, "the bundle is not here yet; upload the rest of it");
  if (progress.phase == Phase::verifying)
    return refuse(409, "the bundle is being verified; wait until that is done");
  if (!progress.is_verified) return refuse(409, "there is no verified bundle; upload one");
  const Facts facts = read_facts(files_, wait_for_choice);
  if (!facts.choice)
    return refuse(409, "which version of this PC counts cannot be told: " + facts.choice_failure);
  if (!facts.running.slot) return refuse(409, "which slot runs cannot be told; restart the PC");
  // Where the other slot has no version there is nothing to lose, and an update may be what makes this PC
  // well.
  if (!is_confirmed(facts) && facts.choice->of(boot::other(*facts.running.slot)).is_whole)
    return refuse(
        409,
        "this version has not confirmed itself, and the other one may still be needed; wait until it "
        "has, or restart the PC into the other one");
  const Result<NamedLines> running = NamedLines::read(files_.version);
  if (!running)
    return refuse(503, std::string{"which version runs cannot be told: "} + running.status().cause());
  deviation.is_older = progress.bundle.built < running->number("built");
  if (deviation.is_older && !request.older)
    return refuse(409, "the bundle is older than what runs; install it with 'older' if that is meant");
  deviation.has_other_drivers = progress.bundle.drivers != running->whole("drivers");
  if (Answer meant = check_drivers(request, progress.bundle.drivers); !meant.is_done()) return meant;
  return check_standstill();
}

/// A version with simulated drivers finds itself healthy on a PC whose real ones nobody asks then.
Answer Verbs::check_drivers(const Request& request, const std::string& other) const {
  const Result<NamedLines> running = NamedLines::read(files_.version);
  if (!running)
    return refuse(503, std::string{"which drivers run cannot be told: "} + running.status().cause());
  const std::vector<DriverChange> changes = driver_changes(running->whole("drivers"), other);
  if (changes.empty() || request.other_drivers) return {};
  return refuse(409, (other.empty() ? "that version does not say which drivers its devices have"
                                    : "that version has other drivers (" + text_of(changes) + ")") +
                         "; ask again with 'other_drivers' if that is meant");
}

Answer Verbs::choose(const Request& request) {
  if (Answer free = check_not_installing(read_progress(files_.update)); !free.is_done()) return free;
  if (Answer stands = check_standstill(); !stands.is_done()) return stands;
  const std::string letter(1, boot::letter_of(request.slot));
  boot::FolderMedium medium;
  if (const Status opened = medium.open(files_.choice, wait_for_choice); !opened) return answer_of(opened);
  {
    const boot::Environment environment(medium);
    if (!environment.has_choice())
      return refuse(503, "the boot choice cannot be read: " + environment.damages() + "; restart the PC");
    const boot::Choice& choice = environment.choice();
    if (!choice.of(request.slot).is_whole)
      return refuse(409, "slot " + letter + " has no whole version; install one there");
    if (choice.primary == request.slot) return refuse(409, "slot " + letter + " is chosen already");
  }
  if (read_running(files_).slot != request.slot) {
    const std::string drivers = version_lines(files_.update, request.slot).whole("drivers");
    if (Answer meant = check_drivers(request, drivers); !meant.is_done()) return meant;
  }
  const boot::Outcome outcome = boot::perform({"set-primary", letter}, medium, read_running(files_));
  if (outcome.exit == boot::Exit::done) return {};
  return refuse(outcome.exit == boot::Exit::refused ? 409 : 503,
                outcome.said.empty() ? "the choice could not be written" : outcome.said.back());
}

Answer Verbs::restart() {
  // Where it cannot be told whether one is installed, a restart is the way out.
  const Progress progress = read_progress(files_.update);
  if (Answer free = check_not_installing(progress); !free.is_done() && progress.phase != Phase::unknown)
    return free;
  if (Answer stands = check_standstill(); !stands.is_done()) return stands;
  if (Answer held = hold_motion("the PC restarts"); !held.is_done()) return held;
  const std::string failure = surroundings_.systemctl({"reboot"});
  if (failure.empty()) return {};  // nothing moves any more until it has
  word_.release();
  return refuse(503, "the PC cannot be restarted: " + failure);
}

Answer Verbs::set_address(const Request& request) {
  const auto parsed = parse_setting(request.address, request.gateway);
  if (const auto* const wrong = std::get_if<std::string>(&parsed)) return refuse(400, *wrong);
  const auto& setting = std::get<AddressSetting>(parsed);
  if (Answer fit = network_.check(request.interface, setting); !fit.is_done()) return fit;
  // What moves may be moved by this network.
  if (Answer stands = check_standstill(); !stands.is_done()) return stands;
  if (Answer held = hold_motion("an address is about to change"); !held.is_done()) return held;
  Answer answer = network_.begin(request.interface, setting);
  word_.release();
  return answer;
}

Answer Verbs::keep_address(const std::string& reached_by) {
  Answer answer = network_.keep(reached_by);
  word_.renew();
  return answer;
}

Answer Verbs::dismiss_failure(boot::Slot slot) {
  std::optional<Failure> failure = read_failure(files_.update, slot);
  if (!failure || failure->is_dismissed)
    return refuse(409, std::string{"no failure of slot "} + boot::letter_of(slot) + " is shown");
  // The file stays: another boot of the same fallback would show the failure again.
  failure->is_dismissed = true;
  return answer_of(write_failure(files_.update, *failure));
}

Answer Verbs::make_room(const std::string& what) {
  if (what != "logs") return refuse(400, "'what' is " + in_quotes(what) + "; old logs can be removed: logs");
  const Result<std::uint64_t> freed = remove_old_logs(files_.data + "/journal");
  if (!freed)
    return refuse(freed.status().code() == StatusCode::not_found ? 409 : 503, freed.status().cause());
  Answer answer;
  answer.freed = *freed;
  return answer;
}

/// Also while the cell moves: no connection ends, and nothing but the panel reads the list.
Answer Verbs::declare_hosts(const std::string& hosts) const {
  const Result<std::vector<std::string>> list = panel::split_hosts(hosts);
  if (!list) return refuse(400, std::string{"'hosts': "} + list.status().cause());
  return answer_of(panel::write_hosts(file_of_hosts(files_.network), *list));
}

Answer Verbs::check_standstill() const {
  const PanelAnswer panel = surroundings_.ask_panel(wait_for_panel);
  if (!panel.has_answered)
    return refuse(503, "whether the cell may move cannot be told: " + panel.why_not_healthy);
  if (panel.may_move) return refuse(409, "the cell may move; stop motion first");
  return {};
}

Answer Verbs::hold_motion(const std::string& why) {
  if (const Status held = word_.hold(why); !held)
    return refuse(503, std::string{"motion cannot be forbidden: "} + held.cause());
  const Time end = clock_() + wait_for_standstill;
  while (true) {
    Answer stands = check_standstill();
    if (stands.is_done()) return stands;
    if (clock_() >= end) {
      word_.release();
      return stands;
    }
    std::this_thread::sleep_for(between_questions);
  }
}

Status Verbs::permit(const Deviation& deviation) const {
  const std::pair<std::string, bool> permissions[] = {
      {permission_for_older(files_.update), deviation.is_older},
      {permission_for_drivers(files_.update), deviation.has_other_drivers}};
  for (const auto& [file, is_permitted] : permissions) {
    if (const Status done = is_permitted ? replace_file(file, "") : remove_file(file); !done) return done;
  }
  return {};
}

Answer Verbs::start(Job job) {
  asked_for_[static_cast<std::size_t>(job)] = clock_();
  const std::string failure = surroundings_.systemctl({"start", "--no-block", unit_of(job)});
  if (failure.empty()) return {};
  const std::string why = unit_of(job) + " cannot be started: " + failure + "; restart the PC and try again";
  surroundings_.say(why);
  if (const Status written = write_failed(files_.update, job, why); !written)
    surroundings_.say(written.cause());
  return refuse(503, why);
}

void Verbs::tick() {
  if (upload_.remove_abandoned(clock_()))
    surroundings_.say("the upload is given up: nothing came for 10 min");
  look_after(Job::verify);
  look_after(Job::install);
  release_when_unit_speaks();
  network_.tick();
  remove_what_is_of_no_use();
}

void Verbs::release_when_unit_speaks() {
  if (!holds_for_unit_) return;
  const JobState state = read_result(files_.update, Job::install).state;
  const bool has_spoken = state != JobState::starting && state != JobState::none;
  const Time asked = asked_for_[static_cast<std::size_t>(Job::install)].value_or(Time{});
  if (!has_spoken && clock_() - asked < wait_for_unit) return;
  holds_for_unit_ = false;
  word_.release();
}

void Verbs::remove_what_is_of_no_use() {
  const Progress progress = read_progress(files_.update);
  if (!progress.install.is_under_way()) {
    unlink(permission_for_older(files_.update).c_str());
    unlink(permission_for_drivers(files_.update).c_str());
  }
  // After a restart of the PC nothing is known of a bundle, and one that is installed or no good is not
  // needed.
  const bool is_needed = (progress.bundle.is_under_way() || progress.bundle.state == JobState::done) &&
                         progress.phase != Phase::installed;
  if (is_needed) {
    of_no_use_since_.reset();
  } else if (!of_no_use_since_) {
    of_no_use_since_ = clock_();
  } else if (clock_() - *of_no_use_since_ >= keeping) {
    unlink(bundle_of(files_.update).c_str());
  }
}

void Verbs::look_after(Job job) {
  const JobState state = read_result(files_.update, job).state;
  std::optional<Time>& asked = asked_for_[static_cast<std::size_t>(job)];
  // When the unit has begun, the wait for it is over: a later request has a wait of its own.
  if (state != JobState::starting && state != JobState::none) asked.reset();
  if (state != JobState::starting) return;
  if (!asked) {
    surroundings_.say(unit_of(job) + " is started by this helper, as the one before it wanted to");
    start(job);
  } else if (clock_() - *asked >= wait_for_unit) {
    // It may still be waiting to be started, and shall not when nobody expects it.
    surroundings_.systemctl({"stop", "--no-block", unit_of(job)});
    const std::string why = unit_of(job) + " did not begin within 60 s; restart the PC and try again";
    surroundings_.say(why);
    if (const Status written = write_failed(files_.update, job, why); !written)
      surroundings_.say(written.cause());
  }
}

void Verbs::say_outcome(const Request& request, const std::string& peer, const Answer& answer) {
  const std::string verb = name_of(request.verb);
  if (request.verb == Verb::part) {
    // There are thousands of them: only the first refusal of a kind is of use in the journal.
    if (answer.is_done()) {
      if (!upload_.received().is_under_way) surroundings_.say("all of the bundle from " + peer + " is here");
    } else if (answer.why != said_part_) {
      said_part_ = answer.why;
      surroundings_.say("a part from " + peer + " is refused: " + answer.why);
    }
    return;
  }
  std::string line = verb + " by " + panel::shown_name(request.user).data() + " from " + peer;
  if (request.verb == Verb::upload) line += ", " + std::to_string(request.size) + " bytes";
  if (request.verb == Verb::choose || request.verb == Verb::dismiss_failure)
    line += std::string{", slot "} + boot::letter_of(request.slot);
  if (request.verb == Verb::make_room) line += ", " + shown(request.what);
  if (request.verb == Verb::network) line += ", " + shown(request.interface) + ": " + shown(request.address);
  if (request.verb == Verb::hosts)
    line += ", " + (answer.is_done() ? shown_hosts(request.hosts) : shown(request.hosts));
  surroundings_.say(line + (answer.is_done() ? ": accepted" : ": refused: " + answer.why));
}

}  // namespace flexrf::helper
