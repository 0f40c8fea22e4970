// Requests over 50 keep-alive connections, made by wrk, and nginx as the one to be measured against.
#pragma once

#include <optional>
#include <string>

#include "benchmarks/panel/process.hpp"
#include "benchmarks/program.hpp"

namespace flexrf::bench {

struct HttpFigures {
  double requests = 0;
  double p99_us = 0;
};

/// GETs for so many seconds. Nothing, and said why on standard error: it could not be run, or something else
/// than 200 was answered. `session`: a whole line of the head, or empty.
std::optional<HttpFigures> run_wrk(int port, const std::string& path, const std::string& session, int seconds,
                                   int connections, int cpu);

/// One worker that serves one file from a folder of its own.
class Nginx {
 public:
  Nginx(const std::string& body, int cpu);

  /// False, and its log is shown: it does not serve.
  bool begin();
  int port() const noexcept { return port_; }
  static constexpr const char* path = "/value";
  Duration cpu_time() const { return process_->cpu_time(); }

 private:
  TemporaryFolder folder_;
  int port_;
  int cpu_;
  std::optional<Process> process_;
};

}  // namespace flexrf::bench
