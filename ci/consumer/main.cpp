// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <etendue/form_factor/polygon_polygon.hpp>

int main() {
  const auto floor = etendue::Polygon::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const auto ceiling = etendue::Polygon::make({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  std::printf("%.17g\n", etendue::form_factor(*floor, *ceiling).value);
}
