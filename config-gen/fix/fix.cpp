#include "config-gen/fix/fix.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>

#include "config-gen/fix/name_counts.hpp"
#include "config-gen/fix/replace_file.hpp"
#include "config-gen/fix/word_place.hpp"
#include "config-gen/model/file_contents.hpp"
#include "config-gen/model/source_text.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/csv.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

// Each shows what the one before hid: a type, then its ports, then their slots.
constexpr int most_rounds = 32;

struct Edit {
  std::size_t at = 0;     // byte of the word in the file as it was
  std::size_t token = 0;  // and of the key, text or cell that it is in
  std::string found;
  std::string wanted;
  int round = 0;
};

// A file as it was, and the words that are replaced in it, in order.
class EditedFile {
 public:
  EditedFile(std::string_view name, SourceKind kind)
      : name_(name), kind_(kind), original_(contents_of(name)) {}

  std::string_view name() const { return name_; }
  SourceKind kind() const { return kind_; }
  const std::string& original() const { return original_; }
  const std::vector<Edit>& edits() const { return edits_; }

  // With the edits before this round.
  std::string text(int before) const {
    std::string text;
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
      if (edit.round >= before) continue;
      text.append(original_, at, edit.at - at).append(edit.wanted);
      at = edit.at + edit.found.size();
    }
    return text.append(original_, at);
  }

  // Where the byte of text(before) was; nothing within a word that has been replaced.
  std::optional<std::size_t> before_edits(std::size_t byte, int before) const {
    for (const Edit& edit : edits_) {
      if (edit.round >= before) continue;
      if (byte < edit.at) break;
      if (byte < edit.at + edit.wanted.size()) return std::nullopt;
      byte = byte - edit.wanted.size() + edit.found.size();
    }
    return byte;
  }

  // And where the byte of the file as it was is in text(before).
  std::size_t after_edits(std::size_t byte, int before) const {
    std::size_t after = byte;
    for (const Edit& edit : edits_)
      if (edit.round < before && edit.at < byte) after = after - edit.found.size() + edit.wanted.size();
    return after;
  }

  const Edit* find(std::size_t at) const {
    const auto found =
        std::find_if(edits_.begin(), edits_.end(), [at](const Edit& edit) { return edit.at == at; });
    return found != edits_.end() ? &*found : nullptr;
  }

  void add(Edit edit) {
    const auto next =
        std::find_if(edits_.begin(), edits_.end(), [&edit](const Edit& other) { return other.at > edit.at; });
    edits_.insert(next, std::move(edit));
  }

  void remove(std::size_t at) {
    std::erase_if(edits_, [at](const Edit& edit) { return edit.at == at; });
  }

 private:
  std::string_view name_;
  SourceKind kind_;
  std::string original_;
  std::vector<Edit> edits_;
};

// "cell.toml:7:1" in a hint, and not the beginning of "cell.toml:7:12".
bool cites(const std::string& hint, const std::string& place) {
  for (std::size_t at = hint.find(place); at != std::string::npos; at = hint.find(place, at + 1)) {
    const std::size_t end = at + place.size();
    if (end == hint.size() || hint[end] < '0' || hint[end] > '9') return true;
  }
  return false;
}

bool can_be_done(const Diagnostic& diagnostic) {
  return diagnostic.severity == Severity::error && diagnostic.replacement &&
         diagnostic.replacement->doubt.empty();
}

std::string change_text(const std::string& found, const std::string& wanted) {
  return quote(found) + " -> " + quote(wanted);
}

class Fixer {
 public:
  Fixer(const FixSettings& settings, const Examine& examine, std::ostream& out)
      : settings_(settings), examine_(examine), out_(out) {}

  bool run() {
    bool good = false;
    {
      Examined examined = examine_();
      Diagnostics& found = examined.diagnostics;
      if (settings_.dry_run) good = !found.failed();
      std::optional<TriedTexts> tried;
      for (round_ = 1; round_ <= most_rounds && replace_words(examined); ++round_) {
        tried.reset();
        examined = examine_with(tried);
        while (take_back(found)) examined = examine_with(tried);
        said_ = texts_of(found);
      }
      if (settings_.dry_run) {
        show_changes();
        tell_what_is_left(found);
        return good;
      }
    }
    const bool written = write_files();
    const Diagnostics left = examine_().diagnostics;
    tell_what_is_left(left);
    return written && !left.failed();
  }

 private:
  Examined examine_with(std::optional<TriedTexts>& tried) {
    tried.emplace();
    for (const auto& [name, file] : files_) tried->set(name, file.text(round_ + 1));
    return examine_();
  }

  // Without " (and 2 more like it)".
  static std::string text_of(const Diagnostic& one) { return one.text.substr(0, one.text.find(" (and ")); }

  static std::set<std::string> texts_of(const Diagnostics& diagnostics) {
    std::set<std::string> texts;
    for (const Diagnostic& one : diagnostics.sorted()) texts.insert(text_of(one));
    return texts;
  }

  // ---- A round

  // Replaces what can be, in what was read in the round before; false when that is nothing.
  bool replace_words(const Examined& examined) {
    const Diagnostics& found = examined.diagnostics;
    if (round_ == 1) said_ = texts_of(found);
    note_outvoted(examined);
    bool changed = false;
    for (const Diagnostic& one : found.sorted())
      if (can_be_done(one) && replace_word(one)) changed = true;
    return changed;
  }

  // Where more places have the one name than have the declared one that is meant, it may be the declaration
  // that is misspelt. A word alone outvotes nothing.
  void note_outvoted(const Examined& examined) {
    const std::vector<Diagnostic> said = examined.diagnostics.sorted();
    if (std::none_of(said.begin(), said.end(), can_be_done)) return;
    const NameCounts counts = counts_in(examined.files);
    for (const Diagnostic& one : said) {
      if (!can_be_done(one)) continue;
      for (const auto& part : differing_parts(one.replacement->found, one.replacement->wanted)) {
        const NameCount& found = counts.of(part.first);
        const NameCount& wanted = counts.of(part.second);
        if (!wanted.declared_at || found.references < 2 || wanted.references >= found.references) continue;
        outvoted_.emplace(part, "it stands so in " + std::to_string(found.references) + " places, and " +
                                    quote(part.second) + " in " + std::to_string(wanted.references) +
                                    " beside its declaration at " + to_string(wanted.declared_at) +
                                    ", which may be what is misspelt");
      }
    }
  }

  NameCounts counts_in(const std::vector<fs::path>& files) const {
    NameCounts counts;
    std::set<fs::path> counted;
    for (const fs::path& path : files) {
      if (!counted.insert(fs::weakly_canonical(path)).second) continue;
      const std::string name = path.generic_string();
      const auto edited = files_.find(name);
      const std::string text = edited != files_.end() ? edited->second.text(round_) : contents_of(path);
      Diagnostics unused;
      try {
        if (path.extension() == ".toml") {
          if (const auto table = parse_text(text, path, unused)) counts.add(*table);
        } else if (path.extension() == ".csv") {
          if (const auto list = parse_csv(text, path, unused)) counts.add(*list);
        }
      } catch (const GivenUp&) {
        // A list with a thousand errors.
      }
    }
    return counts;
  }

  // Why the replacement is not made; null: nothing is against it.
  const std::string* outvoted(const Replacement& replacement) const {
    for (const auto& part : differing_parts(replacement.found, replacement.wanted))
      if (const auto found = outvoted_.find(part); found != outvoted_.end()) return &found->second;
    return nullptr;
  }

  bool replace_word(const Diagnostic& one) {
    const Replacement& replacement = *one.replacement;
    if (!obstacle_of(one.position.file).empty()) return false;
    EditedFile& file = *file_at(one.position.file);
    const std::string text = file.text(round_);
    const auto place = find_word(text, one.position, replacement, file.kind());
    if (!place) return false;
    const auto at = file.before_edits(place->begin, round_);
    const auto token = file.before_edits(place->token, round_);
    if (!at || !token || reasons_.contains({file.name(), *at})) return false;
    if (const std::string* const why = outvoted(replacement); why != nullptr) {
      reasons_.emplace(std::pair(file.name(), *at), *why);
      return false;
    }
    if (const Edit* const known = file.find(*at)) {
      if (known->wanted != replacement.wanted)
        refuse(file, *at, "it could mean " + quote(known->wanted) + ", too");
      return false;
    }
    file.add({*at, *token, replacement.found, replacement.wanted, round_});
    if (const std::string reason = damage_of(file); !reason.empty()) {
      refuse(file, *at, reason);
      return false;
    }
    return true;
  }

  // A key that is there already is one that the file cannot have twice.
  std::string damage_of(const EditedFile& file) const {
    const std::set<std::string> known = texts_of(parsed(file.original(), file));
    for (const Diagnostic& one : parsed(file.text(round_ + 1), file).sorted())
      if (!known.contains(text_of(one))) return "then " + text_of(one);
    return "";
  }

  static Diagnostics parsed(const std::string& text, const EditedFile& file) {
    Diagnostics diagnostics;
    try {
      if (file.kind() == SourceKind::table)
        parse_text(text, file.name(), diagnostics);
      else
        parse_csv(text, file.name(), diagnostics);
    } catch (const GivenUp&) {
      // They are in `diagnostics`.
    }
    return diagnostics;
  }

  void refuse(EditedFile& file, std::size_t at, std::string reason) {
    file.remove(at);
    reasons_.emplace(std::pair(file.name(), at), std::move(reason));
  }

  // What this round made worse goes back: a new error of the word itself, but for one that the next round
  // mends.
  bool take_back(const Diagnostics& found) {
    bool changed = false;
    for (const Diagnostic& one : found.sorted()) {
      if (one.severity != Severity::error || said_.contains(text_of(one)) || can_be_done(one)) continue;
      for (auto& [name, file] : files_) {
        for (const Edit& edit : std::vector<Edit>(file.edits())) {
          if (edit.round != round_ || !is_about(one, file, edit)) continue;
          refuse(file, edit.at, "then " + text_of(one));
          changed = true;
        }
      }
    }
    return changed;
  }

  bool is_about(const Diagnostic& one, const EditedFile& file, const Edit& edit) const {
    const Position place =
        place_of(file.text(round_ + 1), file.after_edits(edit.token, round_ + 1), file.name(), file.kind());
    return one.position == place || cites(one.hint, to_string(place)) ||
           one.text.find(quote(edit.wanted)) != std::string::npos;
  }

  // ---- Files

  EditedFile* file_at(std::string_view name) {
    const auto known = files_.find(name);
    if (known != files_.end()) return &known->second;
    const bool list = fs::path(name).extension() == ".csv";
    return &files_.try_emplace(std::string(name), name, list ? SourceKind::list : SourceKind::table)
                .first->second;
  }

  // Why the file stays as it is; empty: it need not.
  const std::string& obstacle_of(std::string_view name) {
    const auto known = obstacles_.find(name);
    if (known != obstacles_.end()) return known->second;
    return obstacles_.emplace(name, find_obstacle(fs::path(name))).first->second;
  }

  std::string find_obstacle(const fs::path& file) const {
    if (file.extension() != ".toml" && file.extension() != ".csv")
      return "only tables (.toml) and lists (.csv) are changed";
    if (std::none_of(settings_.folders.begin(), settings_.folders.end(),
                     [&file](const fs::path& folder) { return lies_in(file, folder); }))
      return "the file lies outside of the folders that may be changed";
    return obstacle_to_replacing(file);
  }

  // By its name: where a link in there leads is for whoever put it there.
  static bool lies_in(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path place = fs::weakly_canonical(file.has_parent_path() ? file.parent_path() : ".", error);
    const fs::path root = fs::weakly_canonical(folder, error);
    const auto [end, rest] = std::mismatch(root.begin(), root.end(), place.begin(), place.end());
    return !error && end == root.end();
  }

  // ---- What is told

  void show_changes(const EditedFile& file) const {
    for (const Edit& edit : file.edits()) {
      const Position place = place_of(file.original(), edit.token, file.name(), file.kind());
      out_ << to_string(place) << ": " << change_text(edit.found, edit.wanted) << '\n';
    }
  }

  void show_changes() const {
    std::size_t words = 0;
    for (const auto& [name, file] : files_) {
      show_changes(file);
      words += file.edits().size();
    }
    if (words > 0) out_ << "config-gen: nothing is written: this was a dry run\n";
  }

  // Each file by itself, so that what can be mended is; false when one could not be.
  bool write_files() {
    bool good = true;
    for (auto& [name, file] : files_) {
      if (file.edits().empty()) continue;
      const std::string obstacle = replace_file(name, file.original(), file.text(round_ + 1));
      if (obstacle.empty()) {
        show_changes(file);
        continue;
      }
      good = false;
      out_ << on_one_line(name) << ": error: none of its " << file.edits().size()
           << " changes is made: " << obstacle << '\n';
      obstacles_[name] = obstacle;
      for (const Edit& edit : std::vector<Edit>(file.edits())) file.remove(edit.at);
    }
    return good;
  }

  void tell_what_is_left(const Diagnostics& left) {
    left.print(out_);
    for (const Diagnostic& one : left.sorted()) {
      if (one.severity != Severity::error || !one.replacement) continue;
      out_ << to_string(one.position)
           << ": left alone: " << change_text(one.replacement->found, one.replacement->wanted) << ": "
           << on_one_line(reason_of(one)) << '\n';
    }
  }

  std::string reason_of(const Diagnostic& one) {
    if (!one.replacement->doubt.empty()) return one.replacement->doubt;
    if (const std::string& obstacle = obstacle_of(one.position.file); !obstacle.empty()) return obstacle;
    const EditedFile& file = *file_at(one.position.file);
    const auto place = find_word(file.text(round_ + 1), one.position, *one.replacement, file.kind());
    if (!place) return "the word does not stand there as it is";
    const auto at = file.before_edits(place->begin, round_ + 1);
    if (!at) return "this word has been replaced once";
    const auto reason = reasons_.find({file.name(), *at});
    return reason != reasons_.end() ? reason->second : "run it again";
  }

  const FixSettings& settings_;
  const Examine& examine_;
  std::ostream& out_;
  int round_ = 1;
  std::set<std::string> said_;  // before this round
  std::map<std::string, EditedFile, std::less<>> files_;
  std::map<std::string, std::string, std::less<>> obstacles_;
  std::map<std::pair<std::string, std::string>, std::string> outvoted_;  // parts found and wanted, and why
  std::map<std::pair<std::string_view, std::size_t>, std::string>
      reasons_;  // of words that stay, by file and byte
};

}  // namespace

bool fix(const FixSettings& settings, const Examine& examine, std::ostream& out) {
  return Fixer(settings, examine, out).run();
}

}  // namespace flexrf::config_gen
