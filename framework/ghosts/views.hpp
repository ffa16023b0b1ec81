#pragma once

#include "fields/rule_view.hpp"
#include "neighbours/stored_views.hpp"

/// What loops over ghosts and wall particles see. Trivially copyable.
namespace mesogen {

/// The images of the box whose particles may have ghosts.
struct Images {
  static constexpr int most = 26;
  int count = 0;
  int boxes[most][3];     ///< how many boxes away
  double shear[most][3];  ///< and how much farther, m: see Boundary::shear
};

}  // namespace mesogen
