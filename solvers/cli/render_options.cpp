// SPDX-License-Identifier: Apache-2.0
#include "accelerator_option.hpp"
#include "render_request.hpp"

// The options of `etendue render` as --help tells them.
namespace etendue::cli {

namespace {

constexpr int kMostBounces = 1000;     // a ray tree is followed by recursion: deeper ones would need a larger stack
constexpr int kMostWavelengths = 401;  // a part a nanometre
constexpr int kMostColumns = 1 << 14;

}  // namespace

void declare(Options& options, RenderRequest& request) {
  request.render.limits.depth = kUsualTreeDepth;
  request.render.sampling.samples_per_side = 0;  // as the scheme is used to
  options.argument("SCENE", "scene file (JSON)", request.scene);
  options.choice(
      "--method", {"raytrace", "raster"},
      "by recursive ray tracing, or by projecting triangles with a depth buffer: no reflection, refraction or "
      "shadows (default: raytrace)",
      request.method);
  options.choice(
      "--shading", {"flat", "gouraud", "phong", "dot"},
      "raster: one intensity a facet; intensities, normals, or the products N·L and R·V interpolated from the "
      "corners (default: phong)",
      request.shading);
  options.integer("--facets", "N", "raster: facets around a curved surface (default: 48)", request.facets,
                  kFewestFacets, kMostFacets);
  options.choice("--vertex-normals", {"angle", "equal", "area"},
                 "raster: how much a facet's normal counts at its corner: by its angle there, each once, by its area "
                 "(default: angle)",
                 request.vertex_normals);
  options.real("--crease", "DEGREES", "raster: edges of meshes that bend by more stay visible (default: 60)",
               request.crease_deg, 0, 180);
  options.choice("--stepping", {"direct", "incremental"},
                 "raster: from pixel to pixel of a row by the formula, or by one addition each (default: direct)",
                 request.stepping);
  options.text("--size", "COLUMNSxROWS", "size of the picture (default: the scene's); keeps the horizontal angle",
               request.size);
  options.integer("--columns", "N", "make the picture N pixels wide, in the scene's proportions (default: the scene's)",
                  request.columns, 1, kMostColumns);
  options.text(
      "--cube", "X,Y,Z",
      "not the camera's picture but the six that look out of a cube at this place, each 90 degrees wide and high: "
      "NAME.right, left, back, front, top and bottom (+x, -x, +y, -y, +z, -z), for a material's \"environment\"",
      request.cube);
  options.text(
      "--hide", "OBJECT",
      "leave out the object of this name, or all of a group: with --cube, what mirrors its surroundings must not "
      "stand in the way",
      request.hide);
  options.text(
      "--crop", "LEFT,TOP,RIGHT,BOTTOM",
      "only these columns and rows, counted from 0 at the upper left, without the last ones: the same bits as in "
      "the whole picture",
      request.crop);
  options.integer("--depth", "D", "greatest level of a ray; rays from the eye are of level 0 (default: 12)",
                  request.render.limits.depth, 0, kMostBounces);
  options.real("--cutoff", "C", "do not follow rays whose weight in the pixel is below C (default: 0, follow all)",
               request.render.limits.cutoff, 0, 1);
  options.choice(
      "--sampling", {"uniform", "jittered", "adaptive", "adaptive-jittered"},
      "where in a pixel: the centres of N × N parts; random points in them; the corners, quartered to N × N parts "
      "where they differ; one random point, N × N where neighbours differ (default: uniform)",
      request.sampling);
  options.integer("--samples", "N", "N × N rays a pixel, at most where adaptive (default: 2; adaptive: 4)",
                  request.render.sampling.samples_per_side, 1, kMostSamplesPerSide);
  options.text("--threshold", "C|R,G,B", "contrast above which adaptive sampling goes on (default: 0.25,0.2,0.4)",
               request.threshold);
  options.integer("--seed", "S", "of the random points (default: 0)", request.seed, 0, 2147483647);
  options.choice("--filter", {"box", "tent", "gaussian", "mitchell"},
                 "how samples become pixels (default: box, their mean)", request.filter);
  options.real("--filter-width", "W", "in pixels (default: box 1, tent 2, gaussian 3, mitchell 4)",
               request.filter_width, 0.01, 2 * kLargestFilterRadius);
  options.choice("--shadows", {"attenuated", "opaque"},
                 "what transparent surfaces do to light on its way: weaken it along the straight line, or block it "
                 "(default: attenuated)",
                 request.shadows);
  options.choice("--acne-cure", {"bound", "tolerance", "moved-origin", "convex", "none"},
                 "how a shadow ray is kept off the surface it begins on: by the hit's error bound, by a least t or a "
                 "step of 1e-5, or by leaving out a convex surface itself (default: bound)",
                 request.acne_cure);
  options.integer("--wavelengths", "N",
                  "N parts of the visible light apart where a ray meets a material with \"dispersion\", or either "
                  "method one with \"reflectance\"; 81: the CIE's (default: 0, all light at once)",
                  request.render.wavelengths, 0, kMostWavelengths);
  options.text("--aov", "LIST",
               "further channels of the EXR: depth, normal, albedo, object, samples, tree_depth, with commas, or all",
               request.facts);
  add_accelerator(options, request.accelerator);
  add_tone(options, request.tone, "1");
  options.choice(
      "--overflow", {"clamp", "scale-image", "scale-pixel"},
      "what becomes of values above 1 in the PNG: cut off; the whole picture divided by its largest value; a "
      "pixel divided by its own (default: clamp)",
      request.overflow);
  options.text("--scan-line", "ROW[,FIRST,LAST]",
               "draw the luminances of a row, from column FIRST to before LAST, and how the eye perceives them (Mach "
               "bands), as NAME.row-ROW.svg",
               request.scan_line);
  options.text("--ray-tree", "COLUMN,ROW",
               "no picture: print the tree of rays of one pixel, also as --json (--output NAME.dot: draw it); "
               "short for the command ray-tree",
               request.pixel);
  options.path(
      "--preview", "FILE.png",
      "while it is rendered, show the picture there: squares of 16, 8, 4 and 2 pixels, then the rows that are done",
      request.preview);
  options.flag("--progress", "a line for each tenth that is done, also where no terminal is", request.progress);
  options.flag("--resume", "go on from NAME.resume, to the same bits as without a pause", request.resume);
  add_common(options, request.common,
             "NAME.exr or NAME.png: both are written (default: the scene's name, in this folder)");
  options.note(
      "The EXR holds linear values and, like the PNG, says in its metadata how it was made. After Ctrl-C the rows "
      "that\n"
      "are done are saved as NAME.incomplete.exr and .png and, for --resume, as NAME.resume; the exit code is 6.");
  options.example("etendue render scenes/mirrors/scene.json --output mirrors.png");
  options.example("etendue render scenes/mirrors/scene.json --depth 1 --samples 1 --json --output mirrors-1.png");
  options.example(
      "etendue render scenes/mirrors/scene.json --sampling adaptive-jittered --filter gaussian --output figure-49.png");
  options.example(
      "etendue render scenes/mirrors/scene.json --crop 95,115,145,165 --sampling jittered --samples 3 --aov all "
      "--output "
      "corner.exr");
  options.example("etendue render scenes/mirrors/scene.json --ray-tree 250,200");
  options.example(
      "etendue render scenes/environment/scene.json --cube 0,0,1 --hide ball --columns 64 --output surroundings.exr");
  options.example(
      "etendue render scenes/facets/scene.json --method raster --shading gouraud --facets 16 --scan-line 90,60,200 "
      "--output "
      "gouraud.png");
}

}  // namespace etendue::cli
