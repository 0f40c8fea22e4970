// LinuxStreamSocket: connections over the sockets of this machine.
#pragma once

#include "hal/socket/stream/interface/stream_socket_on.hpp"
#include "hal/socket/stream/linux/linux_stream_transport.hpp"
#include "linux_stream_socket_driver.hpp"

namespace flexrf {

/// A peer that is not there is no failure to start: it is looked for until it is.
class LinuxStreamSocket final : public StreamSocketOn<LinuxStreamSocketDriver, LinuxStreamTransport> {};

}  // namespace flexrf
