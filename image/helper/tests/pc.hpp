// A PC for the helper's tests: its files in a folder, and all that is not files, the panel, systemd and the
// clock, played by the test.
#pragma once

#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "image/boot/folder_medium.hpp"
#include "image/boot/verbs.hpp"
#include "image/helper/facts.hpp"
#include "image/helper/helper.hpp"
#include "image/helper/verbs.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "web-ui/server/access/tests/quick_hash.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::helper {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

inline constexpr const char* right_password = "a long enough password";

inline const std::string& hash_of_right_password() {
  static const std::string hash = panel::quick_hash(right_password);
  return hash;
}

inline std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Pc {
 public:
  explicit Pc(const std::string& place_of_word = "")
      : path_(new_folder()),
        word(
            path_ + place_of_word + "/motion",
            [this] { return permission_of(read_facts(files, seconds{1})); },
            [this](const std::string& line) { said.push_back(line); }) {
    files.word = path_ + place_of_word + "/motion";
    files.users = path_ + "/panel-users";
    files.choice = path_ + "/choice";
    files.command_line = path_ + "/cmdline";
    files.version = path_ + "/version";
    files.notices = path_ + "/notices";
    files.boot_id = path_ + "/boot_id";
    files.data = path_ + "/data";
    files.network = {path_ + "/kept", path_ + "/used"};
    files.update = {path_ + "/update", path_ + "/results"};
    for (const std::string& folder : {files.choice, files.data, files.update.folder, files.update.results,
                                      files.network.kept, files.network.used})
      fs::create_directory(folder);
    write(files.version, "application=pick-station\nversion=20261128T001500Z-4fb48992\nbuilt=1000\n");
    write(files.boot_id, "01234567-89ab-cdef-0123-456789abcdef\n");
    choose({"create"});
    boots("A", "only");
    surroundings.ask_panel = [this](Duration) { return panel; };
    surroundings.say = [this](const std::string& line) { said.push_back(line); };
    surroundings.systemctl = [this](const std::vector<std::string>& words) { return systemctl(words); };
    surroundings.interfaces = [this] { return interfaces; };
    surroundings.free_bytes = [this](const std::string&) { return free; };
  }
  Pc(const Pc&) = delete;
  Pc& operator=(const Pc&) = delete;
  ~Pc() { fs::remove_all(path_); }

  static void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

  /// As flexrf-boot-choice does it.
  void choose(const std::vector<std::string>& words) const {
    boot::FolderMedium medium;
    CHECK(medium.open(files.choice, seconds{1}));
    CHECK(boot::perform(words, medium, read_running(files)).exit == boot::Exit::done);
  }
  bool says(const std::string& line) const {
    boot::FolderMedium medium;
    CHECK(medium.open(files.choice, seconds{1}));
    return boot::perform({"status"}, medium, {}).answer.find(line + '\n') != std::string::npos;
  }
  void boots(const std::string& slot, const std::string& why) const {
    write(files.command_line,
          "quiet rauc.slot=" + slot + " flexrf.boot=" + why + " flexrf.trial=0000000001\n");
  }
  void claim() const { has_users("anna:admin"); }
  /// Lines NAME:ROLE, all with the same password.
  void has_users(const std::string& line, const std::string& other = "") const {
    std::string text = line + ':' + hash_of_right_password() + '\n';
    if (!other.empty()) text += other + ':' + hash_of_right_password() + '\n';
    write(files.users, text);
    fs::permissions(files.users, fs::perms::owner_read | fs::perms::owner_write);
  }
  std::string motion() const { return text_of_file(files.word); }
  std::string bundle() const { return bundle_of(files.update); }
  bool has(const std::string& file) const { return fs::exists(file); }
  /// As a unit of its own leaves it.
  void result(Job job, const std::string& lines) const {
    write(files.update.results + '/' + name_of(job), lines);
  }
  /// All is well, the cell stands, and this version is confirmed.
  void is_ready() {
    claim();
    choose({"confirm", "A"});
    panel.may_move = false;
  }
  void has_verified_bundle(const std::string& built = "2000") const {
    write(bundle(), "bundle");
    result(Job::verify,
           "state=done\npercent=100\napplication=pick-station\nversion=new\nbuilt=" + built + "\n");
  }

  Helper helper() { return {files, {}, surroundings, word, now}; }
  /// A look a second.
  void run(Helper& helper, int looks) {
    for (int i = 0; i < looks; ++i) {
      helper.look(now);
      now += seconds{1};
    }
  }
  Verbs verbs() {
    return {files, surroundings, word, [this] { return now; }};
  }
  /// As often as the words were given to systemctl.
  int asked_systemd(const std::string& words) const {
    int count = 0;
    for (const std::string& one : systemd) count += one == words ? 1 : 0;
    return count;
  }

 private:
  std::string path_;

 public:
  Files files;
  PanelAnswer panel{"", true, true};
  std::uint64_t free = std::uint64_t{10} << 30;
  std::vector<Interface> interfaces{{"enp0s2", "52:54:00:12:34:56", true, {"10.0.2.15/24"}},
                                    {"enp0s3", "52:54:00:12:34:57", false, {"192.168.7.1/24"}}};
  std::string systemd_failure;
  std::vector<std::string> systemd;
  std::string word_at_systemd;  ///< as it stood when systemd was asked last
  std::vector<std::string> said;
  Time now{seconds{100}};
  Surroundings surroundings;
  MotionWord word;

 private:
  static std::string new_folder() {
    char name[] = "/tmp/flexrf-helper-XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    return name;
  }
  std::string systemctl(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& one : words) line.append(line.empty() ? "" : " ").append(one);
    systemd.push_back(line);
    word_at_systemd = motion();
    return systemd_failure;
  }
};

}  // namespace flexrf::helper
