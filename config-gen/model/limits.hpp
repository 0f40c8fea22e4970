// Limits that the runtime sets, and those within which config-gen answers at once. It knows nothing of the
// runtime, so a test compares the first with the runtime's own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace flexrf::config_gen {

constexpr std::size_t max_runtime_size = 4096;   // bytes of one component's runtime parameters
constexpr std::size_t max_holds = 32;            // of one component
constexpr std::size_t max_trigger_sources = 32;  // slots and queues that release one thread
constexpr std::size_t min_stack = 64 * 1024;     // of a thread, bytes: what each machine can start
constexpr std::size_t max_stack = std::size_t{1} << 30;

// Of a file.
constexpr std::size_t max_file_size = std::size_t{4} << 20;
constexpr std::size_t max_nesting =
    16;  // of tables, lists and dotted names in each other; of groups; of types

// Of a type, and of parameters.
constexpr std::size_t max_type_size = std::size_t{1} << 30;  // bytes
constexpr std::size_t most_elements = std::size_t{1} << 28;  // of one field
constexpr std::size_t max_type_fields =
    65536;  // single fields of a type, those of each record's element counted
constexpr std::size_t max_parameter_values = 65536;                   // single values of one parameter
constexpr std::size_t max_application_values = std::size_t{1} << 18;  // of all parameters of an application

// Of an application.
constexpr std::size_t max_rows = 16384;      // rows of its table and of all instances of its groups
constexpr std::size_t max_instances = 4096;  // of groups
constexpr std::size_t max_units = 16384;     // members of populations counted
constexpr std::size_t max_threads = 1024;

// Of what is written in tables: sums of these do not overflow.
constexpr std::int64_t max_duration = std::int64_t{365} * 24 * 3600 * 1'000'000'000;  // nanoseconds
constexpr std::size_t max_size = std::size_t{1} << 40;                                // bytes

// Of messages: nobody reads more, and the first are the cause of the others more often than not.
constexpr std::size_t max_messages_shown = 100;
constexpr std::size_t max_errors = 1000;        // different ones, after which the reading ends
constexpr std::size_t max_errors_alike = 5000;  // those counted that are told as "more like it"

}  // namespace flexrf::config_gen
