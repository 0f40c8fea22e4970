// What the helper is asked: one message of its socket.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "image/boot/choice.hpp"
#include "image/helper/answer.hpp"
#include "runtime/json/json_reader.hpp"

namespace flexrf::helper {

enum class Verb : std::uint8_t {
  state,
  upload,
  part,
  install,
  choose,
  restart,
  network,
  keep_network,
  dismiss_failure,
  make_room,
  hosts
};
const char* name_of(Verb verb) noexcept;

/// What the verb has no use for is empty.
struct Request {
  Verb verb = Verb::state;
  std::string user;
  std::string password;
  std::uint64_t size = 0;      ///< of the bundle, bytes
  std::string upload;          ///< the token
  std::uint64_t offset = 0;    ///< of the part
  std::string bytes;           ///< the part
  bool older = false;          ///< a bundle that is older than what runs may be installed
  bool other_drivers = false;  ///< devices may get other drivers than those that run
  boot::Slot slot = boot::Slot::a;
  std::string interface;  ///< of the network
  std::string address;    ///< its setting, see parse_setting()
  std::string gateway;
  std::string what;        ///< of the data may go: "logs"
  std::string reached_by;  ///< the PC's own address at which its panel was asked
  std::string hosts;       ///< all declared ones, see panel::split_hosts()
};

inline constexpr std::size_t longest_line = 1024;
inline constexpr std::size_t longest_part = std::size_t{60} * 1024;
inline constexpr std::size_t longest_message = longest_line + 1 + longest_part;

/// A JSON object in one line; behind the line of `part` its bytes. Refused with 400, which names the member,
/// or 413.
std::variant<Request, Answer> parse_request(JsonReader& reader, std::string_view message);

}  // namespace flexrf::helper
