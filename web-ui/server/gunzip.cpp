#include "web-ui/server/gunzip.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "web-ui/server/asio.hpp"

namespace flexrf::panel {
namespace {

constexpr std::size_t header_size = 10;  // without name or comment, as our build writes it
constexpr std::size_t trailer_size = 8;  // CRC-32 and size

}  // namespace

bool gunzip(std::string_view compressed, std::string& text) {
  if (compressed.size() < header_size + trailer_size || !compressed.starts_with("\x1F\x8B\x08") ||
      compressed[3] != 0) {
    return false;
  }
  std::uint32_t size = 0;  // little-endian, as we are
  std::memcpy(&size, compressed.data() + compressed.size() - sizeof(size), sizeof(size));
  const std::size_t before = text.size();
  text.resize(before + size);
  boost::beast::zlib::inflate_stream stream;
  boost::beast::zlib::z_params parameters;
  parameters.next_in = compressed.data() + header_size;
  // With the trailer: Beast looks some bits ahead of what it needs.
  parameters.avail_in = compressed.size() - header_size;
  parameters.next_out = text.data() + before;
  parameters.avail_out = size;
  error_code error;
  stream.write(parameters, boost::beast::zlib::Flush::finish, error);
  return error == boost::beast::zlib::error::end_of_stream && parameters.avail_out == 0;
}

}  // namespace flexrf::panel
