// LinuxDatagramSocket: datagrams over the sockets of this machine.
#pragma once

#include "hal/interfaces/datagram_socket/datagram_socket_on.hpp"
#include "hal/linux/linux_datagram_socket/linux_datagram_transport.hpp"
#include "linux_datagram_socket_driver.hpp"

namespace flexrf {

class LinuxDatagramSocket final : public DatagramSocketOn<LinuxDatagramSocketDriver, LinuxDatagramTransport> {
};

}  // namespace flexrf
