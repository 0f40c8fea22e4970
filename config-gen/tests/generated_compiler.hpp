// C++ that config-gen makes, before a compiler. Classes that an author writes are made up, for their own text
// is not what is judged.
#pragma once

#include <filesystem>
#include <string>

#include "config-gen/tests/mutation_judge.hpp"

namespace flexrf::config_gen::tests {

// FlexRF's own tables stay as they are, for the runtime's C++ is written for them.
bool is_own(const TableTree& tree, const std::filesystem::path& file);

class GeneratedCompiler {
 public:
  struct Places {
    std::string compiler;
    std::string repository;
    std::string eigen;
  };

  // Makes the library's types. The tree outlives the object, and what is made lies in it.
  GeneratedCompiler(const TableTree& tree, Places places);

  // What is included by all is read once: worth it for more than a few.
  void precompile();
  // Everything that is generated for the application and what it uses, as one source.
  bool accepts(const Judgement& judgement, const Cell& cell);
  std::string messages() const;

 private:
  std::string make(const Model& model, const Target& target, const std::filesystem::path& folder,
                   const std::string& but = "-") const;
  void make_types(const std::filesystem::path& types) const;
  std::string make_sources(const Judgement& judgement, const Cell& cell) const;
  bool run(const std::string& arguments) const;

  const TableTree& tree_;
  Places places_;
  std::filesystem::path folder_;
};

}  // namespace flexrf::config_gen::tests
