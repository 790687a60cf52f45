// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/checkpoint.hpp"

#include <atomic>
#include <fstream>

#include "etendue/assembly/drop.hpp"
#include "etendue/assembly/exact_exchange.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

constexpr Tolerance kTolerance{1e-6, 1e-9};

SurfaceModel model_of_room(double height) {
  Scene scene = room_of({0, 0, 0}, {2, 1, 1});
  for (auto& object : scene.objects) object.subdivision = {{3, 2}, {1, 1}};
  scene.objects.push_back(
      {"screen", quadrilateral({0.9, 0.1, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, height}, {0.9, 0.1, height}), 0, {}});
  return *surface_model(scene);
}

/// Fills at most `tiles` more tiles of the matrix in `path`, and returns it.
Result<ExchangeMatrix> advanced(const std::filesystem::path& path, const SurfaceModel& model, std::size_t tiles,
                                CheckpointStart start) {
  auto opened = open_checkpoint(path, checkpoint_key(model, "test"), areas_of(model.mesh), start);
  if (!opened) return opened.error();
  ExchangeMatrix matrix = std::move(opened).value();
  std::atomic<bool> stop{tiles == 0};
  const std::size_t before = matrix.tiles_done();
  const auto after_some = [&](std::size_t done, std::size_t) { stop = done >= before + tiles; };
  const ExactExchange method(model.mesh, {kTolerance, kTolerance});
  fill_exchanges(matrix, method, kTolerance, {1, after_some, &stop});
  return matrix;
}

bool same(const ExchangeMatrix& a, const ExchangeMatrix& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i; j < a.size(); ++j) {
      if (a.exchange(i, j) != b.exchange(i, j) || a.exchange_bound(i, j) != b.exchange_bound(i, j)) return false;
    }
  }
  return a.report().obstructed == b.report().obstructed && a.report().defect == b.report().defect;
}

ExchangeMatrix in_memory(const SurfaceModel& model) {
  ExchangeMatrix matrix(areas_of(model.mesh));
  fill_exchanges(matrix, ExactExchange(model.mesh, {kTolerance, kTolerance}), kTolerance, {});
  return matrix;
}

// CLAIM      A matrix that was stopped twice and went on in its file has the bits of one made in memory at once; tiles whose
//            bytes were damaged in between are computed anew.
// ORACLE     metamorphic: the matrix made at once.
// TOLERANCE  none: equality of doubles.
TEST(Checkpoint, GoesOnToTheSameBits) {
  proves({}, Oracle::metamorphic, "the matrix made at once, in memory");
  const TemporaryFolder folder;
  const auto path = folder.path() / "room.checkpoint";
  const SurfaceModel model = model_of_room(0.8);
  const ExchangeMatrix whole = in_memory(model);
  ASSERT_TRUE(advanced(path, model, 20, CheckpointStart::fresh).ok());
  ASSERT_TRUE(advanced(path, model, 30, CheckpointStart::resume).ok());
  {
    // Bytes in the middle of the exchange areas, as a torn write would leave them.
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const std::size_t records = whole.layout().tiles() * sizeof(TileRecord);
    file.seekp(4096 + static_cast<std::streamoff>(records + 3 * whole.layout().cells() * sizeof(double)));
    file << "torn write";
  }
  const auto before = advanced(path, model, 0, CheckpointStart::resume);
  ASSERT_TRUE(before.ok());
  EXPECT_TRUE(holds(before->tiles_done() < 50 && before->tiles_done() >= 48)) << before->tiles_done();
  const auto end = [&] {
    // Released before the file is opened again: one run at a time.
    return advanced(path, model, 100000, CheckpointStart::resume);
  };
  EXPECT_FALSE(end().ok()) << "the file is in use by `before`";
  const auto copy = folder.path() / "copy.checkpoint";
  std::filesystem::copy_file(path, copy);
  const auto finished = advanced(copy, model, 100000, CheckpointStart::resume);
  ASSERT_TRUE(finished.ok());
  EXPECT_TRUE(finished->complete());
  EXPECT_TRUE(holds(same(*finished, whole)));
}

// CLAIM      A checkpoint of another geometry, of other settings, of another number of surfaces, cut short, or of another
//            program is refused; the message names the first surface that differs.
// ORACLE     exact: the messages.
// TOLERANCE  none.
TEST(Checkpoint, RefusesWhatItWasNotBegunWith) {
  proves({}, Oracle::exact, "the messages");
  const TemporaryFolder folder;
  const auto path = folder.path() / "room.checkpoint";
  const SurfaceModel model = model_of_room(0.8);
  ASSERT_TRUE(advanced(path, model, 3, CheckpointStart::fresh).ok());
  const auto message = [&](const SurfaceModel& other, const std::string& settings, CheckpointStart start) {
    const auto opened = open_checkpoint(path, checkpoint_key(other, settings), areas_of(other.mesh), start);
    return opened ? std::string("accepted") : opened.error().message;
  };
  const auto says = [](const std::string& found, const std::string& expected) {
    return holds(found.find(expected) != std::string::npos) << found;
  };
  EXPECT_TRUE(says(message(model_of_room(0.7), "test", CheckpointStart::resume), "surface 37 'screen' is the first"));
  EXPECT_TRUE(says(message(model, "other", CheckpointStart::resume), "was begun with 'test', not with 'other'"));
  SurfaceModel fewer = model;
  fewer.mesh.elements.pop_back();
  fewer.rows.pop_back();
  EXPECT_TRUE(says(message(fewer, "test", CheckpointStart::resume), "was begun with"));
  EXPECT_TRUE(says(message(model, "test", CheckpointStart::fresh), "--resume"));
  EXPECT_TRUE(says(message(model, "test", CheckpointStart::resume), "accepted"));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_TRUE(says(message(model, "test", CheckpointStart::resume), "is no checkpoint"));
  std::ofstream(path) << "another file";
  EXPECT_TRUE(says(message(model, "test", CheckpointStart::resume), "is no checkpoint"));
}

// CLAIM      What is dropped from a detached matrix is dropped there only: the checkpoint keeps what was computed, sound.
// ORACLE     metamorphic: the matrix made in memory.
// TOLERANCE  none: equality of doubles.
TEST(Checkpoint, KeepsWhatADetachedMatrixDrops) {
  proves({}, Oracle::metamorphic, "the matrix made at once, in memory");
  const TemporaryFolder folder;
  const auto path = folder.path() / "room.checkpoint";
  const SurfaceModel model = model_of_room(0.8);
  const ExchangeMatrix whole = in_memory(model);
  {
    auto finished = advanced(path, model, 100000, CheckpointStart::fresh);
    ASSERT_TRUE(finished.ok() && finished->complete());
    ExchangeMatrix sparse = std::move(finished).value();
    ASSERT_TRUE(sparse.detach().ok());
    EXPECT_GT(drop_below(sparse, 0.01).pairs, 10u);
    EXPECT_TRUE(holds(sparse.complete() && !same(sparse, whole)));
  }
  const auto again = advanced(path, model, 0, CheckpointStart::resume);
  ASSERT_TRUE(again.ok());
  EXPECT_TRUE(again->complete());
  EXPECT_TRUE(holds(same(*again, whole)));
}

}  // namespace
}  // namespace etendue::validation
