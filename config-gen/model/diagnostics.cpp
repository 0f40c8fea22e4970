#include "config-gen/model/diagnostics.hpp"

#include <algorithm>
#include <ostream>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

// "tracks[3]" and "tracks[4]" are alike, and so are "[device.door]" and "[device.lamp]", which have a place
// in common where it is a column of their list.
std::string without_brackets(const std::string& text) {
  std::string plain;
  bool inside = false;
  for (const char c : text) {
    if (c == ']') inside = false;
    if (!inside) plain += c;
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
  std::string text = on_one_line(position.file);
  if (position.line > 0) text += ":" + std::to_string(position.line) + ":" + std::to_string(position.column);
  return text;
}

void Diagnostics::error(const Position& position, std::string text, Hint hint) {
  add(Severity::error, position, std::move(text), std::move(hint));
}

void Diagnostics::warning(const Position& position, std::string text, Hint hint) {
  add(Severity::warning, position, std::move(text), std::move(hint));
}

void Diagnostics::give_up(const Position& position, std::string text, Hint hint) {
  add(Severity::error, position, std::move(text), std::move(hint));
  gave_up_ = true;
  throw GivenUp{};
}

void Diagnostics::add(Severity severity, const Position& position, std::string text, Hint hint) {
  Count& count = counts_[static_cast<std::size_t>(severity)];
  if (count.different >= max_errors || count.all >= max_errors_alike) {
    // Warnings change nothing, and the tables may be good.
    if (severity == Severity::error) {
      gave_up_ = true;
      throw GivenUp{};
    }
    ++count.left_out;
    return;
  }
  ++count.all;
  Diagnostic diagnostic{
      severity, position, std::move(text), std::move(hint.text), {}, {}, std::move(hint.replacement)};
  if (!instances_.empty()) {
    diagnostic.instance = instances_.back().name;
    diagnostic.instantiated = instances_.back().position;
  }
  const auto [alike, is_new] =
      alike_.try_emplace(Key{position, severity, without_brackets(diagnostic.text)}, Alike{all_.size(), {}});
  alike->second.messages.insert(diagnostic.instance + '\n' + diagnostic.text);
  if (!is_new) {
    // In another instance another word is the nearest: nobody knows which was meant.
    Diagnostic& first = all_[alike->second.first];
    if (first.replacement != diagnostic.replacement) first.replacement.reset();
    return;
  }
  ++count.different;
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
  std::vector<Diagnostic> kept = all_;
  for (const auto& [key, alike] : alike_) {
    const std::size_t more = alike.messages.size() - 1;
    if (more > 0) kept[alike.first].text += " (and " + std::to_string(more) + " more like it)";
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.position, a.severity) < std::tie(b.position, b.severity);
  });
  return kept;
}

void Diagnostics::print(std::ostream& out) const {
  std::vector<Diagnostic> shown = sorted();
  const std::size_t found = shown.size() + counts_[static_cast<std::size_t>(Severity::warning)].left_out;
  if (shown.size() > max_messages_shown) {
    std::stable_partition(shown.begin(), shown.end(),
                          [](const Diagnostic& one) { return one.severity == Severity::error; });
    shown.resize(max_messages_shown);
  }
  for (const Diagnostic& diagnostic : shown) {
    const std::string place = to_string(diagnostic.position);
    out << place << (diagnostic.severity == Severity::error ? ": error: " : ": warning: ")
        << on_one_line(diagnostic.text) << '\n';
    if (!diagnostic.hint.empty()) out << place << ": hint: " << on_one_line(diagnostic.hint) << '\n';
    if (!diagnostic.instance.empty())
      out << to_string(diagnostic.instantiated) << ": note: in group instance '" << diagnostic.instance
          << "', which this row makes\n";
  }
  if (found > shown.size()) out << "config-gen: " << found - shown.size() << " more messages are not shown\n";
  if (gave_up_) out << "config-gen: what follows was not looked at: mend these first\n";
}

}  // namespace flexrf::config_gen
