// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/checkpoint.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>

#include "etendue/text/fingerprint.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

constexpr char kMagic[8] = {'E', 'T', 'E', 'N', 'F', 'F', '0', '1'};

/// The file's first bytes; then the settings, the hashes, and from the next page on records, exchanges, bounds.
struct Header {
  char magic[8];
  std::uint64_t elements, surfaces, settings, records, total;  ///< counts; offset of the records; size of the file
  std::uint64_t checksum;                                      ///< of all before the records, this word as 0
};

std::string_view bytes_of(const void* data, std::size_t size) {
  return {static_cast<const char*>(data), size};
}

std::uint64_t hash_of(const Polygon& polygon, std::uint64_t belongs_to) {
  Fingerprint fingerprint;
  fingerprint.add(bytes_of(&belongs_to, sizeof belongs_to));
  for (const Vec3& v : polygon.vertices()) fingerprint.add(bytes_of(v.data(), 3 * sizeof(double)));
  return fingerprint.value();
}

std::uint64_t hash_of(const RoundSurface& round) {
  Fingerprint fingerprint;
  const auto add = [&fingerprint](const auto&... numbers) {
    for (const double number : {numbers...}) fingerprint.add(bytes_of(&number, sizeof number));
  };
  const auto add_point = [&add](const Vec3& p) { add(p.x(), p.y(), p.z()); };
  add(static_cast<double>(round.shape.index()));
  if (const auto* sphere = std::get_if<Sphere>(&round.shape)) {
    add_point(sphere->centre), add(sphere->radius);
  } else if (const auto* disc = std::get_if<Disc>(&round.shape)) {
    add_point(disc->centre), add_point(disc->normal), add(disc->radius);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&round.shape)) {
    add_point(cylinder->base), add_point(cylinder->top), add(cylinder->radius);
  }
  return fingerprint.value();
}

std::size_t page_up(std::size_t offset) {
  constexpr std::size_t kPage = 4096;
  return (offset + kPage - 1) / kPage * kPage;
}

/// All that comes before the records, as it must stand in the file.
std::string head_of(const CheckpointKey& key, const TileLayout& layout) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.elements = layout.surfaces();
  header.surfaces = key.hashes.size();
  header.settings = key.settings.size();
  header.records = page_up(sizeof header + key.settings.size() + key.hashes.size() * sizeof(std::uint64_t));
  header.total = header.records + exchange_bytes(layout);
  std::string head(header.records, '\0');
  std::memcpy(head.data(), &header, sizeof header);
  std::memcpy(head.data() + sizeof header, key.settings.data(), key.settings.size());
  std::memcpy(head.data() + sizeof header + key.settings.size(), key.hashes.data(),
              key.hashes.size() * sizeof(std::uint64_t));
  header.checksum = Fingerprint().add(head).value();
  std::memcpy(head.data(), &header, sizeof header);
  return head;
}

Error failure(const fs::path& path, const std::string& reason, ErrorCode code = ErrorCode::input_output) {
  return {code, "checkpoint " + quoted_path(path) + ": " + reason};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// A mapped file; unmapped and closed, and with that unlocked, when the last user is gone.
struct Mapping {
  int file = -1;
  void* data = MAP_FAILED;
  std::size_t size = 0;
  ~Mapping() {
    if (data != MAP_FAILED) {
      ::msync(data, size, MS_SYNC);
      ::munmap(data, size);
    }
    if (file >= 0) ::close(file);
  }
};

/// What `found`, the head of a file, was begun with that `key` is not.
std::string difference(const std::string& found, const CheckpointKey& key) {
  Header header;
  std::memcpy(&header, found.data(), sizeof header);
  const std::string settings = found.substr(sizeof header, header.settings);
  if (settings != key.settings) return "was begun with '" + printable(settings) + "', not with '" + key.settings + "'";
  const char* hashes = found.data() + sizeof header + header.settings;
  const std::size_t common = std::min<std::size_t>(header.surfaces, key.hashes.size());
  for (std::size_t k = 0; k < common; ++k) {
    if (std::memcmp(hashes + k * sizeof(std::uint64_t), &key.hashes[k], sizeof(std::uint64_t)) == 0) continue;
    return "was begun with another geometry: surface " + std::to_string(k + 1) + " '" + printable(key.names[k]) +
           "' is the first that differs";
  }
  const std::string next = common < key.names.size() ? "; surface '" + printable(key.names[common]) + "' is new" : "";
  return "was begun with " + std::to_string(header.surfaces) + " surfaces and faces, not with " +
         std::to_string(key.hashes.size()) + next;
}

/// The head of an existing file, if it is one of ours.
Result<std::string> read_head(const fs::path& path, int file, std::size_t size) {
  const Error foreign = failure(path, "is no checkpoint of this program; remove it", ErrorCode::invalid_input);
  Header header;
  if (size < sizeof header || ::pread(file, &header, sizeof header, 0) != sizeof header) return foreign;
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.total != size || header.records > size ||
      header.settings > header.records || header.surfaces > header.records / sizeof(std::uint64_t) ||
      sizeof header + header.settings + header.surfaces * sizeof(std::uint64_t) > header.records) {
    return foreign;
  }
  std::string head(header.records, '\0');
  if (::pread(file, head.data(), head.size(), 0) != static_cast<ssize_t>(head.size())) return foreign;
  std::string unsigned_head = head;
  std::memset(unsigned_head.data() + offsetof(Header, checksum), 0, sizeof header.checksum);
  if (Fingerprint().add(unsigned_head).value() != header.checksum) return foreign;
  return head;
}

/// Reserves the file's size and writes its head last, so that a file with a head is whole.
Result<Done> begin(const fs::path& path, int file, const std::string& head, std::size_t total) {
  if (const int error = ::posix_fallocate(file, 0, static_cast<off_t>(total)); error != 0) {
    return failure(path, "cannot reserve " + std::to_string(total) + " bytes: " + reason(error));
  }
  for (std::size_t done = 0; done < head.size();) {
    const ssize_t written = ::pwrite(file, head.data() + done, head.size() - done, static_cast<off_t>(done));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure(path, reason(errno));
    done += static_cast<std::size_t>(written);
  }
  return Done{};
}

}  // namespace

CheckpointKey checkpoint_key(const SurfaceModel& model, const std::string& settings) {
  CheckpointKey key;
  key.settings = settings;
  for (std::size_t k = 0; k < model.mesh.elements.size(); ++k) {
    const Element& element = model.mesh.elements[k];
    key.hashes.push_back(hash_of(element.polygon, element.face));
    key.names.push_back(k < model.rows.size() && model.plain() ? model.rows[k].name : model.face_names[element.face]);
  }
  for (std::size_t k = 0; k < model.mesh.faces.size(); ++k) {
    key.hashes.push_back(hash_of(model.mesh.faces[k].polygon, k));
    key.names.push_back(model.face_names[k]);
  }
  for (const RoundSurface& round : model.rounds) {
    key.hashes.push_back(hash_of(round));
    key.names.push_back(round.name);
  }
  return key;
}

Result<ExchangeMatrix> open_checkpoint(const fs::path& path, const CheckpointKey& key, std::vector<double> areas,
                                       CheckpointStart start) {
  const TileLayout layout(areas.size());
  const std::string head = head_of(key, layout);
  auto mapping = std::make_shared<Mapping>();
  mapping->size = head.size() + exchange_bytes(layout);
  mapping->file =
      ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_CREAT | (start == CheckpointStart::fresh ? O_EXCL : 0), 0666);
  if (mapping->file < 0) {
    if (errno == EEXIST) {
      return failure(path, "is there from a run that did not end; go on with it by --resume, or remove it",
                     ErrorCode::usage);
    }
    return failure(path, reason(errno));
  }
  if (::flock(mapping->file, LOCK_EX | LOCK_NB) != 0) return failure(path, "is in use by another run");
  struct stat status {};
  if (::fstat(mapping->file, &status) != 0) return failure(path, reason(errno));
  if (!S_ISREG(status.st_mode)) return failure(path, "is not a regular file");
  const bool is_new = status.st_size == 0;
  if (is_new) {
    if (const auto begun = begin(path, mapping->file, head, mapping->size); !begun) {
      ::unlink(path.c_str());
      return begun.error();
    }
  } else {
    const auto found = read_head(path, mapping->file, static_cast<std::size_t>(status.st_size));
    if (!found) return found.error();
    if (*found != head) return failure(path, difference(*found, key), ErrorCode::invalid_input);
  }
  mapping->data = ::mmap(nullptr, mapping->size, PROT_READ | PROT_WRITE, MAP_SHARED, mapping->file, 0);
  if (mapping->data == MAP_FAILED) return failure(path, "cannot map it: " + reason(errno));

  char* at = static_cast<char*>(mapping->data) + head.size();
  const std::size_t cells = layout.tiles() * layout.cells();
  ExchangeStorage storage;
  storage.records = {reinterpret_cast<TileRecord*>(at), layout.tiles()};
  storage.exchanges = {reinterpret_cast<double*>(at + layout.tiles() * sizeof(TileRecord)), cells};
  storage.bounds = {reinterpret_cast<float*>(at + layout.tiles() * sizeof(TileRecord) + cells * sizeof(double)), cells};
  storage.keeper = mapping;
  // In its place, so that what points into it stays.
  storage.detach = [whole = mapping.get(), path]() -> Result<Done> {
    if (::msync(whole->data, whole->size, MS_SYNC) != 0) return failure(path, reason(errno));
    constexpr int kKind = MAP_PRIVATE | MAP_FIXED;
    const void* placed = ::mmap(whole->data, whole->size, PROT_READ | PROT_WRITE, kKind, whole->file, 0);
    if (placed == MAP_FAILED) return failure(path, "cannot map it: " + reason(errno));
    return Done{};
  };
  ExchangeMatrix matrix(std::move(areas), std::move(storage));
  for (std::size_t tile = 0; tile < layout.tiles(); ++tile) {
    if (matrix.done(tile) && !matrix.sound(tile)) matrix.reopen(tile);
  }
  return matrix;
}

}  // namespace etendue
