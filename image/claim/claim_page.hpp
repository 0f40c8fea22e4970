// The page that a PC shows until somebody has claimed it. It needs no script.
#pragma once

#include <string>
#include <string_view>

#include "image/claim/claim.hpp"

namespace flexrf::claim {

/// The form; with what became of the last attempt, if there was one. What was typed is not in it, but for the
/// user's name. `token` comes back with the form.
std::string form_page(std::string_view machine, std::string_view token, std::string_view user,
                      const Answer* last);
/// The host in the address at which the right code was typed, and whether the panel answers there.
struct ReachedBy {
  std::string host;     ///< empty: one of the PC's own, at which its panel answers anyway
  std::string why_not;  ///< empty: the panel answers there, too
};

/// After the claim.
std::string done_page(std::string_view machine, std::string_view user, const ReachedBy& reached_by);
/// Its style sheet.
std::string_view page_style() noexcept;

}  // namespace flexrf::claim
