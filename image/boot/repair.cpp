#include "image/boot/repair.hpp"

#include <string>
#include <utility>

namespace flexrf::boot {
namespace {

// Collects what is said, and remembers the worst.
class Report {
 public:
  void note(std::string line) { outcome_.said.push_back(std::move(line)); }
  /// After an attempt to make something whole: how that went.
  void conclude(std::string found, const Status& mended, const std::string& remedy) {
    if (mended) {
      note(found.append("; ").append(remedy));
      if (outcome_.exit == Exit::done) outcome_.exit = Exit::repaired;
    } else {
      fail(found.append(", and could not be mended: ").append(mended.cause()));
    }
  }
  void fail(std::string line) {
    note(std::move(line));
    outcome_.exit = Exit::failed;
  }
  Outcome take() { return std::move(outcome_); }

 private:
  Outcome outcome_;
};

std::string slot_text(Slot slot) {
  std::string text = "slot ";
  return text += letter_of(slot);
}

void mend_attempts(Environment& environment, Report& report) {
  if (environment.damage_of_attempts()) return;
  std::string found = attempts_name;
  found.append(" is damaged: ").append(environment.damage_of_attempts().cause());
  report.conclude(found, environment.write(Attempts{}),
                  "written anew, so attempts are counted from the first again");
}

// The attempts first: a trial of the new choice may have the number of one that they have counted.
void begin_anew(Environment& environment, const Running& running, Report& report) {
  std::string found = environment.damages().insert(0, "no copy of the boot choice can be read: ");
  if (!running.slot) {
    report.fail(
        found.append(", and the kernel's command line has no rauc.slot=A or =B that tells which slot runs"));
    return;
  }
  const Status reset = environment.write(Attempts{});
  std::string remedy = slot_text(*running.slot);
  remedy.append(" runs and is kept, to be confirmed again; ").append(slot_text(other(*running.slot)));
  remedy.append(" is out of use until a version is installed there");
  report.conclude(found, environment.write(choice_of_running(*running.slot)), remedy);
  if (!reset) report.fail(std::string("attempts cannot be forgotten: ").append(reset.cause()));
}

void mend_copies(Environment& environment, Report& report) {
  if (environment.has_two_equal_copies()) return;
  const std::string damages = environment.damages();
  const Status written = environment.write_other_copy();
  if (damages.empty())
    report.conclude("the last change of the boot choice was cut short", written, "completed");
  else
    report.conclude(damages, written, "written anew from the other copy");
}

void look_at_marks(Environment& environment, const Running& running, Report& report) {
  const Choice& choice = environment.choice();
  if (!running.slot || choice.of(*running.slot).is_whole) return;
  std::string runs = slot_text(*running.slot);
  if (choice.of(other(*running.slot)).is_whole) {
    runs.append(" runs but is not marked as whole; next time ").append(slot_text(other(*running.slot)));
    report.note(runs.append(" boots"));
    return;
  }
  report.conclude("no slot is marked as whole",
                  environment.write(with_whole_mark(with_primary(choice, *running.slot), *running.slot)),
                  runs.append(" runs, and has the mark now"));
}

}  // namespace

Outcome repair(Environment& environment, const Running& running) {
  Report report;
  if (!environment.has_choice()) {
    begin_anew(environment, running, report);
    return report.take();
  }
  mend_copies(environment, report);
  look_at_marks(environment, running, report);
  mend_attempts(environment, report);
  return report.take();
}

}  // namespace flexrf::boot
