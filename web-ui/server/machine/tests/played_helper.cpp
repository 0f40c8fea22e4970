#include "web-ui/server/machine/tests/played_helper.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace flexrf::panel {
namespace {

constexpr std::size_t longest_message = 64U << 10;

void require(bool is_so, const char* what) {
  if (is_so) return;
  std::perror(what);
  std::abort();
}

}  // namespace

SocketPlace::SocketPlace() {
  char folder[] = "/tmp/flexrf-helper-XXXXXX";
  require(mkdtemp(folder) != nullptr, folder);
  folder_ = folder;
  path_ = folder_ + "/socket";
}

SocketPlace::~SocketPlace() {
  std::filesystem::remove_all(folder_);
}

PlayedHelper::PlayedHelper(const std::string& path, React react) : path_(path), react_(std::move(react)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  listener_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  end_ = eventfd(0, EFD_CLOEXEC);
  unlink(path.c_str());
  require(listener_ >= 0 && end_ >= 0 &&
              bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
              listen(listener_, 8) == 0,
          path.c_str());
  thread_ = std::thread([this] { run(); });
}

PlayedHelper::~PlayedHelper() {
  eventfd_write(end_, 1);
  thread_.join();
  for (const int connection : connections_) close(connection);
  close(listener_);
  close(end_);
  unlink(path_.c_str());
}

void PlayedHelper::run() {
  for (;;) {
    std::vector<pollfd> all = {{end_, POLLIN, 0}, {listener_, POLLIN, 0}};
    for (const int connection : connections_) all.push_back({connection, POLLIN, 0});
    if (poll(all.data(), all.size(), -1) < 0) continue;
    if (all[0].revents != 0) return;
    if (all[1].revents != 0) connections_.push_back(accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC));
    for (std::size_t i = 2; i < all.size(); ++i) {
      if (all[i].revents == 0 || serve(all[i].fd)) continue;
      close(all[i].fd);
      std::erase(connections_, all[i].fd);
    }
  }
}

bool PlayedHelper::serve(int connection) {
  std::string message(longest_message, '\0');
  const ssize_t size = recv(connection, message.data(), message.size(), 0);
  if (size <= 0) return false;
  message.resize(static_cast<std::size_t>(size));
  const std::size_t line = std::min(message.find('\n'), message.size());
  const Reaction reaction =
      react_(message.substr(0, line), message.substr(std::min(line + 1, message.size())));
  if (reaction.how == How::hangs_up) return false;
  if (reaction.how == How::says_nothing) return true;
  const auto say = [connection](std::string_view text) {
    return ::send(connection, text.data(), text.size(), MSG_NOSIGNAL) >= 0;
  };
  if (!say(reaction.text)) return false;
  if (reaction.how != How::answers_twice) return true;
  if (!say("a word too many")) return false;
  ++unasked_words_;
  return true;
}

}  // namespace flexrf::panel
