// The namespace that generated names are in, and how they call those of others.
//
// What FlexRF's own tables make is in flexrf, beside the runtime that uses it; what all other tables make is
// in flexrf::user, where no name of the runtime is. There the runtime's names are written in full, so that a
// type called Status or Slot takes away none of them.
#pragma once

#include <string>
#include <string_view>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen {

class Space {
 public:
  explicit Space(std::string_view name) : name_(name) {}

  std::string open() const { return "namespace " + name_ + " {\n"; }
  std::string close() const { return "}  // namespace " + name_ + "\n"; }
  bool is_user() const { return name_ == user_space; }
  /// Before a name of the runtime.
  std::string_view runtime() const { return is_user() ? "flexrf::" : ""; }
  /// A name that is made from the table of `owner`: a Type, a UnitType, an Interface or a Driver.
  template <class Owner>
  std::string of(const Owner& owner, std::string_view name) const {
    return (owner.space == user_space ? std::string(user_space) + "::" : std::string(runtime())) +
           std::string(name);
  }

 private:
  std::string name_;
};

/// Of the generated application: no name of a table is in it, so the runtime's need no prefix.
inline const Space application_space("flexrf::application");

}  // namespace flexrf::config_gen
