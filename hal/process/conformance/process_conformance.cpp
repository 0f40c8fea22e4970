#include "hal/process/conformance/process_conformance.hpp"

#include <algorithm>
#include <vector>

#include "tests/conformance.hpp"

namespace flexrf {
namespace {

/// Cycles after which what must happen has happened; those of a real program take milliseconds.
constexpr int patience = 20000;

MakeProcessWorld make_world = nullptr;

template <class Condition>
bool until(ProcessWorld& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    const bool done = is_true();
    world.send();
    if (done) return true;
  }
  return false;
}

/// Of both sources; those of standard error begin with '!'.
struct Heard {
  std::vector<std::string> lines;
  std::vector<std::string> errors;

  void listen(Process& process) {
    ProcessLine line;
    while (process.read_line(line)) {
      (line.source == ProcessSource::error ? errors : lines).emplace_back(line.content_view());
    }
  }
};

bool reaches(ProcessWorld& world, ProcessPhase phase, Heard& heard) {
  return until(world, [&] {
    heard.listen(world.process());
    return world.process().state().phase == phase;
  });
}

bool hears(ProcessWorld& world, Heard& heard, std::size_t count) {
  return until(world, [&] {
    heard.listen(world.process());
    return heard.lines.size() >= count;
  });
}

// [process-4] [process-8]
Verdict each_line_that_it_is_fed_comes_back(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {})) return Verdict::failed;
  Heard heard;
  std::vector<std::string> said;
  for (int i = 0; i < 20; ++i) {
    said.push_back("line " + std::to_string(i));
    if (!world.process().write_line(said.back())) return Verdict::failed;
    world.send();
  }
  return verdict(hears(world, heard, said.size()) && heard.lines == said && world.feedback().lines == 20);
}

// [process-6] [process-7]
Verdict its_input_ends_after_what_was_written(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {})) return Verdict::failed;
  if (!world.process().write("a\nb") || !world.process().write_line("c")) return Verdict::failed;
  world.process().close_input();
  if (world.process().write_line("late")) return Verdict::failed;
  Heard heard;
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  const ProcessState state = world.process().state();
  return verdict(heard.lines == std::vector<std::string>{"a", "bc"} && state.end == ProcessEnd::exited &&
                 state.exit_code == 0 && world.feedback().refused_writes == 1);
}

// [process-1] [process-8]
Verdict its_last_line_comes_before_its_end(ProcessWorld& world) {
  if (!world.start(ProgramPart::speaks_and_exits, {})) return Verdict::failed;
  Heard heard;
  bool all_before = false;
  const bool ends = until(world, [&] {
    heard.listen(world.process());
    all_before = heard.lines.size() == 3 && heard.errors.size() == 1;
    return world.process().state().phase == ProcessPhase::idle;
  });
  const ProcessState state = world.process().state();
  return verdict(ends && all_before && heard.lines == std::vector<std::string>{"one", "two", "rest"} &&
                 heard.errors == std::vector<std::string>{"three"} && state.end == ProcessEnd::exited &&
                 state.exit_code == 3 && state.id == 0 && state.runs == 1 && state.ended_at > 0 &&
                 state.ended_at <= state.since && !world.feedback().trouble_view().empty());
}

// [process-9]
Verdict lines_go_to_the_queue_where_one_is_connected(ProcessWorld& world) {
  QueueBench<ProcessLine, 4> queue;
  if (!world.start(ProgramPart::speaks_and_exits, {}, queue.sinks())) return Verdict::failed;
  std::vector<std::string> lines;
  const bool all = until(world, [&] {
    while (const auto line = queue.pop()) lines.emplace_back(line->content_view());
    return lines.size() == 4;
  });
  ProcessLine none;
  return verdict(all && std::count(lines.begin(), lines.end(), "three") == 1 &&
                 !world.process().read_line(none));
}

Verdict a_signal_that_ends_it_is_told(ProcessWorld& world) {
  if (!world.start(ProgramPart::dies, {})) return Verdict::failed;
  Heard heard;
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  const ProcessState state = world.process().state();
  return verdict(state.end == ProcessEnd::signalled && state.end_signal == 9 &&
                 !world.feedback().trouble_view().empty());
}

Verdict it_has_its_arguments_and_environment(ProcessWorld& world) {
  if (!world.start(ProgramPart::tells_itself, {})) return Verdict::failed;
  Heard heard;
  return verdict(reaches(world, ProcessPhase::idle, heard) &&
                 heard.lines == std::vector<std::string>{"two words", "good day"});
}

Verdict what_is_missing_is_told_at_the_start(ProcessWorld& world) {
  const Status status = world.start(ProgramPart::is_missing, {.restart = ProcessRestart::always});
  return verdict(status.code() == StatusCode::not_found && status.cause()[0] != '\0');
}

// [process-2] [process-5]
Verdict it_waits_for_its_unit_if_it_is_told_to(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {.start = false})) return Verdict::failed;
  world.receive();
  world.send();
  if (world.process().state().runs != 0 || world.process().write_line("x")) return Verdict::failed;
  Heard heard;
  world.process().request_start();
  if (!reaches(world, ProcessPhase::running, heard) || !world.process().write_line("x"))
    return Verdict::failed;
  world.send();
  if (!hears(world, heard, 1)) return Verdict::failed;
  world.process().request_stop();
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  world.process().request_start();
  return verdict(reaches(world, ProcessPhase::running, heard) && world.process().state().runs == 2 &&
                 world.feedback().trouble_view().empty());
}

// [process-2]
Verdict a_start_that_is_asked_for_while_it_ends_comes_after(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {})) return Verdict::failed;
  Heard heard;
  world.process().request_stop();
  world.send();
  world.process().request_start();
  return verdict(until(world, [&] {
    const ProcessState state = world.process().state();
    return state.phase == ProcessPhase::running && state.runs == 2;
  }));
}

// [process-12]
Verdict made_safe_with_the_cell_it_runs_on(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {})) return Verdict::failed;
  Heard heard;
  if (!reaches(world, ProcessPhase::running, heard)) return Verdict::failed;
  for (int cycles = 0; cycles < 200; ++cycles) {
    world.receive();
    if (!world.process().make_safe()) return Verdict::failed;
    world.send();
  }
  if (!world.process().write_line("x")) return Verdict::failed;
  world.send();
  return verdict(hears(world, heard, 1) && world.process().state().phase == ProcessPhase::running &&
                 world.process().state().runs == 1);
}

// [process-3]
Verdict what_does_not_end_is_killed(ProcessWorld& world) {
  if (!world.start(ProgramPart::disobeys, {.stop_timeout = std::chrono::milliseconds(100)}))
    return Verdict::failed;
  Heard heard;
  if (!hears(world, heard, 1)) return Verdict::failed;
  const int id = world.process().state().id;
  world.process().request_stop();
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  const ProcessState state = world.process().state();
  return verdict(state.end == ProcessEnd::signalled && state.end_signal == 9 && world.feedback().kills == 1 &&
                 !world.is_there(id));
}

// [process-run-1]
Verdict nothing_is_left_after_the_device_stopped(ProcessWorld& world) {
  if (!world.start(ProgramPart::disobeys, {.stop_timeout = std::chrono::milliseconds(50)}))
    return Verdict::failed;
  Heard heard;
  if (!hears(world, heard, 1)) return Verdict::failed;
  const int id = world.process().state().id;
  if (id <= 0 || !world.is_there(id)) return Verdict::failed;
  const Time began = MonotonicClock::now();
  world.process().stop();
  if (!world.is_there(id)) return Verdict::passed;
  // A second after the kill it is left behind: whoever carries that out may get no CPU for so long.
  const bool given_up = MonotonicClock::now() - began >= std::chrono::seconds(1);
  return verdict(given_up && until(world, [&] { return !world.is_there(id); }));
}

Verdict it_is_started_again_after_a_growing_pause(ProcessWorld& world) {
  if (!world.start(ProgramPart::speaks_and_exits, {.restart = ProcessRestart::on_failure}))
    return Verdict::failed;
  Heard heard;
  const bool again = until(world, [&] {
    heard.listen(world.process());
    return heard.lines.size() >= 12;
  });
  return verdict(again && world.process().state().runs >= 4 && world.process().fault().is_ok());
}

// [process-11]
Verdict what_was_asked_to_end_is_left_so(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {.restart = ProcessRestart::always})) return Verdict::failed;
  Heard heard;
  world.process().request_stop();
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  for (int cycles = 0; cycles < 200; ++cycles) {
    world.receive();
    if (world.process().state().phase != ProcessPhase::idle) return Verdict::failed;
    world.send();
  }
  return verdict(world.process().state().runs == 1);
}

Verdict what_ended_well_is_left_so(ProcessWorld& world) {
  if (!world.start(ProgramPart::tells_itself, {.restart = ProcessRestart::on_failure}))
    return Verdict::failed;
  Heard heard;
  if (!reaches(world, ProcessPhase::idle, heard)) return Verdict::failed;
  world.receive();
  world.send();
  return verdict(world.process().state().runs == 1 && world.feedback().trouble_view().empty());
}

// [process-10]
Verdict lines_that_nobody_takes_are_counted(ProcessWorld& world) {
  if (!world.start(ProgramPart::floods, {})) return Verdict::failed;
  // Not taken at all: the program ends all the same.
  if (!until(world, [&] { return world.process().state().phase == ProcessPhase::idle; }))
    return Verdict::failed;
  ProcessLine line;
  std::size_t taken = 0;
  while (world.process().read_line(line)) ++taken;
  return verdict(taken == Process::line_capacity && world.feedback().lines == 1000 &&
                 world.feedback().dropped_lines == 1000 - taken);
}

// [process-5]
Verdict what_it_does_not_read_is_refused(ProcessWorld& world) {
  if (!world.start(ProgramPart::reads_nothing, {})) return Verdict::failed;
  Heard heard;
  if (!hears(world, heard, 1)) return Verdict::failed;
  const std::string text(1000, 'x');
  const bool refused = until(world, [&] { return !world.process().write_line(text); });
  return verdict(refused && world.feedback().refused_writes == 1 &&
                 world.process().state().phase == ProcessPhase::running);
}

Verdict children_that_keep_its_output_open_do_not_keep_it_alive(ProcessWorld& world) {
  if (!world.start(ProgramPart::leaves_children, {})) return Verdict::failed;
  Heard heard;
  return verdict(reaches(world, ProcessPhase::idle, heard) &&
                 heard.lines == std::vector<std::string>{"ready"} &&
                 world.process().state().end == ProcessEnd::exited);
}

Verdict without_its_helper_it_is_in_fault(ProcessWorld& world) {
  if (!world.start(ProgramPart::echoes, {.restart = ProcessRestart::always})) return Verdict::failed;
  const int id = world.process().state().id;
  if (!world.lose_helper()) return Verdict::skipped;
  if (!until(world, [&] { return !world.process().fault().is_ok(); })) return Verdict::failed;
  return verdict(world.process().fault().code() == StatusCode::unavailable &&
                 until(world, [&] { return !world.is_there(id); }));
}

template <Verdict (*Run)(ProcessWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_process_conformance(const char* driver, MakeProcessWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(each_line_that_it_is_fed_comes_back),
      CASE(its_input_ends_after_what_was_written),
      CASE(its_last_line_comes_before_its_end),
      CASE(lines_go_to_the_queue_where_one_is_connected),
      CASE(a_signal_that_ends_it_is_told),
      CASE(it_has_its_arguments_and_environment),
      CASE(what_is_missing_is_told_at_the_start),
      CASE(it_waits_for_its_unit_if_it_is_told_to),
      CASE(a_start_that_is_asked_for_while_it_ends_comes_after),
      CASE(made_safe_with_the_cell_it_runs_on),
      CASE(what_does_not_end_is_killed),
      CASE(nothing_is_left_after_the_device_stopped),
      CASE(it_is_started_again_after_a_growing_pause),
      CASE(what_was_asked_to_end_is_left_so),
      CASE(what_ended_well_is_left_so),
      CASE(lines_that_nobody_takes_are_counted),
      CASE(what_it_does_not_read_is_refused),
      CASE(children_that_keep_its_output_open_do_not_keep_it_alive),
      CASE(without_its_helper_it_is_in_fault),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
