// The tables that applications are made of: types, units, interfaces, drivers. Found by name in the search
// folders, read when first asked for, so that a run depends on no more files than it needs.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "config-gen/model/target.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {

class Library {
 public:
  Library(Model& model, SearchPaths paths, Diagnostics& diagnostics);

  // The place in the Model of what a table names, read on the way. An unknown name is reported at `place`; of
  // a broken table nothing more is said.
  std::optional<Index> type(const std::string& name, const Position& place);       // CamelCase
  std::optional<Index> unit(const std::string& name, const Position& place);       // folder's name
  std::optional<Index> interface(const std::string& name, const Position& place);  // CamelCase
  std::optional<Index> driver(Index interface, const std::string& name, const Position& place);

  // The same by file, for runs that generate one of them.
  void read_types(const std::filesystem::path& folder);
  std::optional<Index> read_unit(const std::filesystem::path& file);
  std::optional<Index> read_interface(const std::filesystem::path& file);
  std::optional<Index> read_driver(const std::filesystem::path& file);

  // Parses a file of which the run then depends.
  std::optional<Node> parse(const std::filesystem::path& file);

  // The namespace of what is made of this table.
  std::string_view space_of(const std::filesystem::path& file) const;
  // How a header beside this table is included: FlexRF's own from the root,
  // "hal/gripper/mock/mock_gripper.hpp"; others by their last two folders, "units/jog/jog.hpp".
  std::string include_path(const std::filesystem::path& file, const std::string& header);

  Model& model() { return model_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  struct Entry {
    std::filesystem::path file;
    bool reading = false;
    bool read = false;
    std::optional<Index> index;
  };
  using Entries = std::map<std::string, Entry, std::less<>>;

  // The folder of FlexRF's own tables in which this file lies, if any.
  const std::filesystem::path* library_with(const std::filesystem::path& file) const;
  void find_types();
  void find_tables(const std::vector<std::filesystem::path>& folders, Entries& entries,
                   const std::string& what, bool camel_case);
  void find_drivers();
  void add_entry(Entries& entries, const std::string& name, const std::filesystem::path& file,
                 const std::string& what);
  template <typename Read>
  std::optional<Index> get(Entries& entries, const std::string& name, const Position& place,
                           const std::string& what, const std::string& otherwise, Read read);

  Model& model_;
  SearchPaths paths_;
  Diagnostics& diagnostics_;
  Entries types_;
  Entries units_;
  Entries interfaces_;
  std::size_t depth_ = 0;  // types that are being read, each because of the one before
  struct DriverEntry {
    std::filesystem::path file;
    std::string interface;
    std::string name;
    Position position;
    std::optional<Index> index;
    bool read = false;
  };
  std::vector<DriverEntry> drivers_;
  bool drivers_found_ = false;
};

// One table each; nothing when it was too broken to be of use. Further errors do not hinder.
std::optional<Index> read_type_table(Library& library, const Node& root, const std::filesystem::path& file);
std::optional<Index> read_unit_table(Library& library, const Node& root, const std::filesystem::path& file);
std::optional<Index> read_interface_table(Library& library, const Node& root,
                                          const std::filesystem::path& file);
std::optional<Index> read_driver_table(Library& library, const Node& root, const std::filesystem::path& file);

// What fields and parameters share: type, shape, capacity, unit of measure, summary. `words` are further
// words allowed as type ("button"), given back in `word`. `choices` are the units of measure that a device's
// row chooses.
std::optional<Field> read_field(Library& library, Row& row, const std::vector<std::string>& words = {},
                                std::string* word = nullptr, const std::vector<UnitChoice>& choices = {});
// `before`: of a driver, its interface's parameters of this kind, beside which its own stand in one struct.
void read_parameters(Library& library, const Node& table, Parameter::Kind kind, ParameterBlock& block,
                     const std::vector<UnitChoice>& choices = {}, const ParameterBlock& before = {});
// Unit of measure and range of a number that is no parameter.
Parameter read_number(Library& library, Row& row);
// All of `[option.N]` under `table`, of a driver of this kind.
std::vector<DriverOption> read_driver_options(Library& library, const Node& table, Driver::Kind kind);
// All of `[input.N]`, of `[output.N]` under `table`, as far as they can be used; false when some cannot.
bool read_inputs(Library& library, const Node& table, std::vector<InputPort>& inputs);
bool read_outputs(Library& library, const Node& table, std::vector<OutputPort>& outputs);

// The rows under [kind.*], each with its name checked.
std::vector<const Node*> named_rows(Library& library, const Node& root, std::string_view kind,
                                    std::string_view what);

}  // namespace flexrf::config_gen
