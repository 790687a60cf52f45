// SPDX-License-Identifier: Apache-2.0
#include "ray_tree_command.hpp"

#include <algorithm>
#include <ostream>

#include "accelerator_option.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/optics/dispersion.hpp"
#include "etendue/raytracing/ray_tree_drawing.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "ray_tree_output.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "ray-tree";
constexpr int kMostBounces = 1000;  // a ray tree is followed by recursion, as in render

struct Request {
  fs::path scene, output;
  std::pair<std::string, std::string> pixel;
  TreeLimits limits{12, 0};
  double wavelength = 0;
  std::string accelerator = "bvh";
  bool json = false;
};

void declare(Options& options, Request& request) {
  options.argument("SCENE", "scene file (JSON)", request.scene);
  options.two_texts("--pixel", "COLUMN ROW", "the pixel, counted from 0 at the top left; its centre is looked through",
                    request.pixel);
  options.integer("--depth", "D", "greatest level of a ray; the ray from the eye is of level 0 (default: 12)",
                  request.limits.depth, 0, kMostBounces);
  options.real("--cutoff", "C", "do not follow rays whose weight in the pixel is below C (default: 0, follow all)",
               request.limits.cutoff, 0, 1);
  options.real("--wavelength", "NM",
               "refract as light of this wavelength is, 380 to 780 nm (default: all light as n_d)", request.wavelength,
               kShortestVisible, kLongestVisible);
  add_accelerator(options, request.accelerator);
  options.flag("--json", "print JSON instead of text", request.json);
  options.path("--output", "FILE", "write to FILE: NAME.txt, NAME.json, NAME.dot (Graphviz) or NAME.svg (a drawing)",
               request.output);
  options.alias("-o", "--output");
  options.note(
      "Each ray has a name as in figure 36: R or T for reflected or transmitted, with the number of the surface where "
      "it\n"
      "begins; its weight is the product of the coefficients along its path, and of what bodies on it do not absorb; "
      "then\nfollows what it meets, or why it ends.");
  options.example("etendue ray-tree scenes/mirrors/scene.json --pixel 295 235");
  options.example("etendue ray-tree scenes/mirrors/scene.json --pixel 295 235 --depth 3 -o tree.svg");
}

bool is_known(const std::string& ending) {
  return ending == ".txt" || ending == ".json" || ending == ".dot" || ending == ".svg";
}

std::string written(const Request& request, const RayTree& tree, const SceneFile& file, const Pixel& pixel) {
  const std::string ending = request.output.extension().string();
  if (ending == ".dot") return to_dot(tree, file.scene);
  if (ending == ".svg") return to_svg(tree, file.scene);
  if (ending == ".json") return ray_tree_json(tree, file, pixel, request.limits);
  return to_text(tree, file.scene);
}

}  // namespace

int ray_tree(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  Options options(kName, "Print or draw the tree of rays behind one pixel.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (!request.output.empty() && !is_known(request.output.extension().string())) {
    return options.usage_error(err, "option '--output': found '" + request.output.string() +
                                        "', expected a name that ends in .txt, .json, .dot or .svg");
  }
  if (request.pixel.first.empty()) return options.usage_error(err, "option '--pixel': found none, expected COLUMN ROW");
  const auto read = [&] {
    const NothingToSave reading;
    return read_scene(request.scene);
  }();
  if (!read) return fail(err, kName, read.error());
  const SceneFile& file = *read;
  warn(err, kName, file.warnings);
  const Camera& camera = file.scene.camera;
  const auto pixel = read_pixel(request.pixel.first + "," + request.pixel.second, camera);
  if (!pixel) {
    return options.usage_error(err, "option '--pixel': found '" + request.pixel.first + " " + request.pixel.second +
                                        "', expected COLUMN ROW from 0 0 to " + std::to_string(camera.columns - 1) +
                                        " " + std::to_string(camera.rows - 1));
  }
  if (!request.output.empty()) {
    if (const auto free = check_outputs({request.output}, file.files); !free) return fail(err, kName, free.error());
  }
  const auto accelerator = named_accelerator(request.accelerator, file.scene);
  if (!accelerator) return fail(err, kName, accelerator.error());
  const auto tree = pixel_tree(**accelerator, *pixel, request.limits, request.wavelength);
  if (!tree) return fail(err, kName, tree.error());
  if (!request.output.empty()) {
    const auto done = write_file(request.output, written(request, *tree, file, *pixel));
    if (!done) return fail(err, kName, done.error());
  }
  if (request.json) {
    out << ray_tree_json(*tree, file, *pixel, request.limits);
  } else if (request.output.empty()) {
    out << to_text(*tree, file.scene);
  } else {
    out << printable(request.output.string()) << '\n';
  }
  return 0;
}

}  // namespace etendue::cli
