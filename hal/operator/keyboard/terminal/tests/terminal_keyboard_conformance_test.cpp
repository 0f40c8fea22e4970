// The driver with a pipe as its standard input.
#include <fcntl.h>
#include <unistd.h>

#include <string>

#include "hal/operator/keyboard/conformance/keyboard_conformance.hpp"
#include "hal/operator/keyboard/terminal/terminal_keyboard.hpp"

namespace {

using namespace flexrf;

class PipeWorld final : public KeyboardWorld {
 public:
  PipeWorld() : standard_input_(fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10)) {}
  ~PipeWorld() override {
    bench_.reset();
    close_writer();
    if (standard_input_ >= 0) {
      dup2(standard_input_, STDIN_FILENO);
      close(standard_input_);
    }
  }

  void will_press(std::span<const KeyEvent> events, bool then_ends) override {
    for (const KeyEvent& event : events) bytes_ += bytes_of(event);
    ends_ = then_ends;
  }
  Status start(std::span<QueueSink* const> sinks) override {
    int ends[2];
    if (pipe(ends) != 0) return Status::error(StatusCode::internal, "no pipe");
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    writer_ = ends[1];
    bench_.emplace(nullptr, sinks);
    if (const Status status = bench_->driver().initialise(); !status) return status;
    if (write(writer_, bytes_.data(), bytes_.size()) != static_cast<ssize_t>(bytes_.size())) {
      return Status::error(StatusCode::internal, "the pipe took only a part");
    }
    if (ends_) close_writer();
    return {};
  }
  Keyboard& keyboard() override { return bench_->driver(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(7)); }

 private:
  static std::string bytes_of(const KeyEvent& event) {
    switch (event.key) {
      case Key::up:
        return "\x1B[A";
      case Key::down:
        return "\x1B[B";
      case Key::right:
        return "\x1B[C";
      case Key::left:
        return "\x1BOD\n";  // application mode; and a newline, which is no key here
      default:
        return std::string(1, static_cast<char>(event.character));
    }
  }
  void close_writer() {
    if (writer_ >= 0) close(writer_);
    writer_ = -1;
  }

  int standard_input_;
  int writer_ = -1;
  std::string bytes_;
  bool ends_ = false;
  std::optional<DeviceBench<TerminalKeyboard>> bench_;
};

}  // namespace

int main() {
  return run_keyboard_conformance("terminal keyboard, piped", []() -> std::unique_ptr<KeyboardWorld> {
    return std::make_unique<PipeWorld>();
  });
}
