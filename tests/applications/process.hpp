// An application as a process of its own, as a person or another program meets it.
#pragma once

#include <sys/types.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/waiting.hpp"

namespace flexrf::whole {

using test::wait_until;

std::string contents_of(const std::string& path);
void write_file(const std::string& path, const std::string& text);

/// A folder of its own in /tmp, empty at first, gone at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Ending {
  int exit_code = -1;  ///< −1: ended by a signal
  int signal = 0;      ///< 0: exited
  std::string output;
  std::string errors;
};

enum class Input { pipe, terminal };

/// Runs with the folder as its working directory and the place of its lock file. Failures of the machinery,
/// and waiting in vain, end in CheckFailed.
class Process {
 public:
  /// `in_child`: done in the new process just before it becomes the application; nothing that allocates.
  Process(const Folder& folder, std::vector<std::string> words, Input input = Input::pipe,
          const std::function<void()>& in_child = {});
  ~Process();  // kills what still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }
  /// All of it: a pipe takes 64 KiB, what is more waits for the process.
  void type(const std::string& keys);
  void end_input();
  void send(int signal) const;
  /// Until the text stands in what was written to standard error.
  void wait_for_error(const std::string& text);
  /// Until it is stopped, as by Ctrl-Z.
  void wait_until_stopped();
  bool has_ended();
  Ending wait();
  /// The far end of its terminal.
  int terminal() const { return input_; }

 private:
  Input kind_;
  std::string output_path_;
  std::string error_path_;
  int input_ = -1;  // the end that this process writes to
  pid_t id_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

/// The whole life of one whose input is there from the beginning.
Ending run(const Folder& folder, std::vector<std::string> words, const std::string& keys = "");

/// What --report wrote.
class Report {
 public:
  explicit Report(const std::string& path);
  const nlohmann::json& operator[](const char* member) const { return json_.at(member); }
  /// The row of this name in an array of the report.
  const nlohmann::json& row(const char* array, const std::string& name) const;
  /// What a slot held last.
  const nlohmann::json& last(const std::string& slot) const {
    return row("slots", slot).at("last").at("value");
  }

 private:
  nlohmann::json json_;
};

}  // namespace flexrf::whole
