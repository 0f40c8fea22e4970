#include "hal/process/interface/hosted_process.hpp"
#include "hal/process/interface/word_list.hpp"

namespace flexrf {
namespace {

Result<std::vector<std::string>> named_words(const char* name, std::string_view text) {
  Result<std::vector<std::string>> words = words_of(text);
  if (words) return words;
  return Status::error(words.status().code(), "configuration.%s: %s", name, words.status().cause());
}

}  // namespace

Result<ProcessProgram> process_program(std::string_view executable, std::string_view arguments,
                                       std::string_view environment, std::string_view directory) {
  for (const std::string_view path : {executable, directory}) {
    if (!path.empty() && path.front() == '/') continue;
    return Status::error(StatusCode::invalid_argument,
                         "configuration.%s \"%.*s\" is no path from the root; write it as in /usr/bin/cat",
                         path.data() == executable.data() ? "executable" : "working_directory",
                         static_cast<int>(path.size()), path.data());
  }
  Result<std::vector<std::string>> words = named_words("arguments", arguments);
  if (!words) return words.status();
  Result<std::vector<std::string>> variables = named_words("environment", environment);
  if (!variables) return variables.status();
  bool has_path = false;
  for (const std::string& variable : *variables) {
    const std::size_t equals = variable.find('=');
    if (equals == 0 || equals == std::string::npos) {
      return Status::error(StatusCode::invalid_argument,
                           "configuration.environment: \"%s\" is not of the form NAME=value",
                           variable.c_str());
    }
    has_path = has_path || variable.starts_with("PATH=");
  }
  if (!has_path) variables->emplace_back("PATH=/usr/local/bin:/usr/bin:/bin");
  return ProcessProgram{std::string(executable), std::move(*words), std::move(*variables),
                        std::string(directory)};
}

}  // namespace flexrf
