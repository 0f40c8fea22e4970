#include <optional>

#include "hal/process/conformance/process_conformance.hpp"
#include "hal/process/mock/mock_process.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public ProcessWorld {
 public:
  Status start(ProgramPart part, const ProcessWishes& wishes, std::span<QueueSink* const> sinks) override {
    part_ = part;
    bench_.emplace(nullptr, sinks);
    auto& configuration = bench_->configuration();
    configuration.set_executable("/mock/program");
    configuration.set_arguments("'two words'");
    configuration.set_environment("GREETING='good day'");
    configuration.start = wishes.start;
    configuration.restart = wishes.restart;
    configuration.restart_shortest = 0.002;
    configuration.restart_longest = seconds(wishes.restart_longest);
    configuration.stop_timeout = seconds(wishes.stop_timeout);
    if (part == ProgramPart::is_missing)
      far_end().refuse(Status::error(StatusCode::not_found, "scripted: there is no such program"));
    far_end().set_obeys(part != ProgramPart::disobeys);
    far_end().set_reads(part != ProgramPart::reads_nothing);
    far_end().set_leaves_output_open(part == ProgramPart::leaves_children);
    return bench_->driver().initialise();
  }
  Process& process() override { return bench_->driver(); }
  const ProcessFeedback& feedback() override { return bench_->feedback(); }
  void receive() override {
    play();
    bench_->receive(std::chrono::milliseconds(1));
  }
  void send() override { bench_->send(); }
  bool is_there(int id) override { return far_end().runs() && id == process().state().id; }
  bool lose_helper() override {
    far_end().lose(Status::error(StatusCode::unavailable, "scripted: what starts programs is gone"));
    return true;
  }

 private:
  MockProcessHost& far_end() { return bench_->driver().far_end(); }
  void print(std::string_view bytes) { far_end().print(ProcessSource::output, bytes); }

  /// What the program does between two cycles.
  void play() {
    if (!far_end().runs()) {
      begun_ = false;
      return;
    }
    const bool first = !begun_;
    begun_ = true;
    switch (part_) {
      case ProgramPart::echoes:
        if (first) echoed_ = 0;
        print(far_end().fed().substr(echoed_));
        echoed_ = far_end().fed().size();
        if (far_end().input_ended()) finish(0);
        break;
      case ProgramPart::speaks_and_exits:
        print("one\n");
        far_end().print(ProcessSource::error, "three\n");
        print("two\nrest");
        finish(3);
        break;
      case ProgramPart::dies:
        far_end().die(9);
        begun_ = false;
        break;
      case ProgramPart::tells_itself:
        print(far_end().program().arguments[0] + "\n");
        print(far_end().program().environment[0].substr(std::string_view("GREETING=").size()) + "\n");
        finish(0);
        break;
      case ProgramPart::floods:
        for (int i = 0; i < 1000; ++i) print("line\n");
        finish(0);
        break;
      case ProgramPart::disobeys:
      case ProgramPart::reads_nothing:
        if (first) print("ready\n");
        break;
      case ProgramPart::leaves_children:
        print("ready\n");
        finish(0);
        break;
      case ProgramPart::is_missing:
        break;
    }
  }
  void finish(int code) {
    far_end().exit(code);
    begun_ = false;
  }

  ProgramPart part_ = ProgramPart::echoes;
  bool begun_ = false;
  std::size_t echoed_ = 0;
  std::optional<DeviceBench<MockProcess>> bench_;
};

}  // namespace

int main() {
  return run_process_conformance(
      "mock process", []() -> std::unique_ptr<ProcessWorld> { return std::make_unique<MockWorld>(); });
}
