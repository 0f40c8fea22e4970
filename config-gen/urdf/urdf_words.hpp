// Refuses elements and attributes of a URDF joint that the reader does not know. Private to config-gen/urdf.
#pragma once

#include "config-gen/urdf/urdf_document.hpp"

namespace flexrf::config_gen {

// An element or attribute that is neither read nor known to be without effect on the chain is refused where
// it may be meant (an attribute of what is read, a slip of the hand, a second element of a kind), and told
// elsewhere. Without effect are effort, <dynamics>, <calibration>, what simulators put into a joint, and
// whatever has a prefix, as drake:acceleration: it is another program's.
void check_words(const DocumentJoint& joint, UrdfDocument& document);

}  // namespace flexrf::config_gen
