#include "web-ui/server/gzip.hpp"

#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>

namespace flexrf::panel {
namespace {

namespace zlib = boost::beast::zlib;

constexpr std::size_t least_size = 1400;      // bytes; less goes in one packet as it is
constexpr std::size_t most_size = 16U << 20;  // of which compressing would hold up the start
constexpr int level = 6;
constexpr int window_bits = 15;
constexpr int memory_level = 8;

void append_number(std::string& text, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(number >> shift & 0xFFU);
}

}  // namespace

std::string gzip(std::string_view bytes) {
  if (bytes.size() < least_size || bytes.size() > most_size) return {};
  zlib::deflate_stream stream;
  stream.reset(level, window_bits, memory_level, zlib::Strategy::normal);
  // Deflate, no name, no time, best effort, Unix.
  std::string text("\x1F\x8B\x08\x00\x00\x00\x00\x00\x00\x03", 10);
  const std::size_t head = text.size();
  text.resize(head + stream.upper_bound(bytes.size()));
  zlib::z_params parameters;
  parameters.next_in = bytes.data();
  parameters.avail_in = bytes.size();
  parameters.next_out = text.data() + head;
  parameters.avail_out = text.size() - head;
  boost::system::error_code error;
  stream.write(parameters, zlib::Flush::finish, error);
  if (error != zlib::error::end_of_stream) return {};
  text.resize(head + parameters.total_out);
  boost::crc_32_type checksum;
  checksum.process_bytes(bytes.data(), bytes.size());
  append_number(text, checksum.checksum());
  append_number(text, static_cast<std::uint32_t>(bytes.size()));
  if (text.size() > bytes.size() - bytes.size() / 10) return {};
  text.shrink_to_fit();
  return text;
}

}  // namespace flexrf::panel
