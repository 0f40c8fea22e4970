#pragma once

#include "scenery_interface.hpp"

namespace flexrf::user {

class Scenery : public SceneryInterface {};

}  // namespace flexrf::user
