// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/vector_text.hpp"

#include <sstream>

namespace etendue {

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return out.str();
}

}  // namespace etendue
