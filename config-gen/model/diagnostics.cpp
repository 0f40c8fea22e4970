#include "config-gen/model/diagnostics.hpp"

#include <algorithm>
#include <map>
#include <ostream>
#include <set>
#include <tuple>

namespace flexrf::config_gen {
namespace {

// "tracks[3]" and "tracks[4]" are alike: what is wrong with all instances is said once.
std::string without_numbers(const std::string& text) {
  std::string plain;
  bool inside = false;
  for (const char c : text) {
    if (c == ']') inside = false;
    if (!inside || c < '0' || c > '9') plain += c;
    if (c == '[') inside = true;
  }
  return plain;
}

}  // namespace

std::string_view intern(std::string_view file) {
  static std::set<std::string, std::less<>> names;
  const auto found = names.find(file);
  return found != names.end() ? std::string_view(*found) : std::string_view(*names.emplace(file).first);
}

std::string to_string(const Position& position) {
  std::string text(position.file);
  if (position.line > 0) text += ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
  return text;
}

void Diagnostics::error(const Position& position, std::string text, std::string hint) {
  add(Severity::error, position, std::move(text), std::move(hint));
}

void Diagnostics::warning(const Position& position, std::string text, std::string hint) {
  add(Severity::warning, position, std::move(text), std::move(hint));
}

void Diagnostics::add(Severity severity, const Position& position, std::string text, std::string hint) {
  Diagnostic diagnostic{severity, position, std::move(text), std::move(hint), {}, {}};
  if (!instances_.empty()) {
    diagnostic.instance = instances_.back().name;
    diagnostic.instantiated = instances_.back().position;
  }
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::enter(std::string instance, const Position& instantiated) {
  instances_.push_back({std::move(instance), instantiated});
}

void Diagnostics::leave() {
  instances_.pop_back();
}

bool Diagnostics::failed() const {
  return std::any_of(all_.begin(), all_.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::error; });
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<Diagnostic> kept;
  std::map<std::tuple<Position, Severity, std::string>, std::pair<std::size_t, std::set<std::string>>> seen;
  for (const Diagnostic& diagnostic : all_) {
    const auto [place, is_new] =
        seen.try_emplace({diagnostic.position, diagnostic.severity, without_numbers(diagnostic.text)},
                         kept.size(), std::set<std::string>{});
    place->second.second.insert(diagnostic.instance + '\n' + diagnostic.text);
    if (is_new) kept.push_back(diagnostic);
  }
  for (const auto& [key, place] : seen) {
    const std::size_t more = place.second.size() - 1;
    if (more > 0) kept[place.first].text += " (and " + std::to_string(more) + " more like it)";
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.position, a.severity) < std::tie(b.position, b.severity);
  });
  return kept;
}

void Diagnostics::print(std::ostream& out) const {
  for (const Diagnostic& diagnostic : sorted()) {
    const std::string place = to_string(diagnostic.position);
    out << place << (diagnostic.severity == Severity::error ? ": error: " : ": warning: ") << diagnostic.text
        << '\n';
    if (!diagnostic.hint.empty()) out << place << ": hint: " << diagnostic.hint << '\n';
    if (!diagnostic.instance.empty())
      out << to_string(diagnostic.instantiated) << ": note: in group instance '" << diagnostic.instance
          << "', which this row makes\n";
  }
}

}  // namespace flexrf::config_gen
