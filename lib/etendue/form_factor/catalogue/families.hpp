// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/form_factor/catalogue/entry.hpp"

namespace etendue::catalogue {

// One file a family; the catalogue lists them in this order.
[[nodiscard]] std::vector<Entry> elements_to_polygons();
[[nodiscard]] std::vector<Entry> elements_to_discs();
[[nodiscard]] std::vector<Entry> elements_to_solids();
[[nodiscard]] std::vector<Entry> strips();
[[nodiscard]] std::vector<Entry> tubes_and_grooves();
[[nodiscard]] std::vector<Entry> rectangle_entries();
[[nodiscard]] std::vector<Entry> boxes_and_tetrahedra();
[[nodiscard]] std::vector<Entry> discs();
[[nodiscard]] std::vector<Entry> cylinders();
[[nodiscard]] std::vector<Entry> concentric_cylinders();
[[nodiscard]] std::vector<Entry> spheres();
[[nodiscard]] std::vector<Entry> cones();

/// The sum over the nodes of a 30-point Gauss rule in twice the digits, on [low, high]; its bound holds the difference
/// to the 24-point rule besides the count, which is measured, not proved.
[[nodiscard]] Counted integral(const Counted& low, const Counted& high, Counted (*f)(const Counted&, Values),
                               Values values);

}  // namespace etendue::catalogue
