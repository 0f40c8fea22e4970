// config-gen: reads tables, checks them, writes C++ and descriptions.
//
//   config-gen (--application FILE | --unit FILE | --interface FILE | --driver FILE | --types-only FOLDER)
//              [--types FOLDER...] [--units FOLDER...] [--interfaces FOLDER...] [--drivers FOLDER...]
//              [--library FOLDER...]
//              (--output FOLDER [--dependencies FILE --stamp FILE] | --check-only [--fix [FOLDER...]
//              [--dry-run]])
//
// Prints nothing on success. --fix puts known names in the place of misspelt ones, in files of the
// application's folder and below each FOLDER, and prints each change; with --dry-run it writes none
// (config-gen/fix/fix.hpp). Exit code 1 on any error in the tables or the command line; nothing is written
// then.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/standard_descriptors.hpp"
#include "config-gen/fix/fix.hpp"
#include "config-gen/model/file_contents.hpp"
#include "config-gen/model/target.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

constexpr const char* usage =
    "usage: config-gen (--application FILE | --unit FILE | --interface FILE | --driver FILE | --types-only "
    "FOLDER)\n"
    "                  [--types FOLDER...] [--units FOLDER...] [--interfaces FOLDER...] [--drivers "
    "FOLDER...]\n"
    "                  [--library FOLDER...]\n"
    "                  (--output FOLDER [--dependencies FILE --stamp FILE] | --check-only [--fix [FOLDER...] "
    "[--dry-run]])\n";

struct Command {
  std::optional<Target> target;
  SearchPaths paths;
  fs::path output;
  fs::path dependencies;  // Makefile rules for the build system
  fs::path stamp;         // touched on success; the target of those rules
  bool check_only = false;
  bool fix = false;
  FixSettings fixing;
};

Command parse(const std::vector<std::string>& words) {
  Command command;
  const std::map<std::string, Target::Kind> targets = {{"--application", Target::Kind::application},
                                                       {"--unit", Target::Kind::unit},
                                                       {"--interface", Target::Kind::interface},
                                                       {"--driver", Target::Kind::driver},
                                                       {"--types-only", Target::Kind::types}};
  const std::map<std::string, std::vector<fs::path>*> folders = {
      {"--types", &command.paths.types},           {"--units", &command.paths.units},
      {"--interfaces", &command.paths.interfaces}, {"--drivers", &command.paths.drivers},
      {"--library", &command.paths.library},       {"--fix", &command.fixing.folders}};
  const std::map<std::string, fs::path*> files = {
      {"--output", &command.output}, {"--dependencies", &command.dependencies}, {"--stamp", &command.stamp}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& option = words[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw std::invalid_argument(option + " needs a value");
      return words[++i];
    };
    if (const auto target = targets.find(option); target != targets.end()) {
      if (command.target) throw std::invalid_argument("one run makes one thing: " + option + " is too much");
      command.target = Target{target->second, fs::path(value()).lexically_normal()};
    } else if (const auto folder = folders.find(option); folder != folders.end()) {
      command.fix = command.fix || option == "--fix";
      while (i + 1 < words.size() && !words[i + 1].starts_with("--")) folder->second->push_back(words[++i]);
    } else if (const auto file = files.find(option); file != files.end()) {
      *file->second = value();
    } else if (option == "--check-only") {
      command.check_only = true;
    } else if (option == "--dry-run") {
      command.fixing.dry_run = true;
    } else {
      std::vector<std::string> known = {"--check-only", "--dry-run"};
      for (const auto& [name, kind] : targets) known.push_back(name);
      for (const auto& [name, list] : folders) known.push_back(name);
      for (const auto& [name, path] : files) known.push_back(name);
      throw std::invalid_argument("unknown option " + quote(option) + "; " +
                                  suggest(option, known, "options", "").text);
    }
  }
  if (!command.target) throw std::invalid_argument("nothing to do");
  if (command.output.empty() && !command.check_only) throw std::invalid_argument("--output is missing");
  if (command.dependencies.empty() != command.stamp.empty())
    throw std::invalid_argument("--dependencies and --stamp belong together");
  if (command.fixing.dry_run && !command.fix) throw std::invalid_argument("--dry-run belongs to --fix");
  if (command.fix && (!command.check_only || command.target->kind != Target::Kind::application))
    throw std::invalid_argument("--fix belongs to --application and --check-only");
  return command;
}

void write(const fs::path& file, const std::string& contents) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!(stream << contents) || !stream.flush())
    throw std::runtime_error("cannot write " + file.generic_string());
}

// What did not change keeps its time, so that nothing is compiled again for it.
void write_if_changed(const fs::path& file, const std::string& contents) {
  if (fs::exists(file) && contents_of(file) == contents) return;
  write(file, contents);
}

// As ninja and make read a name in a rule: before a blank, backslashes of the name are doubled.
std::string escaped(const fs::path& file) {
  std::string text;
  std::size_t backslashes = 0;
  for (const char c : file.generic_string()) {
    if (c == ' ') text.append(backslashes + 1, '\\');
    if (c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return text;
}

void write_dependencies(const Command& command, const Model& model) {
  if (command.dependencies.empty()) return;
  std::vector<std::string> files;
  for (const fs::path& file : model.files) files.push_back(escaped(fs::absolute(file).lexically_normal()));
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::string rules = escaped(command.stamp) + ":";
  for (const std::string& file : files) rules += " \\\n  " + file;
  write(command.dependencies, rules + "\n");
  write(command.stamp, "");
}

struct Made {
  Model model;
  std::vector<GeneratedFile> files;
};

Made make(const Command& command, Diagnostics& diagnostics) {
  Made made{read(*command.target, command.paths, diagnostics), {}};
  check(made.model, diagnostics);
  // Also where nothing is to be written: only the emitter places each thread's readers.
  if (!diagnostics.failed()) made.files = emit(made.model, *command.target, diagnostics);
  return made;
}

int run_fix(const Command& command) {
  FixSettings settings = command.fixing;
  const fs::path folder = command.target->file.parent_path();
  settings.folders.push_back(folder.empty() ? "." : folder);
  const auto examine = [&command] {
    Examined examined;
    examined.files = make(command, examined.diagnostics).model.files;
    return examined;
  };
  return fix(settings, examine, std::cerr) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int run(const Command& command) {
  if (command.fix) return run_fix(command);
  Diagnostics diagnostics;
  const Made made = make(command, diagnostics);
  diagnostics.print(std::cerr);
  if (diagnostics.failed()) return EXIT_FAILURE;
  if (command.check_only) return EXIT_SUCCESS;
  for (const GeneratedFile& file : made.files) write_if_changed(command.output / file.path, file.contents);
  write_dependencies(command, made.model);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace flexrf::config_gen

int main(int argument_count, char** arguments) {
  using namespace flexrf::config_gen;
  flexrf::hold_standard_descriptors();
  try {
    return run(parse({arguments + 1, arguments + argument_count}));
  } catch (const std::invalid_argument& error) {
    std::cerr << "config-gen: " << error.what() << '\n' << usage;
  } catch (const std::exception& error) {
    std::cerr << "config-gen: " << error.what() << '\n';
  }
  return EXIT_FAILURE;
}
