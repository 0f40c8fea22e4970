#include "runtime/parameters/configuration_document.hpp"

#include <algorithm>
#include <iterator>

#include "base/quantity_text.hpp"
#include "runtime/core/digest.hpp"

namespace flexrf {
namespace {

constexpr std::size_t checksum_digits = 16;
constexpr const char* no_checksum = "0000000000000000";

// Where the digits of the checksum stand in the text: they are left out of it. npos when there are none.
std::size_t find_checksum(std::string_view text, std::size_t root) {
  constexpr std::string_view attribute = " checksum=\"";
  const std::size_t end = text.find('>', root);
  const std::size_t found = text.find(attribute, root);
  if (end == std::string_view::npos || found == std::string_view::npos || found > end)
    return std::string_view::npos;
  const std::size_t digits = found + attribute.size();
  return text.find('"', digits) == digits + checksum_digits ? digits : std::string_view::npos;
}

std::string checksum_of(std::string text, std::size_t digits) {
  text.replace(digits, checksum_digits, no_checksum);
  Digest digest;
  digest.add_text(text);
  return hexadecimal_text(digest.value());
}

}  // namespace

Status upgrade_format(pugi::xml_node root, unsigned target, std::span<const FormatStep> steps) {
  pugi::xml_attribute format = root.attribute("format");
  // Written by hand: in the format that the documentation shows.
  if (!format) return {};
  unsigned at = format.as_uint();
  if (at > target)
    return Status::error(StatusCode::invalid_argument,
                         "format %u was written by a newer FlexRF; this one reads formats up to %u", at,
                         target);
  while (at < target) {
    const auto step =
        std::find_if(steps.begin(), steps.end(), [at](const FormatStep& it) { return it.from == at; });
    if (step == steps.end())
      return Status::error(StatusCode::invalid_argument,
                           "format '%s' is not known; this FlexRF writes format %u", format.value(), target);
    step->upgrade(root);
    ++at;
  }
  format.set_value(at);
  return {};
}

bool is_stray_text(pugi::xml_node node) {
  const bool is_text = node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
  return is_text && std::string_view(node.value()).find_first_not_of(" \t\r\n") != std::string_view::npos;
}

bool ConfigurationDocument::parse(std::string path, std::string text) {
  path_ = std::move(path);
  text_ = std::move(text);
  line_starts_ = {0};
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  const pugi::xml_parse_result result = document_.load_buffer(
      text_.data(), text_.size(),
      // A fragment's text outside of the document is kept, to be found.
      pugi::parse_default | pugi::parse_ws_pcdata_single | pugi::parse_fragment, pugi::encoding_utf8);
  if (!result) {
    damage_ = position_at(result.offset) + "error: damaged: " + result.description();
    return false;
  }
  if (!root()) {
    damage_ = position_at(0) + "error: damaged: there is no element in it";
    return false;
  }
  for (const pugi::xml_node node : document_.children()) {
    if (is_stray_text(node)) {
      damage_ = position_of(node) + "error: damaged: text outside of the outermost element";
      return false;
    }
    if (node.type() != pugi::node_element || node == root()) continue;
    damage_ = position_of(node) + "error: damaged: a second document begins here";
    return false;
  }
  const std::string_view given = root().attribute("checksum").value();
  if (given.empty() || given == "edited") {
    checksum_ = Checksum::edited;
    return true;
  }
  const std::size_t digits = find_checksum(text_, static_cast<std::size_t>(root().offset_debug()));
  if (digits != std::string::npos && given == checksum_of(text_, digits)) {
    checksum_ = Checksum::right;
    return true;
  }
  damage_ = position_of(root()) +
            "error: damaged, or edited by hand: the checksum does not match. If you edited it, write "
            "checksum=\"edited\"";
  return false;
}

std::string ConfigurationDocument::position_of(pugi::xml_node node) const {
  // The offset is the name's; the element begins one before, with its "<".
  return position_at(node.offset_debug() - 1);
}

std::string ConfigurationDocument::position_at(std::ptrdiff_t offset) const {
  const auto at = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size())));
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
  const std::size_t column = 1 + at - *std::prev(after);
  return path_ + ":" + std::to_string(after - line_starts_.begin()) + ":" + std::to_string(column) + ": ";
}

std::string text_with_checksum(pugi::xml_document& document) {
  class Writer : public pugi::xml_writer {
   public:
    void write(const void* data, std::size_t size) override {
      text.append(static_cast<const char*>(data), size);
    }
    std::string text;
  } writer;
  document.document_element().attribute("checksum").set_value(no_checksum);
  document.save(writer, "  ", pugi::format_default, pugi::encoding_utf8);
  const std::size_t root = writer.text.find(std::string("<") + document.document_element().name() + " ");
  const std::size_t digits = find_checksum(writer.text, root);
  writer.text.replace(digits, checksum_digits, checksum_of(writer.text, digits));
  return std::move(writer.text);
}

}  // namespace flexrf
