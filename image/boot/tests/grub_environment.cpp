#include "image/boot/tests/grub_environment.hpp"

#include <cstddef>

namespace flexrf::boot {
namespace {

const std::string first_line = "# GRUB Environment Block\n";

// Where the line ends that goes on at `place`; an escaped line feed is none. The block's size if it does not
// end.
std::size_t line_end(const std::string& block, std::size_t place) {
  while (place < block.size() && block[place] != '\n') place += block[place] == '\\' ? 2 : 1;
  return place;
}

std::string escaped(const std::string& value) {
  std::string text;
  for (const char character : value) {
    if (character == '\\' || character == '\n') text += '\\';
    text += character;
  }
  return text;
}

std::string unescaped(const std::string& text) {
  std::string value;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    if (i < text.size()) value += text[i];
  }
  return value;
}

}  // namespace

std::optional<std::map<std::string, std::string>> grub_variables(const std::string& block) {
  if (block.compare(0, first_line.size(), first_line) != 0) return std::nullopt;
  std::map<std::string, std::string> variables;
  std::size_t place = first_line.size();
  while (place < block.size()) {
    if (block[place] == '#') {
      place = line_end(block, place) + 1;
      continue;
    }
    const std::size_t equals = block.find('=', place);
    if (equals == std::string::npos) break;
    const std::size_t end = line_end(block, equals + 1);
    if (end >= block.size()) break;
    variables[block.substr(place, equals - place)] = unescaped(block.substr(equals + 1, end - equals - 1));
    place = end + 1;
  }
  return variables;
}

bool grub_set(std::string& block, const std::string& name, const std::string& value) {
  const std::size_t text_end = block.find_last_not_of('#');
  if (text_end == std::string::npos || block[text_end] != '\n') return false;
  const std::size_t size = block.size();
  std::string text = block.substr(0, text_end + 1);
  const std::string line = name + '=' + escaped(value) + '\n';
  std::size_t place = first_line.size();
  while (place < text.size() && text.compare(place, name.size() + 1, name + '=') != 0)
    place = line_end(text, place) + 1;
  if (place < text.size())
    text.replace(place, line_end(text, place) + 1 - place, line);
  else
    text += line;
  if (text.size() > size) return false;
  block = text + std::string(size - text.size(), '#');
  return true;
}

}  // namespace flexrf::boot
