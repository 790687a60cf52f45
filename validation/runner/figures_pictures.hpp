// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "runner/figures.hpp"

// Figures that the page's script makes lively; without one they are still pictures, with tables.
namespace etendue::validation {

std::string picture_html(const FactorTable& table);
std::string picture_html(const RadiosityField& field);
std::string picture_html(const ImagePair& pair);

}  // namespace etendue::validation
