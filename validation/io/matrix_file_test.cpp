// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/matrix_file.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

// A matrix with awkward numbers: thirds, a tiny factor, zeros.
ExchangeMatrix awkward() {
  ExchangeMatrix matrix({3, 0.7, 1e-3});
  matrix.set(0, 1, {1.0 / 3, 1e-12});
  matrix.set(0, 2, {1e-3 * 1e-17 / 7, 1e-25});
  for (std::size_t tile = 0; tile < matrix.layout().tiles(); ++tile) matrix.close(tile, {});
  return matrix;
}

std::string written(const TemporaryFolder& folder, const std::string& name) {
  const ExchangeMatrix matrix = awkward();
  const MatrixFacts facts{"etendue x",          "exact",       "a \"scene\"", "00ff", 1.0, {1e-6, 1e-9},
                          {"a", "b\n", "\xff"}, {0.9, 0.5, 1}, false};
  const auto done = write_form_factors(folder.path() / name, matrix, row_closure(matrix), facts);
  EXPECT_TRUE(done.ok()) << (done ? "" : done.error().message);
  return read_text(folder.path() / name);
}

std::vector<double> expected() {
  const double third = 1.0 / 3, tiny = 1e-3 * 1e-17 / 7;
  return {0, third / 3, tiny / 3, third / 0.7, 0, 0, tiny / 1e-3, 0, 0};
}

// CLAIM      .csv has n rows of n numbers that read back to the same doubles, row i holding the factors from i.
// ORACLE     exact: the doubles that were stored, divided here.
// TOLERANCE  none.
TEST(MatrixFile, CsvReadsBackToTheSameDoubles) {
  proves({}, Oracle::exact, "the doubles themselves");
  const TemporaryFolder folder;
  std::istringstream lines(written(folder, "m.csv"));
  std::vector<double> found;
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) found.push_back(std::stod(cell));
  }
  EXPECT_EQ(rows, 3u);
  EXPECT_TRUE(holds(found == expected()));
}

// CLAIM      .npy is NumPy's format 1.0: magic, version, a header of Python text that ends the 64-byte block with a newline,
//            then little-endian doubles, row by row.
// ORACLE     exact: the format's published layout, taken apart here byte by byte.
// TOLERANCE  none.
TEST(MatrixFile, NpyHasThePublishedLayout) {
  proves({}, Oracle::exact, "NumPy's published layout");
  const TemporaryFolder folder;
  const std::string bytes = written(folder, "m.npy");
  ASSERT_GT(bytes.size(), 10u);
  EXPECT_TRUE(holds(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8)));
  const std::size_t length = static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  EXPECT_TRUE(holds((10 + length) % 64 == 0 && bytes[9 + length] == '\n'));
  const std::string header = bytes.substr(10, length);
  EXPECT_TRUE(holds(header.find("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }") == 0));
  ASSERT_EQ(bytes.size(), 10 + length + 9 * 8);
  std::vector<double> found(9);
  for (std::size_t k = 0; k < 9; ++k) {
    std::uint64_t word = 0;
    for (std::size_t b = 0; b < 8; ++b) {
      word |= std::uint64_t{static_cast<unsigned char>(bytes[10 + length + 8 * k + b])} << (8 * b);
    }
    found[k] = std::bit_cast<double>(word);
  }
  EXPECT_TRUE(holds(found == expected()));
}

// CLAIM      .mtx is a MatrixMarket coordinate file: it announces as many entries as it has, counted from 1, and leaves out
//            zeros only.
// ORACLE     exact: the doubles that were stored.
// TOLERANCE  none.
TEST(MatrixFile, MtxListsWhatIsNotZero) {
  proves({}, Oracle::exact, "the doubles themselves");
  const TemporaryFolder folder;
  std::istringstream text(written(folder, "m.mtx"));
  std::string banner, line;
  std::getline(text, banner);
  EXPECT_TRUE(holds(banner == "%%MatrixMarket matrix coordinate real general"));
  while (text.peek() == '%') std::getline(text, line);
  std::size_t rows = 0, columns = 0, entries = 0, count = 0;
  text >> rows >> columns >> entries;
  std::vector<double> found(9, 0.0);
  for (std::size_t i = 0, j = 0; text >> i >> j; ++count) {
    std::string value;
    text >> value;
    found.at((i - 1) * 3 + j - 1) = std::stod(value);
  }
  EXPECT_TRUE(holds(rows == 3 && columns == 3 && entries == count && count == 4));
  EXPECT_TRUE(holds(found == expected()));
}

// CLAIM      .json is JSON whatever names hold, with areas, names, F, bounds and row defects.
// ORACLE     exact: another parser (nlohmann::json) and the doubles that were stored.
// TOLERANCE  none for F; row sums 4 roundings.
TEST(MatrixFile, JsonHoldsBoundsAndDefects) {
  proves({}, Oracle::exact, "the doubles themselves");
  const TemporaryFolder folder;
  const auto json = nlohmann::json::parse(written(folder, "m.json"));
  std::vector<double> found;
  for (const auto& row : json.at("F")) {
    for (const double value : row) found.push_back(value);
  }
  EXPECT_TRUE(holds(found == expected()));
  EXPECT_TRUE(holds(json.at("areas") == std::vector<double>{3, 0.7, 1e-3}));
  EXPECT_TRUE(holds(json.at("names").size() == 3 && json.at("names")[1] == "b\n"));
  EXPECT_TRUE(holds(json.at("bounds").size() == 3 && json.at("n") == 3 && json.at("metres_per_unit") == 1.0));
  EXPECT_TRUE(near(json.at("row_defects")[1], 1 - 1 / 2.1, 0x1p-50));
  EXPECT_GE(json.at("bounds")[0][1].get<double>(), 1e-12 / 3);
}

// CLAIM      .vf has View3D's text layout: a header of 30 characters, areas, rows of six decimal places, emittances.
// ORACLE     exact: the layout as View3D prints it, written out by hand.
// TOLERANCE  none.
TEST(MatrixFile, VfHasView3DsLayout) {
  proves({}, Oracle::exact, "the layout by hand");
  const TemporaryFolder folder;
  const std::string hand =
      "View3D 4.0.0 0 0 0 3          \n3 0.7 0.001\n0.000000 0.111111 0.000000\n0.476190 0.000000 0.000000\n"
      "0.000000 0.000000 0.000000\n0.900 0.500 1.000\n";
  EXPECT_TRUE(holds(written(folder, "m.vf") == hand));
}

// CLAIM      An unknown ending is refused as wrong use, and names the endings; a full device is an error, and no file.
// ORACLE     exact: the messages and the folder's contents.
// TOLERANCE  none.
TEST(MatrixFile, RefusesWhatItCannotWrite) {
  proves({}, Oracle::exact, "the messages");
  EXPECT_TRUE(holds(!check_matrix_path("a.cvs").ok()));
  EXPECT_TRUE(holds(check_matrix_path("a.cvs").error().message.find("did you mean '.csv'?") != std::string::npos));
  const TemporaryFolder folder;
  const ExchangeMatrix matrix = awkward();
  const MatrixFacts facts{"", "", "", "", {}, {}, {"a", "b", "c"}, {1, 1, 1}, false};
  const auto nowhere = write_form_factors(folder.path() / "none" / "a.csv", matrix, row_closure(matrix), facts);
  EXPECT_TRUE(holds(!nowhere.ok() && nowhere.error().code == ErrorCode::input_output));
  EXPECT_EQ(folder.contents(), "");
}

}  // namespace
}  // namespace etendue::validation
