// A component as config-gen would declare it, with a parameter of every kind, for the tests of this folder.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/unit/component.hpp"

namespace flexrf::sample {

enum class Mode : std::uint8_t { off, manual, automatic };

struct Limits {
  double low;
  float high;
};

struct Configuration {
  double length;
  std::int32_t rows;
  char title[16];
  double rotation[6];  // two rows, three columns
  Limits limits[2];
};

struct Runtime {
  double step;
  float gains[3];
  std::uint8_t mode;
  bool enabled;
  std::uint32_t go;
  bool jog[2];
  std::int8_t small;
  std::uint64_t large;
  double scratch;
  Limits limits;
};

inline constexpr EnumerationValue mode_values[] = {{"off", ""}, {"manual", ""}, {"automatic", ""}};
inline constexpr TypeDescriptor mode_type{"Mode", "", 1, 1, 1, {}, {}, mode_values, false};

inline constexpr FieldDescriptor limits_fields[] = {
    {"low", Scalar::f64, 0, {}, 1, offsetof(Limits, low), "m", "", nullptr},
    {"high", Scalar::f32, 0, {}, 1, offsetof(Limits, high), "m", "", nullptr},
};
inline constexpr ByteRange limits_bytes[] = {{0, 12}};
inline constexpr TypeDescriptor limits_type{
    "Limits", "", sizeof(Limits), alignof(Limits), 2, limits_fields, limits_bytes, {}, false};

inline constexpr FieldDescriptor configuration_fields[] = {
    {"length", Scalar::f64, 0, {}, 1, offsetof(Configuration, length), "m", "How long.", nullptr},
    {"rows", Scalar::i32, 0, {}, 1, offsetof(Configuration, rows), "1", "How many.", nullptr},
    {"title", Scalar::text, 0, {}, 16, offsetof(Configuration, title), "", "", nullptr},
    {"rotation", Scalar::f64, 2, {2, 3}, 6, offsetof(Configuration, rotation), "rad", "", nullptr},
    {"limits", Scalar::structure, 1, {2}, 2, offsetof(Configuration, limits), "", "", &limits_type},
};
inline constexpr ByteRange configuration_bytes[] = {{0, sizeof(Configuration)}};
inline constexpr TypeDescriptor configuration_type{"sample.configuration", "", sizeof(Configuration),
                                                   alignof(Configuration), 3,  configuration_fields,
                                                   configuration_bytes,    {}, false};

inline constexpr FieldDescriptor runtime_fields[] = {
    {"step", Scalar::f64, 0, {}, 1, offsetof(Runtime, step), "m", "", nullptr},
    {"gains", Scalar::f32, 1, {3}, 3, offsetof(Runtime, gains), "1", "", nullptr},
    {"mode", Scalar::enumeration, 0, {}, 1, offsetof(Runtime, mode), "", "", &mode_type},
    {"enabled", Scalar::boolean, 0, {}, 1, offsetof(Runtime, enabled), "", "", nullptr},
    {"go", Scalar::button, 0, {}, 1, offsetof(Runtime, go), "", "", nullptr},
    {"jog", Scalar::hold, 1, {2}, 2, offsetof(Runtime, jog), "", "", nullptr},
    {"small", Scalar::i8, 0, {}, 1, offsetof(Runtime, small), "1", "", nullptr},
    {"large", Scalar::u64, 0, {}, 1, offsetof(Runtime, large), "1", "", nullptr},
    {"scratch", Scalar::f64, 0, {}, 1, offsetof(Runtime, scratch), "s", "", nullptr},
    {"limits", Scalar::structure, 0, {}, 1, offsetof(Runtime, limits), "", "", &limits_type},
};
inline constexpr ByteRange runtime_bytes[] = {{0, sizeof(Runtime)}};
inline constexpr TypeDescriptor runtime_type{
    "sample.runtime", "", sizeof(Runtime), alignof(Runtime), 4, runtime_fields, runtime_bytes, {}, false};

constexpr ParameterDescriptor parameter(const FieldDescriptor& field) {
  return {&field, false, true, Role::operator_, 0, 0, "", "", ""};
}
constexpr ParameterDescriptor parameter(const FieldDescriptor& field, double minimum, double maximum) {
  return {&field, true, true, Role::operator_, minimum, maximum, "", "", ""};
}

// Indices of the runtime parameters.
enum : std::uint16_t { step, gains, mode, enabled, go, jog, small, large, scratch, limits };

inline constexpr ParameterDescriptor configuration_parameters[] = {
    parameter(configuration_fields[0], 0.1, 10), parameter(configuration_fields[1], 1, 8),
    parameter(configuration_fields[2]), parameter(configuration_fields[3], -4, 4),
    parameter(configuration_fields[4])};
inline constexpr ParameterDescriptor runtime_parameters[] = {
    parameter(runtime_fields[0], 0.001, 0.1),
    parameter(runtime_fields[1], 0, 10),
    parameter(runtime_fields[2]),
    parameter(runtime_fields[3]),
    parameter(runtime_fields[4]),
    parameter(runtime_fields[5]),
    parameter(runtime_fields[6]),
    parameter(runtime_fields[7]),
    {&runtime_fields[8], false, false, Role::operator_, 0, 0, "", "", ""},  // not persistent
    parameter(runtime_fields[9])};

inline constexpr ComponentType component_type{
    "sample", "", {&configuration_type, configuration_parameters}, {&runtime_type, runtime_parameters},
    {},       {}};

inline constexpr Configuration default_configuration{2.0, 3, "home", {1, 2, 3, -1, -2, -3}, {{0, 1}, {2, 3}}};
inline constexpr Runtime default_runtime{0.01, {1, 2, 3}, 1, false, 0, {}, -5, 7, 0.5, {-1, 1}};

class SampleComponent : public Component {
 public:
  const ComponentType& component_type() const noexcept override { return sample::component_type; }
  ParameterMemory parameter_memory() noexcept override { return {&configuration, &runtime, nullptr}; }
  Status accept_runtime(const void* proposed) noexcept override {
    ++asked;
    const auto& values = *static_cast<const Runtime*>(proposed);
    if (values.limits.low < static_cast<double>(values.limits.high)) return {};
    return Status::error(StatusCode::invalid_argument, "low is not below high");
  }

  Configuration configuration = default_configuration;
  Runtime runtime = default_runtime;
  int asked = 0;
};

}  // namespace flexrf::sample

namespace flexrf {
template <>
inline const TypeDescriptor* const descriptor_of<sample::Runtime> = &sample::runtime_type;
}  // namespace flexrf
