// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>

#include "render_files.hpp"

namespace etendue::cli {

/// What a rendering was, for people.
void print_text(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds);

/// The same for machines.
void print_json(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds);

}  // namespace etendue::cli
