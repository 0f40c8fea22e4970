// Where things are on a PC.
#pragma once

#include <string>

namespace flexrf::helper {

/// What an update is made of on the disk and in memory.
struct UpdateFiles {
  std::string folder = "/data/update";         ///< the bundle, and what stays of an update; root's alone
  std::string results = "/run/flexrf-update";  ///< what became of verifying and installing; gone at a restart
};

/// Of systemd-networkd, and what lies beside them.
struct NetworkFiles {
  std::string kept =
      "/data/network";  ///< a folder of what is used from the next boot on; root's alone to write
  std::string used = "/run/systemd/network";  ///< what is used now: at boot a copy of `kept`
};

/// For the application's --panel-hosts. Everybody may read it.
inline std::string file_of_hosts(const NetworkFiles& files) {
  return files.kept + "/panel-hosts";
}

struct Files {
  std::string word = "/run/flexrf-helper/motion";      ///< for --motion-permit
  std::string users = "/data/flexrf/panel-users";      ///< who may log in
  std::string choice = "/boot/efi/flexrf";             ///< the boot choice's folder
  std::string command_line = "/proc/cmdline";          ///< of the kernel
  std::string certificate = "/data/flexrf/panel.crt";  ///< the panel's
  std::string version = "/usr/lib/flexrf/version";     ///< what runs
  std::string notices = "/run/flexrf-notices";         ///< a folder with files of lines for a person
  UpdateFiles update;
  NetworkFiles network;
  std::string data = "/data";  ///< the partition for data, with the journal in its folder `journal`
  /// By which the journal names this boot.
  std::string boot_id = "/proc/sys/kernel/random/boot_id";
};

}  // namespace flexrf::helper
