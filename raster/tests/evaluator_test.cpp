#include <vtm/raster/evaluator.hpp>

#include <cmath>
#include <span>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <glm/mat2x2.hpp>
#include <glm/mat3x2.hpp>

#include <vtm/compiler/compile.hpp>
#include <vtm/image/bitmap.hpp>
#include <vtm/svg/load.hpp>

namespace vtm::asset::test {
namespace {

/// Maps by themselves between filters, translucent and blended ones too.
constexpr std::string_view filtered = R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64">
<filter id="soft"><feGaussianBlur stdDeviation="2"/></filter>
<filter id="moved"><feOffset dx="3" dy="-2.5"/></filter>
<linearGradient id="ramp"><stop stop-color="#f80"/><stop offset="1" stop-color="#08f" stop-opacity=".3"/></linearGradient>
<rect x="4" y="4" width="40" height="50" fill="url(#ramp)"/>
<circle cx="30" cy="30" r="14" fill="#264" filter="url(#soft)"/>
<g opacity=".6"><path d="M10 60L40 20L60 58Z" fill="#a22"/><path d="M20 50L30 20L60 30Z" fill="#22a"/></g>
<ellipse cx="44" cy="20" rx="16" ry="9" fill="url(#ramp)" filter="url(#moved)"/>
<path d="M2 2H50L30 40Z" fill="#ff8" style="mix-blend-mode:multiply"/>
</svg>)svg";

Asset assetOf(std::string_view svg) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(svg.data());
    return compiler::compile(svg::load({bytes, svg.size()}).scene).asset;
}

View turned(const Asset& asset, double angle, int side) {
    const double scale = side / asset.width, c = scale * std::cos(angle), s = scale * std::sin(angle);
    const glm::dvec2 middle(asset.width / 2, asset.height / 2);
    glm::dmat3x2 toPixels(c, s, -s, c, 0, 0);
    toPixels[2] = 0.5 * glm::dvec2(side) - glm::dmat2(toPixels[0], toPixels[1]) * middle;
    return {side, side, toPixels};
}

std::vector<View> views(const Asset& asset) {
    return {turned(asset, 0, 64), turned(asset, 0.4, 64), turned(asset, -1.1, 200),
            turned(asset, 1.5707963, 33)};
}

TEST(Evaluator, DrawsAgainWhatEvaluateDraws) {
    const Asset asset = assetOf(filtered);
    ASSERT_FALSE(asset.filters.empty());
    const Evaluator evaluator(asset);
    for (const View& view : views(asset))
        for (int again = 0; again < 2; ++again)
            EXPECT_EQ(evaluator.draw(view).rgba, evaluate(asset, view).rgba) << view.width << ' ' << again;
}

TEST(Evaluator, ServesSeveralThreads) {
    const Asset asset = assetOf(filtered);
    const Evaluator evaluator(asset);
    const std::vector<View> all = views(asset);
    std::vector<image::Raster> drawn(2 * all.size());
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < drawn.size(); ++i)
            threads.emplace_back([&, i] { drawn[i] = evaluator.draw(all[i % all.size()]); });
    }
    for (std::size_t i = 0; i < drawn.size(); ++i)
        EXPECT_EQ(drawn[i].rgba, evaluate(asset, all[i % all.size()]).rgba) << i;
}

/// What lies over others as a map of its own is what it is on a picture that is blended.
TEST(Evaluator, MapsLieOverOthersAsPicturesDo) {
    Asset asset = assetOf(filtered);
    const View view = turned(asset, 0.4, 64);
    const image::Raster laid = evaluate(asset, view);
    // A picture of no pixels between the map and the end of its picture.
    std::vector<Command> commands;
    int apart = 0;
    for (std::size_t i = 0; i < asset.commands.size(); ++i) {
        commands.push_back(asset.commands[i]);
        if (i > 0 && asset.commands[i].kind == Command::Kind::DrawMap &&
            asset.commands[i - 1].kind == Command::Kind::Push) {
            commands.push_back({Command::Kind::Push});
            commands.push_back({Command::Kind::Pop});
            ++apart;
        }
    }
    ASSERT_GT(apart, 0);
    asset.commands = commands;
    EXPECT_EQ(evaluate(asset, view).rgba, laid.rgba);
}

TEST(Evaluator, GivesBytesAndRowsOfTheSamePicture) {
    const Asset asset = assetOf(filtered);
    const Evaluator evaluator(asset);
    const View view = turned(asset, 0.4, 64);
    const image::Raster drawn = evaluator.draw(view);
    std::vector<std::uint8_t> bytes(drawn.rgba.size(), 1);
    evaluator.draw(view, ByteTarget{bytes.data(), std::size_t(view.width) * 4});
    std::vector<float> rows;
    evaluator.scan(view,
                   [&](std::span<const float> row) { rows.insert(rows.end(), row.begin(), row.end()); });
    EXPECT_EQ(rows, drawn.rgba);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        ASSERT_EQ(bytes[i], std::uint8_t(drawn.rgba[i] * 255 + 0.5f)) << i;
}

}  // namespace
}  // namespace vtm::asset::test
