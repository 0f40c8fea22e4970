// JSON-RPC 2.0 (jsonrpc.org/specification), a line each: what a line asks, and the lines that answer.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/json_writer.hpp"
#include "runtime/json/json_reader.hpp"

namespace flexrf::remote {

/// The first four are the standard's; the others are ours, in the range that it leaves to servers.
enum class RpcError : int {
  parse = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  busy = -32000,           ///< nothing happened; try again
  token_missing = -32001,  ///< or wrong
  not_remote = -32002,     ///< the person at the machine does not permit it
  role_missing = -32003,   ///< this is for higher roles than scripts have
  not_found = -32004,      ///< no such slot, unit, device, queue, thread, parameter
  refused = -32005,        ///< the value, or the state
  stale = -32006,          ///< settings changed since `expected`
  too_large = -32007,
  no_answer = -32008,  ///< the component did not answer in time
};

/// What went wrong, and what a person can do about it.
struct RpcProblem {
  RpcError error = RpcError::invalid_request;
  std::string reason;
  std::string hint;
};

struct RpcCall {
  std::string id;           ///< as JSON; empty: a notification, which nobody answers
  std::string_view method;  ///< valid until the next line is read, as are the parameters
  JsonObject params;        ///< {} where there are none
};

class RpcReader {
 public:
  RpcReader();

  /// Reads a line; the problem when it is no call. `call.id` is then what is known of it, or null.
  std::optional<RpcProblem> read(std::string_view line, RpcCall& call);

 private:
  std::optional<RpcProblem> read_object(JsonObject object, RpcCall& call) const;

  JsonReader reader_;
  simdjson::dom::parser no_params_;
  JsonObject none_;
};

/// {"jsonrpc", "id", "result": what `write(JsonWriter&)` writes, one value}
template <class Write>
std::string result_line(std::string_view id, Write&& write) {
  JsonWriter json(std::string{}, JsonWriter::Style::compact);
  json.begin_object().member("jsonrpc", "2.0").key("id").raw(id).key("result");
  write(json);
  json.end_object();
  return json.release();
}
/// {"jsonrpc", "id", "error": {"code", "message", "data": {"reason", "hint"}}}
std::string error_line(std::string_view id, const RpcProblem& problem);

/// Parameters are missing or of another type.
RpcProblem wrong_params(const Fields& params, std::string hint);

/// "did you mean 'x'?" made of the nearest known name; otherwise, where none is near, the other hint.
std::string nearest_hint(std::string_view nearest, std::string_view otherwise);
/// What others wrote, cut for showing it to them.
std::string_view shown(std::string_view text) noexcept;

}  // namespace flexrf::remote
