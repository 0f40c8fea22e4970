#include "hal/can/socket_can/can_link_watch.hpp"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace flexrf {
namespace {

constexpr std::chrono::milliseconds longest_pause{200};

int open_link_events() noexcept {
  const int descriptor = socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (descriptor < 0) return -1;
  sockaddr_nl address{};
  address.nl_family = AF_NETLINK;
  address.nl_groups = RTMGRP_LINK;
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return descriptor;
  close(descriptor);
  return -1;
}

}  // namespace

Status CanLinkWatch::start(const char* interface, CanSocket& socket) {
  stop();
  interface_ = interface;
  socket_ = &socket;
  bound_ = 0;
  events_ = open_link_events();
  if (events_ < 0)
    return Status::error(StatusCode::unavailable, "%s cannot be watched: %s", interface,
                         std::strerror(errno));
  look();
  return thread_.begin<CanLinkWatch, &CanLinkWatch::run>(interface, *this);
}

void CanLinkWatch::stop() noexcept {
  thread_.end();
  if (events_ >= 0) close(events_);
  events_ = -1;
  view_.store(0, std::memory_order_release);
}

void CanLinkWatch::run() {
  pollfd source{events_, POLLIN, 0};
  while (thread_.wait(longest_pause, {&source, 1})) {
    // What changed does not matter: it is asked for anyway.
    std::array<char, 4096> message{};
    while (recv(events_, message.data(), message.size(), MSG_DONTWAIT) > 0) {
    }
    look();
  }
}

void CanLinkWatch::look() noexcept {
  int index = 0;
  Link link = ask(socket_->descriptor(), interface_.c_str(), index);
  if (link == Link::not_can) {
    bound_ = 0;
  } else if (index != 0 && index != bound_) {
    // An index is never given twice, so another one is another interface of the same name. Binding fails when
    // it has gone since it was asked for, and is tried again.
    bound_ = socket_->bind(index) ? index : 0;
    if (bound_ == 0) link = Link::gone;
  }
  view_.store(++looks_ << 8U | static_cast<std::uint8_t>(link), std::memory_order_release);
}

CanLinkWatch::Link CanLinkWatch::ask(int socket, const char* interface, int& index) noexcept {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  if (ioctl(socket, SIOCGIFINDEX, &request) != 0) return Link::gone;
  index = request.ifr_ifindex;
  if (ioctl(socket, SIOCGIFHWADDR, &request) != 0) return Link::gone;
  if (request.ifr_hwaddr.sa_family != ARPHRD_CAN) return Link::not_can;
  if (ioctl(socket, SIOCGIFFLAGS, &request) != 0) return Link::gone;
  const auto flags = static_cast<unsigned>(request.ifr_flags);
  if ((flags & IFF_UP) == 0) return Link::down;
  return (flags & IFF_RUNNING) == 0 ? Link::no_carrier : Link::up;
}

Status CanLinkWatch::advice(Link link, const char* interface) noexcept {
  switch (link) {
    case Link::gone:
      return Status::error(StatusCode::unavailable,
                           "there is no network interface %s; `ip link` lists those that are there",
                           interface);
    case Link::not_can:
      return Status::error(StatusCode::unavailable,
                           "%s is not a CAN interface; `ip link` lists those that are with `link/can`",
                           interface);
    case Link::down:
      return Status::error(StatusCode::unavailable,
                           "%s is down; `ip link set %s up type can bitrate RATE` sets it up", interface,
                           interface);
    case Link::no_carrier:
    case Link::up:
      break;
  }
  return {};
}

}  // namespace flexrf
