// An application with its panel, as the benchmark runs and asks it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "benchmarks/panel/process.hpp"
#include "benchmarks/panel_load/recording.hpp"
#include "benchmarks/program.hpp"

namespace flexrf::bench {

struct HttpAnswer {
  int status = 0;  ///< 0: there was no answer
  std::string head;
  std::string body;
};

/// One request over a connection of its own; blocks 10 s at most. `more_head`: whole lines.
HttpAnswer ask(int port, std::string_view method, std::string_view path, std::string_view more_head = "",
               std::string_view body = "");

class Cell {
 public:
  struct Settings {
    std::string executable;
    std::vector<std::string> arguments{};
    bool with_panel = true;
    std::string preload{};  ///< a library that counts, see counting.cpp
  };

  explicit Cell(const Settings& settings);

  /// Waits until it serves, or steps where it has no panel. False, and its log is shown: it does not.
  bool begin();
  Process& process() { return *process_; }
  Recording& recording() { return *recording_; }
  /// Of a library that counts: what it wrote last.
  std::string counts_file() const { return folder_.file("counts"); }
  int port() const noexcept { return port_; }
  /// "Cookie: ...\r\n" of an administrator's session, who has the control token.
  const std::string& session() const noexcept { return session_; }
  /// As ask(), below /api/v1/, in that session.
  HttpAnswer ask(std::string_view method, const std::string& path, std::string_view body = "") const;
  /// CPU time of the threads that serve the panel: of the server, and of pictures.
  Duration server_time() const;
  Duration picture_time() const;

 private:
  bool find_address();
  bool log_in(const std::string& token);

  TemporaryFolder folder_;
  Settings settings_;
  Recording* recording_ = nullptr;
  std::optional<Process> process_;
  int port_ = -1;
  std::string session_;
};

}  // namespace flexrf::bench
