#include "benchmarks/panel/cell.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <thread>

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

bool wait_until(auto&& condition) {
  for (int tries = 0; tries < 1000; ++tries) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

Recording* make_recording(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  void* memory = MAP_FAILED;
  if (file >= 0 && ftruncate(file, sizeof(Recording)) == 0)
    memory = mmap(nullptr, sizeof(Recording), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) {
    std::perror(path.c_str());
    std::exit(1);
  }
  close(file);
  return new (memory) Recording{};
}

}  // namespace

HttpAnswer ask(int port, std::string_view method, std::string_view path, std::string_view more_head,
               std::string_view body) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const timeval patience{10, 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  HttpAnswer answer;
  if (connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
    const std::string host = "127.0.0.1:" + std::to_string(port);
    std::string request{method};
    request.append(" ").append(path).append(" HTTP/1.1\r\nHost: ").append(host).append("\r\n");
    if (method != "GET") {
      request.append("Origin: http://").append(host).append("\r\n");
      request.append("Content-Type: application/json\r\nContent-Length: ");
      request.append(std::to_string(body.size())).append("\r\n");
    }
    request.append("Connection: close\r\n").append(more_head).append("\r\n").append(body);
    if (send(socket, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(request.size())) {
      char part[16384];
      for (ssize_t size = 0; (size = recv(socket, part, sizeof(part), 0)) > 0;) {
        answer.head.append(part, static_cast<std::size_t>(size));
      }
    }
  }
  close(socket);
  const std::size_t end = answer.head.find("\r\n\r\n");
  if (end == std::string::npos) return answer;
  answer.body = answer.head.substr(end + 4);
  answer.head.resize(end + 2);
  answer.status = std::atoi(answer.head.c_str() + std::string_view{"HTTP/1.1 "}.size());
  return answer;
}

Cell::Cell(const Settings& settings)
    : settings_(settings), recording_(make_recording(folder_.file("recording"))) {
  Process::Settings how;
  how.arguments = {settings.executable, "--panel", settings.with_panel ? "127.0.0.1:0" : "off"};
  how.arguments.insert(how.arguments.end(), settings.arguments.begin(), settings.arguments.end());
  how.environment = {std::string{Recording::variable} + "=" + folder_.file("recording"),
                     "XDG_RUNTIME_DIR=" + folder_.path()};
  if (!settings.preload.empty()) {
    how.environment.push_back("LD_PRELOAD=" + settings.preload);
    how.environment.push_back("FLEXRF_BENCH_COUNTS=" + counts_file());
  }
  how.log = folder_.file("log");
  process_.emplace(how);
}

bool Cell::begin() {
  const bool begun = settings_.with_panel
                         ? find_address()
                         : wait_until([this] { return recording_->steps > 0 || !process_->is_running(); });
  if (begun && process_->is_running()) return true;
  std::fprintf(stderr, "panel: %s does not run:\n", settings_.executable.c_str());
  show_log(folder_.file("log"));
  return false;
}

bool Cell::find_address() {
  std::string log;
  std::size_t at = std::string::npos;
  const std::string_view before = "Panel: http://127.0.0.1:";
  const bool printed = wait_until([&] {
    log = contents_of(folder_.file("log"));
    at = log.find(before);
    return (at != std::string::npos && log.find('\n', at) != std::string::npos) || !process_->is_running();
  });
  if (!printed || at == std::string::npos) return false;
  port_ = std::atoi(log.c_str() + at + before.size());
  const std::size_t token = log.find("?token=", at);
  // It prints the address before it serves.
  return token != std::string::npos && log_in(log.substr(token, log.find('\n', token) - token));
}

bool Cell::log_in(const std::string& token) {
  const HttpAnswer answer = bench::ask(port_, "GET", "/" + token);
  const std::string_view field = "Set-Cookie: ";
  const std::size_t cookie = answer.head.find(field);
  if (cookie == std::string::npos) return false;
  const std::size_t begin = cookie + field.size();
  session_ = "Cookie: " + answer.head.substr(begin, answer.head.find(';', begin) - begin) + "\r\n";
  return ask("POST", "control/take").status == 200;
}

HttpAnswer Cell::ask(std::string_view method, const std::string& path, std::string_view body) const {
  return bench::ask(port_, method, "/api/v1/" + path, session_, body);
}

Duration Cell::server_time() const {
  return process_->cpu_time("panel");
}

Duration Cell::picture_time() const {
  return process_->cpu_time("panel-pictures");
}

}  // namespace flexrf::bench
