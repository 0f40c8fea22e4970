// LinuxDatagramSocket: datagrams over the sockets of this machine.
#pragma once

#include "hal/socket/datagram/interface/datagram_socket_on.hpp"
#include "hal/socket/datagram/linux/linux_datagram_transport.hpp"
#include "linux_datagram_socket_driver.hpp"

namespace flexrf {

class LinuxDatagramSocket final : public DatagramSocketOn<LinuxDatagramSocketDriver, LinuxDatagramTransport> {
};

}  // namespace flexrf
