// The target of a request line, and what lists in header fields say.
#pragma once

#include <optional>
#include <string_view>

namespace flexrf::panel {

struct RequestTarget {
  std::string_view path;   ///< percent-decoded, in `memory`
  std::string_view query;  ///< as sent, without '?'
};

/// `memory` has room for as many bytes as the target. Nothing: it is not in origin form (RFC 9112), has a
/// wrong escape, a control character or a backslash, or a segment "." or "..".
std::optional<RequestTarget> decode_target(std::string_view target, char* memory) noexcept;

/// An Accept-Encoding that permits gzip.
bool accepts_gzip(std::string_view accept_encoding) noexcept;
/// A media type is `type`, whatever its parameters.
bool is_media_type(std::string_view content_type, std::string_view type) noexcept;
/// A list of names parted by commas has this one.
bool list_has(std::string_view list, std::string_view name) noexcept;
/// An If-None-Match or If-Match field names this entity tag (weak comparison; "*" names every one).
bool names_tag(std::string_view field, std::string_view tag) noexcept;

}  // namespace flexrf::panel
