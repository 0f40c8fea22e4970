#include "image/helper/facts.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "image/boot/environment.hpp"
#include "image/boot/folder_medium.hpp"
#include "image/helper/network.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::helper {
namespace {

bool has_admin(const std::string& file) {
  const Result<panel::Users> users = panel::read_users(file);
  if (!users) return false;
  for (const panel::User& user : users->list) {
    if (user.role == Role::admin) return true;
  }
  return false;
}

}  // namespace

Facts read_facts(const Files& files, Duration wait) {
  Facts facts;
  facts.is_claimed = has_admin(files.users);
  const Progress progress = read_progress(files.update);
  facts.update = progress.phase;
  facts.update_failure = progress.why;
  if (auto trial = read_trial(files.network)) facts.address_on_trial = std::move(trial->interface);
  facts.running = read_running(files);
  boot::FolderMedium medium;
  if (const Status opened = medium.open(files.choice, wait); !opened) {
    facts.choice_failure = opened.cause();
    return facts;
  }
  const boot::Environment environment(medium);
  if (environment.has_choice()) {
    facts.choice = environment.choice();
    const boot::Attempts& attempts = environment.attempts();
    if (attempts.trial == facts.choice->trial) facts.attempts = attempts.count;
  } else {
    facts.choice_failure = environment.damages();
  }
  return facts;
}

std::string version_file(const UpdateFiles& files, boot::Slot slot) {
  return files.folder + (slot == boot::Slot::a ? "/version-a" : "/version-b");
}

NamedLines version_lines(const UpdateFiles& files, boot::Slot slot) {
  const Result<NamedLines> lines = NamedLines::read(version_file(files, slot));
  return lines ? *lines : NamedLines{};
}

boot::Running read_running(const Files& files) {
  std::ifstream file(files.command_line);
  return boot::running_from(
      std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

}  // namespace flexrf::helper
