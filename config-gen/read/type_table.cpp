// Type tables: records and enumerations.
#include "config-gen/model/layout.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/members.hpp"

namespace flexrf::config_gen {
namespace {

void check_image(const Type& type, const Position& position, Diagnostics& diagnostics) {
  for (const char* name : {"width", "height", "format", "data"}) {
    bool found = false;
    for (const Field& field : type.fields) found = found || field.name == name;
    if (!found)
      diagnostics.error(position, "the image " + type.name + " has no field " + quote(name),
                        "an image has the fields 'width', 'height', 'format' and 'data'");
  }
}

bool read_resizable(Row& row, const Field& field, Diagnostics& diagnostics) {
  if (!row.boolean("resizable").value_or(false)) return false;
  if (field.type.kind == FieldType::Kind::scalar && field.type.scalar != Scalar::text &&
      field.shape.size() == 1)
    return true;
  diagnostics.error(row.position("resizable"), row.name() + " cannot be resizable: it is no row of scalars",
                    "give it a scalar type and shape = [N], its size where a slot's row says no other");
  return false;
}

}  // namespace

std::optional<Index> read_type_table(Library& library, const Node& root, const std::filesystem::path& file) {
  Diagnostics& diagnostics = library.diagnostics();
  Type type;
  type.stem = file.stem().string();
  type.name = camel_case(type.stem);
  type.file = file;
  type.space = library.space_of(file);
  type.position = root.position;
  if (!is_snake_case(type.stem)) {
    diagnostics.error(root.position, "the file's name " + quote(type.stem) + " is not a name for a type",
                      "name it in lower_snake_case, as key_event.toml, which declares KeyEvent");
    return std::nullopt;
  }

  check_class_name(type.name, root.position, camel_case(type.stem), diagnostics);
  Row row(root, "this type table", diagnostics);
  type.summary = row.summary();
  type.image = row.boolean("image").value_or(false);
  type.operated = row.boolean("operated").value_or(false);
  row.also("field");
  row.also("value");
  row.finish();

  for (const Node* node : named_rows(library, root, "field", "a field")) {
    Row field_row(*node, "[field." + node->key + "]", diagnostics);
    if (auto field = read_field(library, field_row)) {
      field->resizable = read_resizable(field_row, *field, diagnostics);
      type.fields.push_back(std::move(*field));
    } else {
      field_row.also("resizable");
    }
    field_row.finish();
  }
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    if (!type.fields[i].resizable || i + 1 == type.fields.size()) continue;
    diagnostics.error(type.fields[i].position,
                      quote(type.fields[i].name) + " is resizable, and fields follow it",
                      "a type has one such field, and it is the last: move its row to the end of the file");
    type.fields[i].resizable = false;
  }
  std::vector<const Field*> fields;
  for (const Field& field : type.fields) fields.push_back(&field);
  check_fields(fields, diagnostics);
  for (const Node* node : named_rows(library, root, "value", "a value")) {
    Row value_row(*node, "[value." + node->key + "]", diagnostics);
    type.values.push_back({node->key, node->key_position, value_row.summary()});
    value_row.finish();
  }
  if (root.find("field") != nullptr && root.find("value") != nullptr) {
    diagnostics.error(root.find("value")->position, type.name + " has fields and values",
                      "a type is either a record with fields or an enumeration with values: make two types");
    return std::nullopt;
  }
  if (root.find("field") == nullptr && root.find("value") == nullptr) {
    diagnostics.error(root.position, type.name + " has no fields and no values",
                      "add [field.NAME] rows for a record, or [value.NAME] rows for an enumeration");
    return std::nullopt;
  }
  if (type.values.size() > 256)
    diagnostics.error(type.values[256].position, type.name + " has more than 256 values",
                      "an enumeration is stored in one byte");
  if (!type.values.empty()) type.kind = Type::Kind::enumeration;
  if (type.image) check_image(type, row.position("image"), diagnostics);

  Model& model = library.model();
  lay_out(model, type);
  if (type.size > max_type_size || type.single_fields > max_type_fields) {
    diagnostics.error(root.position,
                      type.name + " takes " + size_text(type.size) + " in " +
                          std::to_string(type.single_fields) + " single fields",
                      "a type has at most " + size_text(max_type_size) + " and " +
                          std::to_string(max_type_fields) +
                          " single fields, those of each element of a record counted");
    return std::nullopt;
  }
  model.types.push_back(std::move(type));
  return model.types.size() - 1;
}

}  // namespace flexrf::config_gen
