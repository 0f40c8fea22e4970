// What every application's command line has beside the options of drivers: of the executive and of the panel.
// config-gen knows nothing of them, so a test compares these with theirs.
#pragma once

#include <array>
#include <string_view>

namespace flexrf::config_gen {

constexpr std::array<std::string_view, 24> own_options = {"--audit",
                                                          "--config",
                                                          "--descriptor",
                                                          "--digest",
                                                          "--drivers",
                                                          "--hardware",
                                                          "--help",
                                                          "--helper",
                                                          "--insecure-http",
                                                          "--motion-permit",
                                                          "--no-autostart",
                                                          "--no-realtime",
                                                          "--panel",
                                                          "--panel-edit-timeout",
                                                          "--panel-host",
                                                          "--panel-hosts",
                                                          "--panel-users",
                                                          "--report",
                                                          "--seed",
                                                          "--standstill-limit",
                                                          "--tls-certificate",
                                                          "--tls-key",
                                                          "--version",
                                                          "--virtual-time"};

}  // namespace flexrf::config_gen
