// SPDX-License-Identifier: Apache-2.0
// Figure 49 as the text renders it: our rays a second on one core, and POV-Ray's time for the same scene in the same run.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/scene/camera_frame.hpp"

// Bars: three times as fast as POV-Ray at about as many eye rays, 10 million rays a second a core, all kinds counted; two
// threads 1.9 times as fast as one (compare the times of figure_49/threads).
namespace etendue::validation {
namespace {

const Scene& mirrors() {
  static const Scene scene =
      read_scene(std::filesystem::path(ETENDUE_SOURCE_DIR) / "scenes" / "mirrors" / "scene.json").value().scene;
  return scene;
}

void figure_49(benchmark::State& state) {
  const auto accelerator = make_accelerator(mirrors(), AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.limits.depth = 12;
  options.sampling.scheme = SamplingScheme::adaptive_jittered;
  options.sampling.samples_per_side = 4;
  options.filter = usual_filter(FilterKind::gaussian);
  Execution execution;
  execution.threads = static_cast<int>(state.range(0));
  RenderCounts counts;
  for (auto _ : state) counts = render(*accelerator, options, execution).value().counts;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(counts.rays()));
  state.counters["eye"] = static_cast<double>(counts.eye_rays);
  state.counters["reflected"] = static_cast<double>(counts.reflected_rays);
  state.counters["refracted"] = static_cast<double>(counts.transmitted_rays);
  state.counters["shadow"] = static_cast<double>(counts.shadow_rays);
}
BENCHMARK(figure_49)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)

    ->MeasureProcessCPUTime();

/// A scene of what figure 49 is made of, in POV-Ray's language.
class PovScene {
 public:
  PovScene(const Scene& scene, std::ostream& out) : scene_(scene), out_(out) {
    out_.precision(17);
    const CameraFrame frame = camera_frame(scene.camera).value();
    out_ << "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 13 ambient_light ";
    put(scene.ambient);
    out_ << " }\nbackground { colour ";
    put(scene.background);
    out_ << " }\ncamera { location ";
    put(frame.eye);
    out_ << " right ";
    put(2 * frame.tan_horizontal * frame.right);
    out_ << " up ";
    put(2 * frame.tan_vertical * frame.up);
    out_ << " direction ";
    put(frame.forward);
    out_ << " }\n";
    for (const Light& light : scene.lights) {
      out_ << "light_source { ";
      put(std::get<PointLight>(light).position);
      out_ << ", ";
      put(std::get<PointLight>(light).intensity);
      out_ << " }\n";
    }
    for (const Object& object : scene.objects) {
      std::visit([&](const auto& shape) { begin(shape); }, object.shape);
      material(scene.materials[object.material]);
      out_ << "}\n";
    }
  }

 private:
  template <class Three>
  void put(const Three& v) {
    out_ << "<" << v[0] << "," << v[1] << "," << v[2] << ">";
  }
  void begin(const Sphere& sphere) {
    out_ << "sphere { ";
    put(sphere.centre);
    out_ << ", " << sphere.radius;
  }
  void begin(const Cylinder& cylinder) {
    out_ << "cylinder { ";
    put(cylinder.base);
    out_ << ", ";
    put(cylinder.top);
    out_ << ", " << cylinder.radius << " open";
  }
  void begin(const Plane& plane) {
    out_ << "plane { ";
    put(plane.normal);
    out_ << ", " << plane.normal.dot(plane.point);
  }
  void begin(const Disc& disc) {
    out_ << "disc { ";
    put(disc.centre);
    out_ << ", ";
    put(disc.normal);
    out_ << ", " << disc.radius;
  }
  void begin(const Box& box) {  // the floor's axes are the scene's
    out_ << "box { ";
    put(Vec3(box.centre - box.half_edges));
    out_ << ", ";
    put(Vec3(box.centre + box.half_edges));
  }
  void begin(const Polygon& polygon) {
    out_ << "polygon { " << polygon.vertices().size() + 1;
    for (const Vec3& vertex : polygon.vertices()) {
      out_ << ", ";
      put(vertex);
    }
    out_ << ", ";
    put(polygon.vertices().front());
  }
  template <class Other>
  void begin(const Other&) {
    std::abort();  // figure 49 holds nothing else
  }

  void material(const Material& material) {
    out_ << " pigment { ";
    if (!material.pattern) {
      out_ << "colour ";
      put(material.k_d);
    } else if (const auto* board = std::get_if<Checkerboard>(&material.pattern->pattern)) {
      out_ << "checker colour ";
      put(material.k_d);
      out_ << " colour ";
      put(material.pattern->k_d);
      out_ << " scale " << board->size << " translate z*0.01";
    } else {
      const Wood& wood = std::get<Wood>(material.pattern->pattern);
      out_ << "wood turbulence 0.05 colour_map { [0 rgb ";
      put(material.k_d);
      out_ << "] [1 rgb ";
      put(material.pattern->k_d);
      out_ << "] } scale " << wood.ring << (std::abs(wood.axis.x()) > 0.5 ? " rotate y*90" : "") << " translate ";
      put(wood.origin);
    }
    out_ << " } finish { ambient 1 diffuse 1 phong " << material.k_s << " phong_size " << material.phong_exponent
         << " reflection " << material.k_r << " }";
  }

  const Scene& scene_;
  std::ostream& out_;
};

double seconds_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The number after a word of POV-Ray's statistics.
double told(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + word.size(), nullptr);
}

void povray(benchmark::State& state) {
  if (std::system("command -v povray >/dev/null") != 0) return state.SkipWithError("povray is not installed");
  const auto folder =
      std::filesystem::temp_directory_path() / ("etendue-bench-" + std::to_string(std::random_device{}()));
  std::filesystem::create_directory(folder);
  {
    std::ofstream file(folder / "mirrors.pov");
    PovScene(mirrors(), file);
  }
  // +AM1: more samples where a pixel differs from its neighbours, 4 × 4, jittered, as ours.
  const std::string command =
      "cd '" + folder.string() + "' && povray +Imirrors.pov +W500 +H500 +AM1 +A0.04 +R4 +J1 -D +WT1 -F >log 2>&1";
  for (auto _ : state) {
    const double before = seconds_of_children();
    if (std::system(command.c_str()) != 0) state.SkipWithError("povray fails");
    state.SetIterationTime(seconds_of_children() - before);
  }
  std::ifstream log(folder / "log");
  const std::string text(std::istreambuf_iterator<char>(log), {});
  state.counters["eye"] = told(text, "Samples:");
  state.counters["eye+reflected"] = told(text, "Rays:");
  state.counters["shadow"] = told(text, "Shadow Ray Tests:");
  std::filesystem::remove_all(folder);
}
BENCHMARK(povray)->Name("figure_49/povray")->Unit(benchmark::kMillisecond)->UseManualTime();

}  // namespace
}  // namespace etendue::validation
