#include "image/helper/admin_check.hpp"

#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::helper {

Answer AdminCheck::check(const std::string& user, const std::string& password, Time now) {
  if (const Duration wait = limits_.admit({}, false, now); wait > Duration::zero()) {
    Answer answer;
    answer.status = 429;
    answer.retry_after_s = panel::seconds_to_wait(wait);
    answer.why = "too many wrong passwords; try again in " + std::to_string(answer.retry_after_s) + " s";
    return answer;
  }
  // Its causes tell what stands in the file, which is the application's and may lead to another one.
  const Result<panel::Users> users = panel::read_users(users_file_);
  if (!users || users->list.empty())
    return refuse(503, "who may log in cannot be read, or nobody may; look after " + users_file_);
  const panel::User* const found = users->find(user);
  // A name that nobody has costs as much time as any.
  const std::string& hash = found != nullptr ? found->password_hash : users->list.front().password_hash;
  const bool is_right =
      password.size() <= panel::longest_password && panel::is_right_password(hash, password);
  if (found == nullptr || !is_right) return refuse(403, "user or password is wrong; type them once more");
  // This ends no delay: else whoever has a lesser password could try an admin's without end.
  if (found->role != Role::admin) return refuse(403, "this needs the role admin; ask somebody who has it");
  limits_.succeeded({});
  return {};
}

}  // namespace flexrf::helper
