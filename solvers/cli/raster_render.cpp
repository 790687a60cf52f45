// SPDX-License-Identifier: Apache-2.0
#include "raster_render.hpp"

#include <chrono>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "render_report.hpp"

namespace etendue::cli {

namespace {

constexpr const char* kName = "render";

void tell_left_out(const std::vector<std::string>& parts, std::ostream& err) {
  if (parts.empty()) return;
  err << "etendue render: --method raster leaves out ";
  for (std::size_t k = 0; k < parts.size(); ++k)
    err << (k == 0 ? "" : k + 1 == parts.size() ? " and " : ", ") << parts[k];
  err << "; --method raytrace has " << (parts.size() == 1 ? "it" : "them") << '\n';
}

}  // namespace

int render_by_raster(const RenderRequest& request, const SceneFile& file, std::ostream& out, std::ostream& err) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const std::vector<std::string> missing = left_out(file.scene, request.shading_options().shading);
  auto drawn = [&] {
    Progress progress(err, kName, request.common);  // wiped before anything is printed
    if (request.progress) progress.tell_tenths();
    return view_shaded(file.scene, request.shading_options(), execution(request.common, progress));
  }();
  if (!drawn) return fail(err, kName, drawn.error());
  const std::chrono::duration<double> elapsed = Clock::now() - begin;
  Rendering rendering;
  rendering.image = std::move(drawn->image);
  rendering.row_done.assign(static_cast<std::size_t>(rendering.image.rows), 1);
  rendering.complete = true;
  const auto written = write_rendering(request, file, rendering);
  if (!written) return fail(err, kName, written.error());
  if (!request.common.quiet) tell_left_out(missing, err);
  if (request.common.json) {
    print_raster_json(out, request, file, rendering, *written, {drawn->facets, missing, elapsed.count()});
  } else if (!request.common.quiet) {
    print_raster_text(out, request, file, rendering, *written, {drawn->facets, missing, elapsed.count()});
  }
  return 0;
}

}  // namespace etendue::cli
