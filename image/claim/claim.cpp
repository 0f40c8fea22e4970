#include "image/claim/claim.hpp"

#include <unistd.h>

#include <utility>

#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::claim {
namespace {

/// Ok, or what has to be typed anew: it costs no try.
Status check(const Wish& wish) {
  if (wish.code.empty()) return Status::error(StatusCode::invalid_argument, "The code is missing.");
  if (const Status name = panel::check_user_name(wish.user); !name) return name;
  if (wish.password != wish.repeated)
    return Status::error(StatusCode::invalid_argument, "The two passwords are not the same.");
  return panel::check_password(wish.password);
}

}  // namespace

Answer Claim::attempt(const Wish& wish, const panel::Address& address, Time now) {
  if (is_done_) return {403, "Somebody has claimed this PC already. Reload the page to log in.", 0};
  if (const Status status = check(wish); !status) return {400, status.cause(), 0};
  if (shown_since_ == Time{}) shown_since_ = now;
  // "At the machine": failures of other addresses delay nobody.
  if (const Duration wait = limits_.admit(address, true, now); wait > Duration::zero()) {
    const unsigned seconds = panel::seconds_to_wait(wait);
    return {429, "Too many wrong codes. Try again in " + std::to_string(seconds) + " s.", seconds};
  }
  if (!code_.is(wish.code)) {
    if (++failures_ < tries || now - shown_since_ < shortest_life)
      return {403, "That is not the code on the PC's screen.", 0};
    failures_ = 0;
    shown_since_ = now;
    code_ = ClaimCode{};
    return {403, "Too many wrong codes came from everywhere: the PC's screen shows a new one now.", 0};
  }
  limits_.succeeded(address);
  // Whoever put a file there meanwhile, as with a disk in another PC, is not overruled.
  if (access(users_file_.c_str(), F_OK) == 0) return {503, "There are passwords already: restart the PC.", 0};
  Result<std::string> hash = panel::hash_password(wish.password);
  if (!hash) return {503, hash.status().cause(), 0};
  panel::Users users;
  users.list.push_back({wish.user, Role::admin, std::move(*hash)});
  if (const Status written = panel::write_users(users_file_, users); !written)
    return {503, written.cause(), 0};
  is_done_ = true;
  return {};
}

}  // namespace flexrf::claim
