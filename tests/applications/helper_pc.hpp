// An industrial PC's files in a folder, for flexrf-helper as a process.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "places.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole {

inline constexpr const char* right_password = "a long enough password";

/// One that nobody listens at.
inline std::string free_port() {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  CHECK(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  CHECK(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  close(descriptor);
  return std::to_string(ntohs(address.sin_port));
}

inline void make_certificate(const Folder& folder, const std::string& name) {
  CHECK_EQUAL(run(folder, {"openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                           "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", "/CN=" + name,
                           "-keyout", name + ".key", "-out", name + ".crt"})
                  .exit_code,
              0);
}

/// A disk whose slot A runs for the first time, a claimed PC, and the panel's certificate.
class Pc {
 public:
  Pc() {
    std::filesystem::create_directory(folder / "choice");
    CHECK_EQUAL(run(folder, {place::choice, "--folder", "choice", "create"}).exit_code, 0);
    write_file(folder / "cmdline", "rauc.slot=A flexrf.boot=only flexrf.trial=0000000001\n");
    make_certificate(folder, "panel");
    CHECK_EQUAL(run(folder, {place::password, "--user", "anna", "--role", "admin", "users"},
                    std::string{right_password} + '\n')
                    .exit_code,
                0);
    for (const char* const name : {"update", "results"}) std::filesystem::create_directory(folder / name);
    write_file(folder / "version", "application=keyboard\nversion=v1\nbuilt=1000\ndevelopment_key=no\n");
    // Systemd, which this test plays, starts nothing.
    write_file(folder / "systemctl", "#!/bin/sh\necho \"$*\" >>systemd-was-asked\n");
    std::filesystem::permissions(folder / "systemctl", std::filesystem::perms::owner_all);
  }

  std::vector<std::string> application() const {
    return {place::application,
            "--no-realtime",
            "--standstill-limit",
            "10min",
            "--no-autostart",
            "--motion-permit",
            "motion",
            "--panel",
            "127.0.0.1:" + port,
            "--panel-users",
            "users",
            "--tls-certificate",
            "panel.crt",
            "--tls-key",
            "panel.key"};
  }
  /// `peer`: the user that may ask, beside root.
  std::vector<std::string> helper(const std::string& healthy_for = "2",
                                  const std::string& peer = "root") const {
    return {place::helper,
            "--word",
            "motion",
            "--users",
            "users",
            "--folder",
            "choice",
            "--kernel-command-line",
            "cmdline",
            "--certificate",
            "panel.crt",
            "--port",
            port,
            "--healthy-for",
            healthy_for,
            "--socket",
            "socket",
            "--peer",
            peer,
            "--version-file",
            "version",
            "--notices",
            "notices",
            "--results",
            "results",
            "--update-folder",
            "update",
            "--data",
            "data",
            "--journalctl",
            folder / "journalctl",
            "--systemctl",
            folder / "systemctl"};
  }
  std::string word() const { return contents_of(folder / "motion"); }

  Folder folder;
  std::string port = free_port();
};

}  // namespace flexrf::whole
