// What an application's tables say to the panel beside its descriptor.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/time.hpp"

namespace flexrf {

/// A file that the application brings along: a custom widget, a robot's description, a mesh.
struct PanelFile {
  std::string_view path;  ///< "widgets/jog_arrows.js", "robots/arm.urdf", "robots/arm/meshes/link1.stl"
  std::string_view content_type;
  std::string_view bytes;  ///< live for ever
};

struct PanelRecord {
  static constexpr std::uint16_t default_connections = 32;
  static constexpr Duration default_session_timeout = std::chrono::hours{1};
  static constexpr Duration default_session_length = std::chrono::hours{8};

  std::uint16_t connections = default_connections;  ///< places, 4 to 256
  std::span<const char* const> local;  ///< numeric addresses whose sessions are local, beside loopback ones
  bool loopback_is_local = true;  ///< false: a tunnel or a proxy ends there, whose visitors are elsewhere
  Duration session_timeout = default_session_timeout;  ///< of a session that nobody uses
  Duration session_length = default_session_length;    ///< of one that somebody uses
  std::span<const PanelFile> files;
};

}  // namespace flexrf
