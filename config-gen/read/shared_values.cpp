#include "config-gen/read/shared_values.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::array<const char*, 2> sharing_rows{"unit", "device"};
constexpr const char* values_section = "configuration";

// Null: it is a value itself.
const Node* reference_in(const Node& value) {
  const bool is_reference =
      value.kind == Node::Kind::table && value.children.size() == 1 && value.children[0].key == "as";
  return is_reference ? &value.children[0] : nullptr;
}

Node* find(Node* table, const std::string& key) {
  if (table == nullptr) return nullptr;
  const auto found = std::find_if(table->children.begin(), table->children.end(),
                                  [&](const Node& child) { return child.key == key; });
  return found == table->children.end() ? nullptr : &*found;
}

class Sharing {
 public:
  Sharing(Node& table, Diagnostics& diagnostics) : table_(table), diagnostics_(diagnostics) {}

  void run() {
    for (const char* const kind : sharing_rows) {
      Node* const rows = find(&table_, kind);
      if (rows == nullptr) continue;
      for (Node& row : rows->children) {
        Node* const values = find(&row, values_section);
        if (values == nullptr) continue;
        for (Node& value : values->children) take(value);
        std::erase_if(values->children, [](const Node& value) { return reference_in(value) != nullptr; });
      }
    }
  }

 private:
  // A reference that leads nowhere is reported, and stays.
  void take(Node& value) {
    const Node* const reference = reference_in(value);
    if (reference == nullptr) return;
    const std::string what = quote(std::string(values_section) + "." + value.key);
    if (reference->kind != Node::Kind::text)
      return tell(*reference, "'as' must be a text, not " + kind_text(reference->kind),
                  "write the row that has the value, as { as = \"unit.camera\" }");
    if (std::find(open_.begin(), open_.end(), &value) != open_.end())
      return tell(*reference, what + " is as that of " + quote(reference->text) + ", which is as this one",
                  "write the value in one of the rows");
    const std::size_t dot = reference->text.find('.');
    Node* const row = dot == std::string::npos ? nullptr
                                               : find(find(&table_, reference->text.substr(0, dot)),
                                                      reference->text.substr(dot + 1));
    if (row == nullptr || !is_kind(reference->text.substr(0, dot)))
      return tell(*reference, quote(reference->text) + " is no row of a unit or a device in this file",
                  suggest(reference->text, rows(), "rows", "there is none"));
    Node* const meant = find(find(row, values_section), value.key);
    if (meant == nullptr)
      return tell(*reference, "[" + reference->text + "] has no " + what,
                  "name the row in which it is written");
    open_.push_back(&value);
    take(*meant);
    open_.pop_back();
    if (reference_in(*meant) != nullptr) return;
    Node copy = *meant;
    copy.key_position = value.key_position;
    value = std::move(copy);
  }

  static bool is_kind(const std::string& word) {
    return std::find(sharing_rows.begin(), sharing_rows.end(), word) != sharing_rows.end();
  }

  std::vector<std::string> rows() const {
    std::vector<std::string> names;
    for (const char* const kind : sharing_rows)
      if (const Node* const all = table_.find(kind); all != nullptr)
        for (const Node& row : all->children) names.push_back(std::string(kind) + "." + row.key);
    return names;
  }

  void tell(const Node& reference, const std::string& message, Hint hint) {
    diagnostics_.error(reference.position, message, std::move(hint));
  }

  Node& table_;
  Diagnostics& diagnostics_;
  std::vector<const Node*> open_;  // references that are being followed
};

}  // namespace

void share_values(Node& table, Diagnostics& diagnostics) {
  Sharing(table, diagnostics).run();
}

}  // namespace flexrf::config_gen
