// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/image_file.hpp"

#include <cmath>
#include <limits>

#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

Image random_image(int columns, int rows, std::uint64_t seed) {
  CounterRandom random(seed);
  Image image(columns, rows);
  for (auto& pixel : image.pixels) {
    // Floats of all magnitudes, both signs: every one is held exactly by an EXR.
    for (auto& sample : pixel) {
      const auto mantissa = static_cast<float>(static_cast<double>(random.below(1u << 24)) - (1 << 23));
      sample = std::ldexp(mantissa, static_cast<int>(random.below(120)) - 80);
    }
  }
  return image;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// CLAIM      An EXR gives back every float it was given, bit by bit, row 0 at the top, and the metadata.
// ORACLE     identity: what was written.
// TOLERANCE  none.
TEST(ImageFile, KeepsFloatsAndMetadataInExr) {
  proves({}, Oracle::identity, "what was written");
  const TemporaryFolder folder;
  const Image image = random_image(37, 21, 1);
  const ImageMetadata metadata{
      {"etendue:version", "0.1.0"}, {"etendue:scene", "0123456789abcdef"}, {"etendue:depth", "é 5"}};
  const auto path = folder.path() / "picture.exr";
  ASSERT_TRUE(write_image(path, image, metadata).ok());
  EXPECT_EQ(folder.contents(), "picture.exr");
  EXPECT_EQ(big_endian(read_text(path), 0), 0x762f3101u);  // OpenEXR's magic number

  const auto read = read_image(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->columns, 37);
  ASSERT_EQ(read->rows, 21);
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) wrong += (read->pixels[i] == image.pixels[i]).all() ? 0u : 1u;
  EXPECT_TRUE(all_agree(wrong, image.pixels.size()));
  const auto texts = read_image_metadata(path);
  ASSERT_TRUE(texts.ok());
  for (const auto& pair : metadata) EXPECT_EQ(std::count(texts->begin(), texts->end(), pair), 1) << pair.first;
}

// CLAIM      A PNG holds the nearest of 256 levels of the sRGB curve; values outside [0, 1] take the nearest end.
// ORACLE     closed form: IEC 61966-2-1 in long double; what is read back is decoded by it and compared with what was
//            given.
// TOLERANCE  half a level, and 1e-9 of one for the float in which the level is handed back.
TEST(ImageFile, RoundsPngToTheNearestSrgbLevel) {
  proves({}, Oracle::closed_form, "the sRGB curve in long double");
  const auto encode = [](long double v) {
    return v <= 0.0031308L ? 12.92L * v : 1.055L * std::pow(v, 1 / 2.4L) - 0.055L;
  };
  const TemporaryFolder folder;
  constexpr double kHalfLevel = 0.5 + 1e-9;
  Image image(64, 64);
  CounterRandom random(2);
  for (auto& pixel : image.pixels) {
    for (auto& sample : pixel) sample = std::ldexp(static_cast<double>(random.next() >> 11), -53);
  }
  image.at(0, 0) = {0, 1, 0.5};
  image.at(1, 0) = {-3, 7, 0.0031308};
  const auto path = folder.path() / "picture.png";
  ASSERT_TRUE(write_image(path, image, {{"Description", "a test"}}).ok());
  const auto read = read_image(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double given = std::min(std::max(image.pixels[i][c], 0.0), 1.0);
      const auto level = std::round(255 * encode(read->pixels[i][c]));
      EXPECT_TRUE(within(static_cast<double>(std::abs(level - 255 * encode(given))), kHalfLevel));
    }
  }
  // 0.5 is level 188, as every table of sRGB says.
  EXPECT_EQ(std::lround(255 * srgb_encode(read->at(0, 0)[2])), 188);

  const std::string bytes = read_text(path);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(big_endian(bytes, 16), 64u);  // IHDR: width, height, depth 8, colour type 2 (RGB)
  EXPECT_EQ(big_endian(bytes, 20), 64u);
  EXPECT_EQ(bytes.substr(24, 2), "\x08\x02");
}

// CLAIM      The sRGB curve and its inverse undo each other, and take each of the 256 levels back to itself.
// ORACLE     identity: decode, then encode.
// TOLERANCE  1e-7 within (0, 1): the standard's rounded constants leave a step of 3e-8 at the joint; levels: none.
TEST(ImageFile, InvertsTheSrgbCurve) {
  proves({}, Oracle::identity, "encode after decode");
  constexpr double kStepAtTheJoint = 1e-7;
  std::uint64_t wrong = 0;
  for (int level = 0; level < 256; ++level) {
    if (std::lround(255 * srgb_encode(srgb_decode(level / 255.0))) != level) ++wrong;
  }
  EXPECT_TRUE(all_agree(wrong, 256));
  for (int i = 0; i <= 4096; ++i) EXPECT_TRUE(near(srgb_decode(srgb_encode(i / 4096.0)), i / 4096.0, kStepAtTheJoint));
}

/// The error of a refused write, after which the folder must hold what it held before.
Error refusal(const TemporaryFolder& folder, const std::filesystem::path& path, const Image& image) {
  const std::string before = folder.contents();
  const auto done = write_image(path, image);
  EXPECT_FALSE(done.ok()) << path;
  EXPECT_EQ(folder.contents(), before);
  return done.ok() ? Error{ErrorCode::check_failed, "written"} : done.error();
}

// CLAIM      What cannot be written is refused with its reason, and leaves neither a new file nor a changed one.
// ORACLE     exact: paths and pixels made to fail.
// TOLERANCE  none.
TEST(ImageFile, RefusesWhatItCannotWrite) {
  proves({}, Oracle::exact, "paths and pixels made to fail");
  const TemporaryFolder folder;
  const std::string dir = folder.path().string();
  const Image sound(2, 2);
  Image with_nan(2, 2), too_large(2, 2);
  with_nan.at(1, 0)[2] = std::numeric_limits<double>::quiet_NaN();
  too_large.at(0, 1)[0] = 1e39;
  folder.add("file", "x");
  folder.add("old.exr", "precious");
  std::filesystem::create_directory(folder.path() / "folder.png");

  const Error jpeg = refusal(folder, folder.path() / "a.jpg", sound);
  EXPECT_EQ(jpeg.code, ErrorCode::usage);
  EXPECT_EQ(jpeg.message, "image '" + dir + "/a.jpg': found extension '.jpg', expected .exr or .png");
  EXPECT_EQ(refusal(folder, folder.path() / "a", sound).code, ErrorCode::usage);
  const Error missing = refusal(folder, folder.path() / "none" / "a.exr", sound);
  EXPECT_EQ(missing.code, ErrorCode::input_output);
  EXPECT_EQ(missing.message, "cannot write '" + dir + "/none/a.exr': there is no folder '" + dir + "/none'");
  EXPECT_EQ(refusal(folder, folder.path() / "file" / "a.png", sound).code, ErrorCode::input_output);
  EXPECT_EQ(refusal(folder, folder.path() / "folder.png", sound).message,
            "cannot write '" + dir + "/folder.png': is a directory");
  const Error nan = refusal(folder, folder.path() / "old.exr", with_nan);
  EXPECT_EQ(nan.code, ErrorCode::invalid_input);
  EXPECT_NE(nan.message.find("pixel (column 1, row 0) channel 2: found nan"), std::string::npos) << nan.message;
  EXPECT_EQ(refusal(folder, folder.path() / "new.exr", too_large).code, ErrorCode::invalid_input);
  EXPECT_EQ(refusal(folder, folder.path() / "new.exr", Image()).code, ErrorCode::invalid_input);
  EXPECT_EQ(read_text(folder.path() / "old.exr"), "precious");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 8));
}

// CLAIM      A missing, cut, corrupt, foreign or misnamed picture is an error with a reason, never an empty or a
//            partial image; the error is the only thing said.
// ORACLE     exact: files made to fail.
// TOLERANCE  none.
TEST(ImageFile, RefusesWhatItCannotRead) {
  proves({}, Oracle::exact, "files made to fail");
  const TemporaryFolder folder;
  const Image image = random_image(50, 40, 3);
  ASSERT_TRUE(write_image(folder.path() / "sound.exr", image).ok());
  ASSERT_TRUE(write_image(folder.path() / "sound.png", Image(50, 40)).ok());
  const std::string exr = read_text(folder.path() / "sound.exr"), png = read_text(folder.path() / "sound.png");
  std::string corrupt = png;  // a wrong byte amid the compressed pixels, where the checksum of the chunk sees it
  corrupt[png.find("IDAT") + 8] ^= 0x55;
  const std::vector<std::filesystem::path> broken{
      folder.path() / "missing.exr",
      folder.add("empty.exr", ""),
      folder.add("empty.png", ""),
      folder.add("text.png", "not a picture"),
      folder.add("cut.exr", exr.substr(0, exr.size() / 2)),
      folder.add("cut.png", png.substr(0, png.size() / 2)),
      folder.add("corrupt.png", corrupt),
      folder.add("head.exr", exr.substr(0, 20)),
      folder.add("really_png.exr", png),
      folder.add("really_exr.png", exr),
      folder.add("sound.gif", png),
      folder.path(),
  };
  std::uint64_t wrong = 0;
  for (const auto& path : broken) {
    ::testing::internal::CaptureStderr();
    const auto read = read_image(path);
    // libpng would print a line of its own.
    const std::string printed = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(printed, "") << path;
    if (read || !printed.empty()) ++wrong;
    EXPECT_FALSE(read.ok()) << path;
    const std::string message = read ? "" : read.error().message;
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  }
  EXPECT_EQ(read_image(broken[0]).error().message,
            "cannot read '" + broken[0].string() + "': No such file or directory");
  EXPECT_TRUE(all_agree(wrong, broken.size()));
}

}  // namespace
}  // namespace etendue::validation
