#include <gtest/gtest.h>

#include "scene/tests/scenes.hpp"

namespace vtm::scene {
namespace {

TEST(Dump, OneNodeALine) {
    Scene s = sceneOf(redSquare());
    Item line = redSquare();
    line.path = std::make_shared<const Path>(Path{MoveTo{{0.1, -0.0}}, QuadTo{{1, 2}, {3, 4}},
                                                  CubicTo{{1, 2}, {3, 4}, {5, 6}},
                                                  ArcTo{{1, 2}, 0.5, true, false, {7, 8}}});
    line.transform = translation(3, 4);
    line.opacity = 0.25f;
    StrokeStyle style;
    style.dashes = {2, 1};
    line.geometry = style;
    line.paint = ramp();
    Group group;
    group.opacity = 0.5f;
    group.blend = BlendMode::SoftLight;
    group.children.push_back({line});
    s.root.children.push_back({group});
    EXPECT_EQ(dump(s),
              "scene 20 x 10\n"
              "group\n"
              "  fill nonzero\n"
              "    path #1 M 0 0 L 1 0 L 1 1 L 0 1 Z\n"
              "    rgba(1 0 0 1)\n"
              "  group opacity 0.5 blend soft-light\n"
              "    stroke 1 butt miter limit 4 dashes 2 1 phase 0 opacity 0.25 matrix(1 0 0 1 3 4)\n"
              "      path #2 M 0.1 0 Q 1 2 3 4 C 1 2 3 4 5 6 A 1 2 0.5 1 0 7 8\n"
              "      linear 0 0 1 0 pad 0 rgba(0 0 0 1) 1 rgba(1 1 1 1)\n");
}

TEST(Dump, SelectionsNameTheirSides) {
    Scene s = sceneOf(redSquare());
    auto side = std::make_shared<const Group>(s.root);
    s.root.children.push_back({Select{{unitSquare(), scaling(2, 3), FillRule::EvenOdd}, side, side}});
    s.root.children.push_back({Select{{unitSquare(), identity, StrokeStyle{}}, side, nullptr}});
    EXPECT_EQ(dump(s),
              "scene 20 x 10\n"
              "group\n"
              "  fill nonzero\n"
              "    path #1 M 0 0 L 1 0 L 1 1 L 0 1 Z\n"
              "    rgba(1 0 0 1)\n"
              "  select fill evenodd matrix(2 0 0 3 0 0)\n"
              "    path #2 M 0 0 L 1 0 L 1 1 L 0 1 Z\n"
              "    inside #3\n"
              "      fill nonzero\n"
              "        path #1\n"
              "        rgba(1 0 0 1)\n"
              "    outside #3\n"
              "  select stroke 1 butt miter limit 4\n"
              "    path #4 M 0 0 L 1 0 L 1 1 L 0 1 Z\n"
              "    inside #3\n"
              "    outside none\n");
}

TEST(Dump, MaterialsByNameAndSize) {
    Item item = redSquare();
    item.paint = Material{"wood", "12345", {1, 0, 0, 0.5f}, scaling(2, 2)};
    EXPECT_NE(dump(sceneOf(item)).find("    material wood 5 bytes rgba(1 0 0 0.5) matrix(2 0 0 2 0 0)\n"),
              std::string::npos);
}

TEST(Dump, SharedPartsOnce) {
    const Item item = redSquare();
    Scene s = sceneOf(item);
    s.root.children.push_back({item});
    auto content = std::make_shared<Group>();
    content->children.push_back({item});
    Item tiled = item;
    tiled.paint = Pattern{{0, 0}, {2, 2}, content, scaling(2, 2)};
    s.root.children.push_back({tiled});
    auto clip = std::make_shared<Clip>();
    clip->shapes.push_back({item.path, identity, FillRule::EvenOdd, nullptr});
    s.root.clip = clip;
    s.root.mask = std::make_shared<const Mask>(Mask{content, MaskKind::Luminance, true});
    EXPECT_EQ(dump(s),
              "scene 20 x 10\n"
              "group\n"
              "  clip #1\n"
              "    shape evenodd\n"
              "      path #2 M 0 0 L 1 0 L 1 1 L 0 1 Z\n"
              "  mask #3 luminance linear\n"
              "    group #4\n"
              "      fill nonzero\n"
              "        path #2\n"
              "        rgba(1 0 0 1)\n"
              "  fill nonzero\n"
              "    path #2\n"
              "    rgba(1 0 0 1)\n"
              "  fill nonzero\n"
              "    path #2\n"
              "    rgba(1 0 0 1)\n"
              "  fill nonzero\n"
              "    path #2\n"
              "    pattern 0 0 2 2 matrix(2 0 0 2 0 0)\n"
              "      group #4\n");
}

TEST(Dump, OtherPaints) {
    auto bitmap = std::make_shared<image::Bitmap>();
    bitmap->width = 2;
    bitmap->height = 3;
    Item item = redSquare();
    item.paint = ImagePaint{bitmap, ImageFilter::Nearest, identity};
    EXPECT_NE(dump(sceneOf(item)).find("    image #2 2 x 3 nearest\n"), std::string::npos);
    item.paint = rings();
    EXPECT_NE(dump(sceneOf(item)).find("    radial 0 0 2 1 0 0.5 reflect 0 rgba(0 0 0 1) 1 rgba(1 1 1 1)\n"),
              std::string::npos);
}

TEST(Dump, MissingPartsAreNamed) {
    Item item;
    item.paint = Pattern{{0, 0}, {1, 1}, nullptr, identity};
    const std::string text = dump(sceneOf(item));
    EXPECT_NE(text.find("path none\n"), std::string::npos);
    EXPECT_NE(text.find("group none\n"), std::string::npos);
}

}  // namespace
}  // namespace vtm::scene
