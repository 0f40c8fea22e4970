// The XML document of a configuration file: syntax, checksum, positions, formats. Private to
// runtime/parameters.
#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"

namespace flexrf {

/// The format that is written. A change of the format adds one to it, and a step to format_steps.
inline constexpr unsigned configuration_format = 1;

/// Turns a document of format `from` into one of format `from` + 1.
struct FormatStep {
  unsigned from;
  void (*upgrade)(pugi::xml_node root);
};

/// Brings the document to `target`; refuses one that is newer, or older than the oldest step.
Status upgrade_format(pugi::xml_node root, unsigned target, std::span<const FormatStep> steps);

/// Characters beside blanks, which no element may have around those in it.
bool is_stray_text(pugi::xml_node node);

class ConfigurationDocument {
 public:
  enum class Checksum : std::uint8_t { right, edited, wrong };

  /// Parses. False when the text is damaged: damage() says where and how, as "PATH:line:column: error: ...".
  bool parse(std::string path, std::string text);

  pugi::xml_node root() const { return document_.document_element(); }
  Checksum checksum() const { return checksum_; }
  const std::string& damage() const { return damage_; }
  /// "PATH:line:column: " of an element.
  std::string position_of(pugi::xml_node node) const;

 private:
  std::string position_at(std::ptrdiff_t offset) const;

  std::string path_;
  std::string text_;
  std::vector<std::size_t> line_starts_;  // offsets, ascending
  std::string damage_;
  Checksum checksum_ = Checksum::wrong;
  pugi::xml_document document_;
};

/// The text of a document with its checksum filled in. The root has an attribute checksum, whatever its
/// value.
std::string text_with_checksum(pugi::xml_document& document);

}  // namespace flexrf
