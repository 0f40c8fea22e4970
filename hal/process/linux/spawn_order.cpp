#include "hal/process/linux/spawn_order.hpp"

#include <algorithm>
#include <string_view>

#include "hal/process/interface/process_host.hpp"

namespace flexrf {

Status SpawnOrder::set(const ProcessProgram& program) noexcept {
  verb = SpawnVerb::start;
  size = 0;
  bool fits = program.arguments.size() + 1 < max_words && program.environment.size() < max_words;
  const auto add = [this, &fits](std::string_view word) {
    fits = fits && size + word.size() + 1 <= words.size();
    if (!fits) return;
    *std::copy(word.begin(), word.end(), words.begin() + size) = '\0';
    size = static_cast<std::uint16_t>(size + word.size() + 1);
  };
  add(program.executable);
  add(program.directory);
  for (const std::string& word : program.arguments) add(word);
  for (const std::string& word : program.environment) add(word);
  arguments = static_cast<std::uint16_t>(program.arguments.size());
  variables = static_cast<std::uint16_t>(program.environment.size());
  if (fits) return {};
  return Status::error(StatusCode::invalid_argument,
                       "its arguments and environment are too long: at most %zu words of %zu bytes in all",
                       max_words, words.size());
}

}  // namespace flexrf
