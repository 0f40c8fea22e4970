#include "tests/applications/process.hpp"

#include <fcntl.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utmp.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::whole {

std::string contents_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  CHECK(file.flush().good());
}

Folder::Folder() {
  char path[] = "/tmp/flexrf-whole-XXXXXX";
  CHECK(mkdtemp(path) != nullptr);
  path_ = path;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Process::Process(const Folder& folder, std::vector<std::string> words, Input input,
                 const std::function<void()>& in_child)
    : kind_(input), output_path_(folder / "output"), error_path_(folder / "errors") {
  int ends[2];
  if (input == Input::terminal) {
    CHECK(openpty(&ends[1], &ends[0], nullptr, nullptr, nullptr) == 0);
  } else {
    CHECK(pipe(ends) == 0);
  }
  // Each start has files of its own, so that what an earlier one said is not taken for this one's.
  for (int n = 2; std::filesystem::exists(output_path_); ++n) {
    output_path_ = folder / ("output" + std::to_string(n));
    error_path_ = folder / ("errors" + std::to_string(n));
  }
  const int output = open(output_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const int errors = open(error_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  CHECK(output >= 0 && errors >= 0);
  fcntl(ends[1], F_SETFD, FD_CLOEXEC);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  id_ = fork();
  CHECK(id_ >= 0);
  if (id_ == 0) {
    if (input == Input::terminal) login_tty(ends[0]);
    dup2(ends[0], STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1);
    if (in_child) in_child();
    if (chdir(folder.path().c_str()) == 0) execvp(arguments[0], arguments.data());
    _exit(126);
  }
  close(ends[0]);
  close(output);
  close(errors);
  input_ = ends[1];
}

Process::~Process() {
  if (!ended_) {
    kill(id_, SIGKILL);
    waitpid(id_, &status_, 0);
  }
  end_input();
}

void Process::type(const std::string& keys) {
  for (std::size_t written = 0; written < keys.size();) {
    const ssize_t count = write(input_, keys.data() + written, keys.size() - written);
    CHECK(count > 0);
    written += static_cast<std::size_t>(count);
  }
}

void Process::end_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

void Process::send(int signal) const {
  CHECK(kill(id_, signal) == 0);
}

bool Process::has_ended() {
  if (!ended_) ended_ = waitpid(id_, &status_, WNOHANG) == id_;
  return ended_;
}

void Process::wait_until_stopped() {
  CHECK(wait_until([&] {
    int status = 0;
    return waitpid(id_, &status, WNOHANG | WUNTRACED) == id_ && WIFSTOPPED(status);
  }));
}

void Process::wait_for_error(const std::string& text) {
  const bool found =
      wait_until([&] { return contents_of(error_path_).find(text) != std::string::npos || has_ended(); });
  fixture::check_contains(contents_of(error_path_), text, __FILE__, __LINE__);
  CHECK(found);
}

Ending Process::wait() {
  CHECK(wait_until([this] { return has_ended(); }));
  Ending ending;
  if (WIFEXITED(status_)) ending.exit_code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) ending.signal = WTERMSIG(status_);
  ending.output = contents_of(output_path_);
  ending.errors = contents_of(error_path_);
  return ending;
}

Ending run(const Folder& folder, std::vector<std::string> words, const std::string& keys) {
  Process process(folder, std::move(words));
  process.type(keys);
  process.end_input();
  return process.wait();
}

Report::Report(const std::string& path) {
  const std::string text = contents_of(path);
  json_ = nlohmann::json::parse(text, nullptr, false);
  if (json_.is_discarded()) throw fixture::CheckFailed{path + " is no report:\n" + text};
}

const nlohmann::json& Report::row(const char* array, const std::string& name) const {
  for (const nlohmann::json& one : json_.at(array))
    if (one.at("name") == name) return one;
  throw fixture::CheckFailed{"the report knows no " + name + " in " + array};
}

}  // namespace flexrf::whole
