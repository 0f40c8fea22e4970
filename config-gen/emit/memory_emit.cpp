// memory_map.txt: what config-gen laid out, against the budget.
#include <array>
#include <cstdio>
#include <map>

#include "config-gen/emit/emit.hpp"
#include "config-gen/emit/text.hpp"
#include "config-gen/model/memory.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

const char* kind_text(MemoryItem::Kind kind) {
  switch (kind) {
    case MemoryItem::Kind::slot:
      return "slots";
    case MemoryItem::Kind::history:
      return "histories";
    case MemoryItem::Kind::queue:
      return "queues";
    case MemoryItem::Kind::stack:
      return "stacks";
    case MemoryItem::Kind::helper:
      return "stacks of drivers' helper threads";
    case MemoryItem::Kind::parameters:
      return "parameters";
  }
  return "";
}

std::string line(std::size_t bytes, std::string_view name, std::string_view account) {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%12zu  ", bytes);
  std::string text = number.data() + std::string(name);
  if (!account.empty())
    text += std::string(name.size() < 32 ? 32 - name.size() : 1, ' ') + std::string(account);
  return text + "\n";
}

}  // namespace

std::string memory_map_text(const Model& model) {
  const std::vector<MemoryItem> items = memory_map(model);
  Text out;
  out << "Memory of " << model.application->name
      << " in bytes, as config-gen lays it out. Units and drivers are sized by\n"
      << "the compiler: `flexrf map` reads the final sizes from the executable.\n";
  std::map<MemoryItem::Kind, std::size_t> sums;
  for (const MemoryItem& item : items) sums[item.kind] += item.bytes;
  const MemoryItem* before = nullptr;
  for (const MemoryItem& item : items) {
    if (before == nullptr || before->kind != item.kind)
      out << "\n" << line(sums[item.kind], kind_text(item.kind), "");
    out << "  " << line(item.bytes, item.name, item.account);
    before = &item;
  }
  out << "\n" << line(total(items), "total", "");
  if (model.application->memory_budget) {
    out << line(*model.application->memory_budget, "memory_budget",
                size_text(*model.application->memory_budget));
  }
  out << "\nData types, bytes of one value\n";
  for (const Type& type : model.types) out << line(type.size, type.name, "");
  return out.take();
}

}  // namespace flexrf::config_gen
