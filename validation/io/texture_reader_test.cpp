// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/image_file.hpp"
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr const char* kBall = R"({"type": "sphere", "material": "t", "centre": [0, 0, 0], "radius": 7})";

std::string with_pattern(const std::string& pattern, const std::string& unit = "in") {
  return R"({"format": "etendue-scene", "version": 1, "unit": ")" + unit +
         R"(", "materials": {"t": {"k_d": 0.5, "pattern": )" + pattern + "}}}";
}

void add_picture(const TemporaryFolder& folder, const char* name, int columns = 3, int rows = 2) {
  Image image(columns, rows);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb::Constant(static_cast<double>(i % 8) / 8);
  ASSERT_TRUE(write_image(folder.path() / name, image).ok());
}

std::string scene_text(const char* object = kBall) {
  return scene_of(object, R"("include": ["t.json"], )", "cm");
}

// CLAIM      IU.4-1: images, squares, clouds and marble are what the file says: lengths in the unit of their own file, defaults as documented; an image is
//            read once however many materials show it, and is found beside the file that names it.
// ORACLE     exact: the documented meaning of each key; an inch is 2.54 centimetres.
// TOLERANCE  two roundings of each length; the image's numbers are eighths.
TEST(TextureReader, HoldsWhatTheFileSays) {
  proves({"IU.4-1", "IU.4.1.2"}, Oracle::exact, "the documented meaning of each key");
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  add_picture(folder, "sub/p.exr");
  const auto material_of = [&](const std::string& pattern) {
    folder.add("sub/t.json", with_pattern(pattern));
    return read(folder, scene_of(kBall, R"("include": ["sub/t.json"], )", "cm")).materials[0];
  };
  const MaterialTexture image =
      material_of(R"({"type": "image", "file": "p.exr", "wrap": "mirror", "tiles": [3, -0.5], "mapping":
                      {"type": "plane", "width": 2, "origin": [1, 0, 0], "pole": [0, 0, 2], "equator": [0, 3, 4]}})")
          .texture.value();
  const auto& shown = std::get<TextureImage>(image.colours);
  EXPECT_TRUE(holds(shown.wraps.u == Wrap::mirror && shown.wraps.v == Wrap::mirror));
  EXPECT_TRUE(holds(image.tiles[0] == 3 && image.tiles[1] == -0.5));
  EXPECT_TRUE(holds(shown.pyramid->columns() == 3 && shown.pyramid->rows() == 2));
  EXPECT_TRUE(near(shown.pyramid->texel(0, 2, 1)[1], 0.625, 0));
  const auto& plane = std::get<LaidOnPlane>(image.laid.value());
  EXPECT_TRUE(near(plane.width, 5.08, 8 * 0x1p-53) && near(plane.height, 5.08, 8 * 0x1p-53));
  EXPECT_TRUE(near(plane.origin.x(), 2.54, 8 * 0x1p-53));
  EXPECT_TRUE(near((plane.frame.equator - Vec3(0, 1, 0)).norm(), 0, 4 * 0x1p-53));  // turned across the pole

  const MaterialTexture plain = material_of(R"({"type": "image", "file": "p.exr"})").texture.value();
  EXPECT_TRUE(
      holds(!plain.laid && plain.tiles[0] == 1 && std::get<TextureImage>(plain.colours).wraps.u == Wrap::repeat));
  const MaterialTexture squares =
      material_of(R"({"type": "squares", "columns": 5, "seed": 9, "mapping": {"type": "sphere"}})").texture.value();
  const auto& colours = std::get<ColourSquares>(squares.colours);
  EXPECT_TRUE(holds(colours.columns == 5 && colours.rows == 16 && colours.seed == 9));
  EXPECT_TRUE(holds(std::holds_alternative<LaidOnSphere>(squares.laid.value())));

  const Material stone = material_of(R"({"type": "marble", "k_d": 0.25, "size": 10, "turbulence": 2, "seed": 3})");
  const auto& marble = std::get<Marble>(stone.pattern.value().pattern);
  EXPECT_TRUE(near(marble.size, 25.4, 64 * 0x1p-53) &&
              holds(marble.turbulence == 2 && marble.seed == 3 && !stone.texture));
  const auto noise = material_of(R"({"type": "noise", "k_d": 0.25, "size": 1, "octaves": 7})").pattern.value();
  EXPECT_TRUE(holds(std::get<Noise>(noise.pattern).octaves == 7 && (noise.k_a == 0.25).all()));

  folder.add("both.json", R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {
    "t": {"pattern": {"type": "image", "file": "sub/p.exr"}}, "w": {"pattern": {"type": "image", "file": "./sub/../sub/p.exr"}}}})");
  const auto both = read_scene(folder.add("scene.json", scene_of(kBall, R"("include": ["both.json"], )")));
  ASSERT_TRUE(both.ok()) << both.error().message;
  const auto pyramid = [&](std::size_t i) {
    return std::get<TextureImage>(both->scene.materials[i].texture->colours).pyramid;
  };
  EXPECT_TRUE(holds(pyramid(0) == pyramid(1) && both->files.size() == 3));
}

// CLAIM      A scene's hash is of its images, too: another picture under the same name makes it another scene.
// ORACLE     metamorphic: the same bytes, other bytes.
// TOLERANCE  none.
TEST(TextureReader, CountsImagesInTheHash) {
  proves({}, Oracle::metamorphic, "the same and another image");
  const TemporaryFolder folder;
  folder.add("t.json", with_pattern(R"({"type": "image", "file": "p.exr"})"));
  const auto scene = folder.add("scene.json", scene_text());
  add_picture(folder, "p.exr");
  const std::string first = read_scene(scene).value().hash;
  EXPECT_TRUE(holds(read_scene(scene).value().hash == first));
  add_picture(folder, "p.exr", 2, 3);
  EXPECT_TRUE(holds(read_scene(scene).value().hash != first));
}

// CLAIM      What is wrong with a texture is said once, at its place: exit 3; where nothing is wrong but that images cannot be read, exit 5.
// ORACLE     exact: the words of each message, and its code.
// TOLERANCE  none.
TEST(TextureReader, RefusesATextureThatIsNone) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  add_picture(folder, "p.exr");
  Image bright(1, 1);
  bright.pixels[0] = {0.5, 3.5, 0.5};
  ASSERT_TRUE(write_image(folder.path() / "bright.exr", bright).ok());
  folder.add("none.png", "no picture");
  const auto refused = [&](const std::string& pattern, const std::string& words, ErrorCode code,
                           const std::string& object = kBall) {
    folder.add("t.json", with_pattern(pattern));
    const auto scene = read_scene(folder.add("scene.json", scene_text(object.c_str())));
    ASSERT_FALSE(scene.ok()) << "taken: " << pattern;
    const std::string& found = scene.error().message;
    EXPECT_TRUE(holds(found.find("t.json:1:") != std::string::npos && found.find(words) != std::string::npos &&
                      found.find("1 error") != std::string::npos && scene.error().code == code))
        << found;
  };
  constexpr auto kInput = ErrorCode::invalid_input, kFile = ErrorCode::input_output;
  const auto image = [](const std::string& more) { return R"({"type": "image", "file": "p.exr", )" + more + "}"; };
  refused(R"({"type": "image", "file": "gone.png"})", "/materials/t/pattern/file: cannot read", kFile);
  refused(R"({"type": "image", "file": "none.png"})", "/materials/t/pattern/file: cannot read", kFile);
  refused(R"({"type": "image", "file": "t.json"})", "pattern/file: found \"t.json\", expected an image", kInput);
  refused(R"({"type": "image", "file": 7})", "pattern/file: found 7", kInput);
  refused(R"({"type": "image", "file": "bright.exr"})",
          "pattern/file: found a value of 3.5 in column 0, row 0 of the image, expected values in [0, 1]", kInput);
  refused(R"({"type": "image"})", "/materials/t/pattern: found no key \"file\"", kInput);
  refused(image(R"("wrap": "again")"), "pattern/wrap: found \"again\"", kInput);
  refused(image(R"("tiles": [1])"), "pattern/tiles: found an array of 1", kInput);
  refused(image(R"("tiles": [1, "x"])"), "pattern/tiles/1: found", kInput);
  refused(image(R"("mapping": {"type": "cone"})"), "pattern/mapping/type: found \"cone\"", kInput);
  refused(image(R"("mapping": {"type": "plane", "width": 0})"), "pattern/mapping/width: found 0", kInput);
  refused(image(R"("mapping": {"type": "plane"})"), "pattern/mapping: found no key \"width\"", kInput);
  refused(image(R"("mapping": {"type": "box", "size": [1, 2]})"), "pattern/mapping/size: found an array of 2", kInput);
  refused(image(R"("mapping": {"type": "sphere", "pole": [1, 0, 0], "equator": [2, 0, 0]})"),
          "mapping/equator: found \"equator\" along \"pole\"", kInput);
  refused(R"({"type": "squares", "columns": 0})", "pattern/columns: found 0", kInput);
  refused(R"({"type": "squares", "seed": -1})", "pattern/seed: found -1", kInput);
  refused(R"({"type": "noise", "k_d": 0, "size": 1, "octaves": 17})", "pattern/octaves: found 17", kInput);
  refused(R"({"type": "marble", "k_d": 0, "size": 1, "turbulence": -1})", "pattern/turbulence: found -1", kInput);

  const auto wrong_mesh = [&](const std::string& texture, const std::string& words) {
    const auto scene = read_scene(folder.add(
        "scene.json",
        scene_of(
            R"({"type": "mesh", "material": "a", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]], "texture": )" +
            texture + "}")));
    EXPECT_TRUE(holds(!scene && scene.error().message.find(words) != std::string::npos)) << texture;
  };
  wrong_mesh("[[0, 0], [1, 0]]",
             "/objects/0/texture: found 2 pairs of numbers, expected one for each of the 3 vertices");
  wrong_mesh("[[0, 0], [1, 0], [0]]", "/objects/0/texture/2: found an array of 1");
  wrong_mesh("[[0, 0], [1, 0], [0, true]]", "/objects/0/texture/2/1: found true");
}

// CLAIM      An image of too many pixels is refused before memory for it is asked for.
// ORACLE     exact: one pixel more than allowed.
// TOLERANCE  none.
TEST(TextureReader, RefusesAnImageThatIsTooLarge) {
  proves({}, Oracle::exact, "six pixels where five are allowed");
  const TemporaryFolder folder;
  add_picture(folder, "p.png");
  EXPECT_TRUE(holds(read_image(folder.path() / "p.png", 6).ok()));
  const auto refused = read_image(folder.path() / "p.png", 5);
  EXPECT_TRUE(holds(!refused && refused.error().code == ErrorCode::invalid_input &&
                    refused.error().message.find("found 3 × 2 pixels, expected at most 5") != std::string::npos));
}

}  // namespace
}  // namespace etendue::validation
