// Asio and Beast, compiled once.
#include "web-ui/server/asio.hpp"

// clang-format off
#include <boost/asio/impl/src.hpp>
#include <boost/asio/ssl/impl/src.hpp>
#include <boost/beast/src.hpp>
// clang-format on
