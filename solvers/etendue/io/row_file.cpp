// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/row_file.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/byte_text.hpp"
#include "etendue/text/fingerprint.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

// The file: magic; the key's size and lines; n; n bytes, 1 of each row that is done; of each of these its numbers, then
// its factors and bounds; the fingerprint of all that.
constexpr std::string_view kMagic = "ETENROWS";
constexpr std::uintmax_t kLongestKey = 1 << 16;

/// The counts of a row's report, in a fixed order; its three doubles follow.
std::vector<std::size_t*> counts(RowReport& row) {
  return {&row.pairs.averted,
          &row.pairs.clear,
          &row.pairs.blocked,
          &row.pairs.obstructed,
          &row.reciprocity.pairs,
          &row.reciprocity.refined,
          &row.reciprocity.disagreements,
          &row.missed.pairs,
          &row.missed.first,
          &row.missed.second};
}
std::vector<double*> doubles(RowReport& row) {
  return {&row.reciprocity.defect, &row.missed.bound, &row.missed.allowed};
}

std::string lines(const RowsKey& key) {
  std::string text;
  for (const auto& [name, value] : key) text += name + ": " + value + "\n";
  return text;
}

std::string row_bytes(const FormFactorMatrix& matrix, std::size_t row) {
  std::string bytes;
  RowReport report = matrix.rows[row];
  for (const std::size_t* number : counts(report)) append_little(bytes, static_cast<std::uint64_t>(*number));
  for (const double* number : doubles(report)) append_little(bytes, *number);
  const auto i = static_cast<Eigen::Index>(row);
  for (Eigen::Index j = i + 1; j < matrix.factors.rows(); ++j) {
    append_little(bytes, matrix.factors(i, j));
    append_little(bytes, matrix.bounds(i, j));
  }
  return bytes;
}

/// Takes numbers from a file; what it took is in the fingerprint. After the end of the file everything is zero.
class Reader {
 public:
  explicit Reader(const fs::path& path) : file_(path, std::ios::binary) {}

  bool good() const { return file_.good(); }
  std::uint64_t fingerprint() const { return taken_.value(); }

  std::string text(std::size_t size) {
    std::string bytes(size, '\0');
    file_.read(bytes.data(), static_cast<std::streamsize>(size));
    taken_.add(bytes);
    return bytes;
  }
  std::uint64_t integer() { return read_little<std::uint64_t>(text(8)); }
  double real() { return std::bit_cast<double>(integer()); }

 private:
  std::ifstream file_;
  Fingerprint taken_;
};

/// What the key of a file and that of this run do not share.
std::string difference(std::string_view found, const RowsKey& key) {
  for (const auto& [name, value] : key) {
    const std::string_view line = found.substr(0, found.find('\n'));
    if (line != name + ": " + value) {
      const bool same_name = line.rfind(name + ": ", 0) == 0;
      return "its rows were computed with " +
             printable(same_name ? name + " " + std::string(line.substr(name.size() + 2))
                                 : "'" + std::string(line) + "'") +
             ", not with " + printable((same_name ? "" : name + " ") + value);
    }
    found.remove_prefix(std::min(found.size(), line.size() + 1));
  }
  return "its rows were computed with '" + printable(std::string(found.substr(0, found.find('\n')))) + "' as well";
}

void read_row(Reader& reader, std::size_t row, FormFactorMatrix& matrix) {
  for (std::size_t* number : counts(matrix.rows[row])) *number = reader.integer();
  for (double* number : doubles(matrix.rows[row])) *number = reader.real();
  const auto i = static_cast<Eigen::Index>(row);
  for (Eigen::Index j = i + 1; j < matrix.factors.rows(); ++j) {
    matrix.factors(i, j) = reader.real();
    matrix.bounds(i, j) = reader.real();
  }
}

}  // namespace

Result<Done> write_rows(const fs::path& path, const RowsKey& key, const FormFactorMatrix& matrix) {
  return write_pieces(path, [&](const Append& append) -> Result<Done> {
    Fingerprint whole;
    const auto add = [&](const std::string& bytes) {
      whole.add(bytes);
      return append(bytes);
    };
    const std::string text = lines(key);
    std::string head(kMagic);
    append_little(head, static_cast<std::uint64_t>(text.size()));
    head += text;
    append_little(head, static_cast<std::uint64_t>(matrix.row_done.size()));
    for (const bool done : matrix.row_done) head += done ? '\1' : '\0';
    if (const auto written = add(head); !written) return written;
    for (std::size_t row = 0; row < matrix.row_done.size(); ++row) {
      if (!matrix.row_done[row]) continue;
      if (const auto written = add(row_bytes(matrix, row)); !written) return written;
    }
    std::string end;
    append_little(end, whole.value());
    return append(end);
  });
}

Result<FormFactorMatrix> read_rows(const fs::path& path, const RowsKey& key, std::size_t n) {
  const auto wrong = [&](const std::string& what) {
    return Error{ErrorCode::invalid_input, quoted_path(path) + ": " + what};
  };
  std::error_code unknown;
  const bool regular = fs::is_regular_file(path, unknown);
  Reader reader(path);
  if (!regular || !reader.good()) {
    const auto reason = regular ? std::generic_category().message(errno) : std::string("not a regular file");
    return Error{ErrorCode::input_output, "cannot read " + quoted_path(path) + ": " + reason};
  }
  const Error foreign = wrong("not what a stopped etendue solve has saved; remove it");
  if (reader.text(kMagic.size()) != kMagic) return foreign;
  const std::uint64_t size = reader.integer();
  if (!reader.good() || size > kLongestKey) return foreign;
  const std::string found = reader.text(size);
  if (found != lines(key)) return wrong(difference(found, key));
  if (reader.integer() != n) return wrong("damaged; remove it");
  const std::string done = reader.text(n);
  FormFactorMatrix matrix;
  matrix.factors = matrix.bounds = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  matrix.rows.assign(n, {});
  for (std::size_t row = 0; row < n; ++row) {
    matrix.row_done.push_back(done[row] != '\0');
    if (matrix.row_done[row]) read_row(reader, row, matrix);
  }
  const std::uint64_t expected = reader.fingerprint();
  if (reader.integer() != expected || !reader.good()) return wrong("damaged; remove it");
  return matrix;
}

}  // namespace etendue
