#include "benchmarks/panel/http_load.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "benchmarks/harness.hpp"
#include "benchmarks/panel/cell.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

/// "1.23ms" as microseconds.
double microseconds_of(const char* text) {
  char* unit = nullptr;
  const double value = std::strtod(text, &unit);
  const std::string_view name{unit};
  return value * (name.starts_with("us") ? 1 : name.starts_with("ms") ? 1e3 : 1e6);
}

// What could cost nginx something that it need not do is off, what helps is on. Paths are below its prefix.
constexpr const char* settings_before_port = R"(daemon off;
master_process off;
worker_processes 1;
pid pid;
error_log errors warn;
events { worker_connections 256; }
http {
  access_log off;
  sendfile on;
  tcp_nopush on;
  tcp_nodelay on;
  keepalive_requests 1000000000;
  open_file_cache max=16 inactive=1h;
  open_file_cache_valid 1h;
  default_type application/json;
  client_body_temp_path body;
  proxy_temp_path proxy;
  fastcgi_temp_path fastcgi;
  uwsgi_temp_path uwsgi;
  scgi_temp_path scgi;
  server {
    root files;
    listen 127.0.0.1:)";
constexpr const char* settings_after_port = ";\n  }\n}\n";

}  // namespace

std::optional<HttpFigures> run_wrk(int port, const std::string& path, const std::string& session, int seconds,
                                   int connections, int cpu) {
  std::vector<std::string> arguments{"wrk", "-t1", text("-c%d", connections), text("-d%ds", seconds),
                                     "--latency"};
  if (!session.empty()) {
    arguments.push_back("-H");
    arguments.push_back(session.substr(0, session.find('\r')));
  }
  arguments.push_back(text("http://127.0.0.1:%d%s", port, path.c_str()));
  const std::optional<std::string> output = output_of(arguments, cpu);
  const std::size_t p99 = output ? output->find(" 99% ") : std::string::npos;
  const std::size_t requests = output ? output->find(" requests in ") : std::string::npos;
  if (p99 == std::string::npos || requests == std::string::npos ||
      output->find("Non-2xx") != std::string::npos || output->find("Socket errors") != std::string::npos) {
    std::fprintf(stderr, "panel: wrk (Debian's package wrk) made no requests that can be counted:\n%s\n",
                 output ? output->c_str() : "it could not be run");
    return std::nullopt;
  }
  const std::size_t line = output->rfind('\n', requests);
  return HttpFigures{std::atof(output->c_str() + line + 1), microseconds_of(output->c_str() + p99 + 5)};
}

Nginx::Nginx(const std::string& body, int cpu) : port_(free_port()), cpu_(cpu) {
  // A worker that root started is nobody's: it has to get in.
  std::filesystem::permissions(folder_.path(), std::filesystem::perms{0755});
  std::filesystem::create_directory(folder_.file("files"));
  std::ofstream{folder_.file("files") + path} << body;
  std::ofstream{folder_.file("nginx.conf")} << settings_before_port << port_ << settings_after_port;
}

bool Nginx::begin() {
  const std::optional<std::string> program = find_program("nginx");
  if (!program) {
    std::fputs("panel: nginx, the peer, is missing: apt-get install nginx-light\n", stderr);
    return false;
  }
  // -e: it opens a log even before it reads where that is.
  process_.emplace(Process::Settings{
      {*program, "-e", folder_.file("errors"), "-p", folder_.path(), "-c", folder_.file("nginx.conf")},
      {},
      folder_.file("log"),
      cpu_});
  for (int tries = 0; tries < 500 && process_->is_running(); ++tries) {
    if (ask(port_, "GET", path).status == 200) return true;
    std::this_thread::sleep_for(10ms);
  }
  std::fputs("panel: nginx does not serve:\n", stderr);
  show_log(folder_.file("log"));
  show_log(folder_.file("errors"));
  return false;
}

}  // namespace flexrf::bench
