// SPDX-License-Identifier: Apache-2.0
#include "render_report.hpp"

#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/raytracing/picture_facts.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

double per_ray(std::uint64_t tests, const RenderCounts& counts) {
  return counts.rays() == 0 ? 0 : static_cast<double>(tests) / static_cast<double>(counts.rays());
}

/// How bright the picture is, what became of values above one, and how smooth its scan line is.
void print_shown(std::ostream& out, const RenderRequest& request, const RenderFiles& written) {
  const Brightness& bright = written.bright;
  const ToneMapping how = mapping(request.tone, 1);
  out << "brightness  " << rounded(bright.largest) << " at most";
  if (bright.overflow > 0 && request.overflow_treatment() != Overflow::clamp) {
    out << "; " << counted(bright.overflow, "pixel") << " above 1, shown by " << request.overflow;
  } else if (bright.overflow > 0) {
    out << "; " << counted(bright.overflow, "pixel") << (bright.overflow == 1 ? " is" : " are")
        << " cut off in the PNG (";
    if (how.tone == ToneOperator::reinhard) {
      out << "a smaller --exposure would show them)";
    } else {
      out << "--exposure " << rounded(how.exposure / bright.largest) << " would show them)";
    }
  }
  out << '\n';
  if (request.line) {
    out << "scan line   row " << request.line->row << ", columns " << request.line->first << " to "
        << request.line->last - 1 << ": jumps of " << rounded(written.jumps.intensity) << " in luminance, "
        << rounded(written.jumps.slope) << " in its slope; perceived " << rounded(written.jumps.perceived)
        << " off at most\n";
  }
}

void print_drawing(std::ostream& out, const RenderFiles& written) {
  if (!written.svg.empty()) out << printable(written.svg.string()) << '\n';
}

Json scan_line_json(const RenderRequest& request, const RenderFiles& written) {
  return {{"row", request.line->row},          {"first", request.line->first},
          {"last", request.line->last},        {"intensity_jump", written.jumps.intensity},
          {"slope_jump", written.jumps.slope}, {"perceived_jump", written.jumps.perceived},
          {"svg", written.svg.string()}};
}

}  // namespace

void print_raster_text(std::ostream& out, const RenderRequest& request, const SceneFile& file,
                       const Rendering& rendering, const RenderFiles& written, const RasterFacts& facts) {
  const int n = request.render.sampling.samples_per_side;
  out << "scene       " << scene_line(file) << '\n'
      << "picture     " << rendering.image.columns << " × " << rendering.image.rows << " pixels, by rasteriser\n"
      << "shading     " << request.shading_text() << '\n'
      << "drawn       " << counted(facts.facets, "triangle") << ", " << n << " × " << n << " samples a pixel"
      << (request.render.wavelengths > 0
              ? ", " + counted(static_cast<std::uint64_t>(request.render.wavelengths), "wavelength")
              : "")
      << '\n';
  print_shown(out, request, written);
  out << "time        " << rounded(facts.seconds) << " s\n"
      << printable(written.exr.string()) << '\n'
      << printable(written.png.string()) << '\n';
  print_drawing(out, written);
}

void print_raster_json(std::ostream& out, const RenderRequest& request, const SceneFile& file,
                       const Rendering& rendering, const RenderFiles& written, const RasterFacts& facts) {
  Json report;
  report["program"] = std::string("etendue ") + version();
  report["scene"] = {{"file", request.scene.string()}, {"name", file.scene.name}, {"hash", file.hash}};
  report["settings"] = {{"method", request.method},
                        {"shading", request.shading_text()},
                        {"samples_per_side", request.render.sampling.samples_per_side},
                        {"wavelengths", request.render.wavelengths},
                        {"exposure", written.scale},
                        {"tone", tone_text(mapping(request.tone, 1))},
                        {"overflow", request.overflow}};
  report["picture"] = {{"columns", rendering.image.columns},
                       {"rows", rendering.image.rows},
                       {"largest_value", brightness(rendering.image).largest},
                       {"exr", written.exr.string()},
                       {"png", written.png.string()}};
  report["triangles"] = facts.facets;
  report["left_out"] = facts.left_out;
  if (request.line) report["scan_line"] = scan_line_json(request, written);
  report["seconds"] = facts.seconds;
  out << dumped(report, 2) << '\n';
}

void print_text(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds) {
  const RenderCounts& counts = rendering.counts;
  const TreeLimits& limits = request.render.limits;
  out << "scene       " << scene_line(file) << '\n'
      << "picture     " << rendering.image.columns << " × " << rendering.image.rows << " pixels, depth " << limits.depth
      << ", cutoff " << shortest(limits.cutoff) << '\n'
      << "samples     " << request.sampling_text() << "; filter " << request.filter_text() << '\n'
      << "rays        " << counts.eye_rays << " from the eye, " << counts.reflected_rays << " reflected, "
      << counts.transmitted_rays << " transmitted, " << counts.shadow_rays << " to lights\n"
      << "tests       " << rounded(per_ray(counts.tests.surfaces, counts)) << " surfaces and "
      << rounded(per_ray(counts.tests.volumes, counts)) << " boxes a ray, by " << request.accelerator << '\n'
      << "left out    " << counts.cut_by_depth << " rays by depth, " << counts.cut_by_cutoff
      << " by cutoff; together at most " << rounded(counts.largest_cut_weight) << " of the weight of a sample\n";
  print_shown(out, request, written);
  out << "time        " << rounded(seconds) << " s\n"
      << printable(written.exr.string()) << '\n'
      << printable(written.png.string()) << '\n';
  print_drawing(out, written);
}

void print_json(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds) {
  const RenderCounts& counts = rendering.counts;
  const Brightness bright = brightness(rendering.image);
  Json report;
  report["program"] = std::string("etendue ") + version();
  report["scene"] = {{"file", request.scene.string()}, {"name", file.scene.name}, {"hash", file.hash}};
  report["settings"] = {{"method", request.method},
                        {"depth", request.render.limits.depth},
                        {"cutoff", request.render.limits.cutoff},
                        {"shadows", request.shadows},
                        {"acne_cure", request.acne_cure},
                        {"wavelengths", request.render.wavelengths},
                        {"samples_per_side", request.render.sampling.samples_per_side},
                        {"sampling", request.sampling_text()},
                        {"filter", request.filter_text()},
                        {"accelerator", request.accelerator},
                        {"exposure", written.scale},
                        {"tone", tone_text(mapping(request.tone, 1))},
                        {"overflow", request.overflow}};
  if (const auto& window = request.render.crop)
    report["settings"]["crop"] = {window->left, window->top, window->right, window->bottom};
  report["picture"] = {{"columns", rendering.image.columns}, {"rows", rendering.image.rows},
                       {"complete", rendering.complete},     {"largest_value", bright.largest},
                       {"exr", written.exr.string()},        {"png", written.png.string()}};
  report["picture"]["channels"] = Json::array();
  for (const PictureFact fact : request.render.facts) {
    for (const std::string& channel : channel_names(fact)) report["picture"]["channels"].push_back(channel);
  }
  report["rays"] = {{"eye", counts.eye_rays},
                    {"reflected", counts.reflected_rays},
                    {"transmitted", counts.transmitted_rays},
                    {"shadow", counts.shadow_rays}};
  report["tests"] = {{"surfaces", counts.tests.surfaces}, {"boxes", counts.tests.volumes}};
  report["left_out"] = {{"by_depth", counts.cut_by_depth},
                        {"by_cutoff", counts.cut_by_cutoff},
                        {"largest_weight", counts.largest_cut_weight}};
  if (request.line) report["scan_line"] = scan_line_json(request, written);
  report["seconds"] = seconds;
  out << dumped(report, 2) << '\n';
}

}  // namespace etendue::cli
