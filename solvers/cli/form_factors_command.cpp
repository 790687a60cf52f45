// SPDX-License-Identifier: Apache-2.0
#include "form_factors_command.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <ostream>

#include "etendue/assembly/certified_exchange.hpp"
#include "etendue/assembly/closure_repair.hpp"
#include "etendue/assembly/curved_exchange.hpp"
#include "etendue/assembly/drop.hpp"
#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/assembly/hemicube_exchange.hpp"
#include "etendue/assembly/ray_exchange.hpp"
#include "etendue/core/version.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/checkpoint.hpp"
#include "etendue/io/length_unit.hpp"
#include "etendue/io/matrix_file.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/io/surface_file.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "form_factors_report.hpp"
#include "form_factors_request.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

using Request = FormFactorsRequest;

/// The row that the user means by a number from 1 or by a name; a name goes before a number.
std::optional<std::size_t> row_of(const SurfaceModel& model, const std::string& word) {
  for (std::size_t k = 0; k < model.rows.size(); ++k) {
    if (model.rows[k].name == word) return k;
  }
  std::size_t position = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), position);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return position >= 1 && position <= model.rows.size() ? std::optional(position - 1) : std::nullopt;
}

class Run {
 public:
  Run(const Options& options, const Request& request, std::ostream& out, std::ostream& err)
      : options_(options), request_(request), out_(out), err_(err) {}

  int run() {
    const fs::path& output = request_.common.output;
    const bool one_pair = !request_.pair.first.empty();
    if (!output.empty()) {
      if (const auto writable = check_writable({output}); !writable) return fail(writable.error());
    }
    auto model = [&] {
      const NothingToSave reading;
      return read_surfaces(request_.scene);
    }();
    if (!model) return fail(model.error());
    model_ = std::move(model).value();
    if (!model_.rounds.empty() && (request_.method == "certified" || request_.by_pixels())) {
      return fail({ErrorCode::invalid_input,
                   "found round surface '" + printable(model_.rounds.front().name) +
                       "', expected flat ones: --method " + request_.method +
                       (request_.by_pixels() ? " projects polygons onto its pixels" : " encloses polygons only") +
                       "; exact and rays take spheres, discs and cylinders"});
    }
    if (!request_.unit.empty()) model_.metres_per_unit = metres_of(request_.unit);
    if (const auto same = resumable(); !same) return fail(same.error());
    for (const std::string& note : model_.notes) err_ << "etendue form-factors: " << printable(note) << '\n';
    begin_ = Clock::now();  // looking around, which some methods do first, is a part of the work
    method_ = made_method();
    if (!method_) {
      err_ << "etendue form-factors: stopped while surfaces " << (request_.by_pixels() ? "looked around" : "sent rays")
           << "; nothing is kept\n";
      return static_cast<int>(ErrorCode::stopped);
    }
    return one_pair ? pair() : matrix();
  }

 private:
  int fail(const Error& error) {
    err_ << "etendue form-factors: " << printable_lines(error.message) << '\n';
    return static_cast<int>(error.code);
  }

  /// Nothing when stopped.
  std::unique_ptr<const ExchangeMethod> made_method() {
    Tolerance asked = request_.tolerance;
    const double share = share_of_parts(model_);
    asked.relative *= share;
    asked.absolute *= share;
    if (request_.method == "exact" && !model_.rounds.empty())
      return std::make_unique<CurvedExchange>(model_, AssemblyTolerance{asked, asked});
    if (request_.method == "exact")
      return std::make_unique<ExactExchange>(model_.mesh, AssemblyTolerance{asked, asked});
    if (request_.method == "certified") return std::make_unique<CertifiedExchange>(model_.mesh, asked);
    if (request_.by_pixels()) {
      HemicubeSettings settings = request_.pixels;
      settings.body = request_.method == "hemicube" ? PixelBody::hemicube : PixelBody::cubic_tetrahedron;
      settings.seed = static_cast<std::uint64_t>(request_.seed);
      Progress looking(err_, request_.method.c_str(), request_.common);
      auto pixels = std::make_unique<HemicubeExchange>(model_.mesh, settings, execution(request_.common, looking));
      return pixels->complete() ? std::move(pixels) : nullptr;
    }
    Progress progress(err_, "rays", request_.common);
    auto rays = std::make_unique<RayExchange>(model_.mesh,
                                              RaySettings{request_.rays, static_cast<std::uint64_t>(request_.seed)},
                                              execution(request_.common, progress), model_.rounds);
    return rays->complete() ? std::move(rays) : nullptr;
  }

  std::string settings() const {
    std::string text = std::string("etendue ") + version() + ", method " + request_.method + ", relative " +
                       shortest(request_.tolerance.relative) + ", absolute " + shortest(request_.tolerance.absolute);
    if (request_.method == "rays") text += ", rays " + std::to_string(request_.rays);
    if (request_.by_pixels()) {
      text += ", resolution " + std::to_string(request_.pixels.resolution) + ", points " +
              std::to_string(request_.pixels.points) + (request_.pixels.rotate ? ", rotated" : "");
    }
    return request_.rough() ? text + ", seed " + std::to_string(request_.seed) : text;
  }

  int pair() {
    const auto from = row_of(model_, request_.pair.first), to = row_of(model_, request_.pair.second);
    for (const auto& [row, word] : {std::pair(from, request_.pair.first), std::pair(to, request_.pair.second)}) {
      if (row) continue;
      std::vector<std::string> names;
      for (const ComposedRow& known : model_.rows) names.push_back(known.name);
      return options_.usage_error(err_, "--pair: found '" + word +
                                            "', expected the name of a surface or a number in [1, " +
                                            std::to_string(names.size()) + "]" + did_you_mean(word, names));
    }
    PairReport report{model_, *from, *to, {}, {}, {}, {}, request_.method, true, {}};
    const Bounded exchange = row_exchange(model_, *from, *to, [&](std::size_t a, std::size_t b) {
      const SurfacePair elements{std::min(a, b), std::max(a, b)};
      Bounded found;
      method_->find({&elements, 1}, {&found, 1}, report.what);
      const auto add_new = [](std::vector<std::string>& names, const std::string& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      };
      for (const std::size_t face : method_->blockers(elements)) add_new(report.blockers, model_.blocker_name(face));
      add_new(report.manners, method_->manner(elements));
      return found;
    });
    ExchangeMatrix two({model_.rows[*from].area, model_.rows[*to].area});
    two.set(0, 1, exchange);
    report.forth = two.factor(0, 1);
    report.back = two.factor(1, 0);
    report.reached = reached(exchange, two.areas()[0], two.areas()[1], request_.tolerance);
    if (request_.common.json) {
      out_ << pair_report_json(report);
    } else if (!request_.common.quiet) {
      print_pair_report(out_, report);
    }
    if (report.reached) return 0;
    return missed("the factor's bound " + shortest(std::max(report.forth.bound, report.back.bound)) +
                  " exceeds what was asked for");
  }

  // The whole matrix.

  fs::path checkpoint_path() const { return request_.common.output.string() + ".checkpoint"; }

  /// Rough methods look around first: what would be refused afterwards is refused before.
  Result<Done> resumable() const {
    std::error_code absent;
    if (!request_.resume || !request_.rough() || !fs::exists(checkpoint_path(), absent)) return Done{};
    const auto opened = open_checkpoint(checkpoint_path(), checkpoint_key(model_, settings()), areas_of(model_),
                                        CheckpointStart::resume);
    if (!opened) return opened.error();
    return Done{};
  }

  Result<ExchangeMatrix> begun() const {
    std::vector<double> areas = areas_of(model_);
    if (request_.common.output.empty()) return ExchangeMatrix(std::move(areas));
    if (std::error_code absent; request_.resume && !fs::exists(checkpoint_path(), absent)) {
      err_ << "etendue form-factors: nothing to resume, beginning anew: there is no " << quoted_path(checkpoint_path())
           << '\n';
    }
    return open_checkpoint(checkpoint_path(), checkpoint_key(model_, settings()), std::move(areas),
                           request_.resume ? CheckpointStart::resume : CheckpointStart::fresh);
  }

  bool fill(ExchangeMatrix& matrix) {
    Progress progress(err_, "form factors", request_.common);
    const double pairs = static_cast<double>(matrix.layout().pairs());
    const double memory = static_cast<double>(exchange_bytes(matrix.layout()));
    const std::size_t before = matrix.tiles_done();
    const auto begin = Clock::now();
    progress.annotate([=](std::size_t done, std::size_t total) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      const double share = static_cast<double>(done - std::min(done, before)) / static_cast<double>(total);
      char text[96];
      std::snprintf(text, sizeof text, ", %.3g pairs/s, %.0f s left, %.3g MB", share * pairs / seconds,
                    seconds * static_cast<double>(total - done) / std::max(1.0, static_cast<double>(done - before)),
                    memory / 1e6);
      return std::string(text);
    });
    return fill_exchanges(matrix, *method_, request_.tolerance, execution(request_.common, progress));
  }

  int matrix() {
    auto opened = begun();
    if (!opened) return fail(opened.error());
    ExchangeMatrix elements = std::move(opened).value();
    if (!fill(elements)) return stopped(elements);
    ExchangeMatrix rows = model_.plain() ? elements : composed(model_, elements);
    RowClosure closure = row_closure(rows);
    std::vector<std::string> remarks = buried_remark(model_, closure);
    if (request_.repair) {
      auto repair = repaired(rows, closure);
      if (!repair) return fail_kept(repair.error());
      remarks.push_back(repair_remark(repair->report));
      rows = std::move(repair).value().matrix;
      closure = row_closure(rows);
    }
    const std::uint64_t beyond = beyond_tolerance(rows);
    if (request_.drop > 0) {
      if (const auto apart = rows.detach(); !apart) return fail(apart.error());  // the checkpoint stays as computed
      const DropReport dropped = drop_below(rows, request_.drop);
      remarks.push_back("dropped: " + std::to_string(dropped.pairs) + " pairs below " + shortest(request_.drop) +
                        "; row " + std::to_string(dropped.row + 1) + " loses most, " + shortest(dropped.largest_share) +
                        "; their bounds grew by what they were");
      closure = row_closure(rows);
    }
    if (const auto written = write(rows, closure); !written) return fail_kept(written.error());
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const MatrixReport report{
        model_,  rows,   closure, request_.method, request_.tolerance, request_.scene, request_.common.output,
        remarks, seconds};
    if (request_.common.json) {
      out_ << matrix_report_json(report);
    } else if (!request_.common.quiet) {
      print_matrix_report(out_, report);
    }
    if (beyond == 0) return 0;
    return missed(std::to_string(beyond) + " pairs have bounds beyond what was asked for, the largest is " +
                  shortest(closure.largest_bound) + " from surface " + std::to_string(closure.loosest_from + 1) + " '" +
                  printable(model_.rows[closure.loosest_from].name) + "' to " + std::to_string(closure.loosest_to + 1) +
                  " '" + printable(model_.rows[closure.loosest_to].name) + "'");
  }

  std::string repair_remark(const RepairReport& repair) const {
    return "closure repaired: " + std::to_string(repair.changed) + " pairs changed, " + std::to_string(repair.beyond) +
           " of them by more than their bounds, " + std::to_string(repair.at_zero) + " held at zero; largest change " +
           shortest(repair.largest_change) + " from surface " + std::to_string(repair.from + 1) + " to " +
           std::to_string(repair.to + 1) + "; largest row defect " + shortest(repair.defect_before) + " before, " +
           shortest(repair.defect_after) + " after; bounds grew by the changes";
  }

  /// Pairs of rows that miss the tolerance. Rows that are elements, and as computed, were judged when they were found.
  std::uint64_t beyond_tolerance(const ExchangeMatrix& rows) const {
    if (model_.plain() && !request_.repair) return rows.report().beyond;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = i; j < rows.size(); ++j) {
        const Bounded exchange{rows.exchange(i, j), rows.exchange_bound(i, j)};
        count += !reached(exchange, rows.areas()[i], rows.areas()[j], request_.tolerance);
      }
    }
    return count;
  }

  Result<Done> write(const ExchangeMatrix& rows, const RowClosure& closure) const {
    const fs::path& output = request_.common.output;
    if (output.empty()) return Done{};
    MatrixFacts facts{std::string("etendue ") + version(),
                      request_.method,
                      model_.name,
                      model_.hash,
                      model_.metres_per_unit,
                      request_.tolerance,
                      {},
                      {},
                      request_.repair};
    for (const ComposedRow& row : model_.rows) {
      facts.names.push_back(row.name);
      facts.emittances.push_back(row.emittance);
    }
    const auto written = write_form_factors(output, rows, closure, facts);
    if (!written) return written;
    std::error_code gone;  // the matrix is safe: what is left of the checkpoint harms nothing
    fs::remove(checkpoint_path(), gone);
    return Done{};
  }

  int missed(const std::string& what) { return fail({ErrorCode::not_converged, "tolerance not reached: " + what}); }

  /// After all factors were found: they are in the checkpoint still.
  int fail_kept(const Error& error) {
    const int code = fail(error);
    if (!request_.common.output.empty()) {
      err_ << "the form factors are kept in " << printable(checkpoint_path().string())
           << ": --resume takes them from there\n";
    }
    return code;
  }

  int stopped(const ExchangeMatrix& elements) {
    err_ << "etendue form-factors: stopped with " << elements.tiles_done() << " of " << elements.layout().tiles()
         << " tiles of the matrix done; ";
    if (request_.common.output.empty()) {
      err_ << "nothing is kept, since there is no --output\n";
    } else {
      err_ << "--resume goes on with " << printable(checkpoint_path().string()) << '\n';
    }
    return static_cast<int>(ErrorCode::stopped);
  }

  const Options& options_;
  const Request& request_;
  std::ostream& out_;
  std::ostream& err_;
  SurfaceModel model_;
  Clock::time_point begin_;
  std::unique_ptr<const ExchangeMethod> method_;
};

}  // namespace

int form_factors(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  Options options("form-factors", "Find the form factors (view factors) between the surfaces of a scene, with bounds.");
  request.declare(options);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto useless = request.complete()) return options.usage_error(err, *useless);
  return Run(options, request, out, err).run();
}

}  // namespace etendue::cli
