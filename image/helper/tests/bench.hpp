// The helper's verbs on a PC that is claimed, confirmed and stands still.
#pragma once

#include <optional>
#include <string>

#include "image/helper/network.hpp"
#include "image/helper/state_answer.hpp"
#include "image/helper/tests/pc.hpp"
#include "image/helper/verbs.hpp"

namespace flexrf::helper {

using std::chrono::minutes;

inline const std::string start_verify = "start --no-block flexrf-update@verify.service";
inline const std::string start_install = "start --no-block flexrf-update@install.service";

inline Request request(Verb verb) {
  Request request;
  request.verb = verb;
  request.user = "anna";
  request.password = right_password;
  request.size = 6;
  request.slot = boot::Slot::b;
  return request;
}

inline std::string refusal(const Answer& answer) {
  return std::to_string(answer.status) + ' ' + answer.why;
}

class Bench {
 public:
  Bench() { pc.is_ready(); }

  Answer ask(const Request& request) { return verbs->perform(request, "uid 990, process 7"); }
  std::string answer_to(Verb verb) { return refusal(ask(request(verb))); }
  std::string part(const std::string& token, std::uint64_t offset, const std::string& bytes) {
    Request part;
    part.verb = Verb::part;
    part.upload = token;
    part.offset = offset;
    part.bytes = bytes;
    return refusal(ask(part));
  }
  /// The helper died and was started anew.
  void starts_anew() {
    verbs.emplace(pc.files, pc.surroundings, pc.word, [this] { return pc.now; });
  }
  std::string state() {
    return state_answer(pc.files, read_facts(pc.files, seconds{1}),
                        {pc.motion(), {}, seconds{60}, verbs->received(), pc.interfaces, pc.now});
  }
  std::string phase() {
    const std::string text = state();
    const std::size_t at = text.find("\"phase\":\"") + 9;
    return text.substr(at, text.find('"', at) - at);
  }

  Pc pc;
  std::optional<Verbs> verbs{std::in_place, pc.files, pc.surroundings, pc.word, [this] { return pc.now; }};
};

}  // namespace flexrf::helper
