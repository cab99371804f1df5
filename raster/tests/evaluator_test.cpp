#include <vtm/raster/evaluator.hpp>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
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
    const std::vector<View> all = views(asset);
    for (const bool keeps : {false, true}) {
        const Evaluator evaluator(asset, {keeps});
        std::vector<image::Raster> drawn(2 * all.size());
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 0; i < drawn.size(); ++i)
                threads.emplace_back([&, i] {
                    const View& view = all[i % all.size()];
                    drawn[i] = evaluator.draw(view);
                    std::vector<std::uint8_t> bytes(drawn[i].rgba.size());
                    evaluator.drawBox(view, {{4, 5}, {30, 20}}, {bytes.data(), std::size_t(view.width) * 4});
                });
        }
        for (std::size_t i = 0; i < drawn.size(); ++i)
            EXPECT_EQ(drawn[i].rgba, evaluate(asset, all[i % all.size()]).rgba) << i;
    }
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

// ---- from one asset to the next -------------------------------------------------------------------

/// The same picture with a part of it in place of another.
Asset changed(std::string_view from, std::string_view to) {
    std::string svg(filtered);
    svg.replace(svg.find(from), from.size(), to);
    return assetOf(svg);
}

/// That says of all maps that they are what they were.
Difference nothing(const Asset& asset) {
    Difference difference;
    for (std::uint32_t i = 0; i < asset.maps.size(); ++i)
        difference.maps.push_back({i, {}, false});
    return difference;
}

using Bytes = std::vector<std::uint8_t>;

/// `target`: of the view.
void drawBox(const Evaluator& evaluator, const View& view, const PixelBox& box, Bytes& target) {
    evaluator.drawBox(view, box, {target.data(), std::size_t(view.width) * 4});
}
Bytes bytesOf(const Evaluator& evaluator, const View& view) {
    Bytes bytes(std::size_t(view.width) * std::size_t(view.height) * 4);
    evaluator.draw(view, {bytes.data(), std::size_t(view.width) * 4});
    return bytes;
}

TEST(Evaluator, GoesOnToTheNextAsset) {
    const Asset first = assetOf(filtered), next = changed("r=\"14\"", "r=\"10\"");
    Evaluator evaluator(first);
    const View view = turned(first, 0.4, 64);
    evaluator.draw(view);
    evaluator.update(next, {});
    EXPECT_EQ(evaluator.draw(view).rgba, evaluate(next, view).rgba);
}

/// A difference that is wrong shows it.
TEST(Evaluator, TakesOverBoundariesOfMapsThatStayed) {
    const Asset first = assetOf(filtered), next = changed("M20 50", "M24 44");
    ASSERT_EQ(first.maps.size(), next.maps.size());  // and their places
    const View view = turned(first, 0.4, 64);
    ASSERT_NE(evaluate(first, view).rgba, evaluate(next, view).rgba);
    Evaluator evaluator(first);
    evaluator.draw(view);
    evaluator.update(next, nothing(next));
    EXPECT_EQ(evaluator.draw(view).rgba, evaluate(first, view).rgba);
}

/// Between assets whose maps are alike, but in another order.
TEST(Evaluator, TakesOverWhatStandsElsewhereNow) {
    const std::string_view under =
        "<circle cx=\"30\" cy=\"30\" r=\"14\" fill=\"#264\" filter=\"url(#soft)\"/>";
    const Asset first = assetOf(filtered);
    const Asset next = changed(under, std::string(under) + std::string(under));
    ASSERT_EQ(first.maps.size() + 1, next.maps.size());
    Difference difference = nothing(next);  // the second circle is new
    for (std::uint32_t i = 2; i < next.maps.size(); ++i)
        difference.maps[i].before = i == 2 ? MapChange::isNew : i - 1;
    const View view = turned(first, 0.4, 64);
    for (const bool keeps : {false, true}) {
        Evaluator evaluator(first, {keeps});
        bytesOf(evaluator, view);
        evaluator.update(next, difference);
        Bytes boxes(64 * 64 * 4);
        drawBox(evaluator, view, {{0, 0}, {64, 64}}, boxes);
        EXPECT_EQ(boxes, bytesOf(Evaluator(next), view)) << keeps;
    }
}

/// A box of the view that the blurred circle meets.
constexpr PixelBox someBox{{20, 24}, {50, 44}};

TEST(Evaluator, DrawsBoxesFromWhatFiltersMade) {
    const Asset first = assetOf(filtered), next = changed("#264", "#c64");
    const View view = turned(first, 0, 64);
    const Bytes before = bytesOf(Evaluator(first), view);
    for (const bool keeps : {false, true}) {
        Evaluator evaluator(first, {keeps});
        bytesOf(evaluator, view);
        evaluator.update(next, nothing(next));  // which is wrong
        Bytes bytes = before;
        drawBox(evaluator, view, someBox, bytes);
        EXPECT_EQ(bytes == before, keeps);
        // Under another view nothing is known.
        const View other = turned(first, 0, 65);
        Bytes ofOther(65 * 65 * 4), fresh(65 * 65 * 4);
        drawBox(evaluator, other, someBox, ofOther);
        drawBox(Evaluator(next), other, someBox, fresh);
        EXPECT_EQ(ofOther, fresh);
        EXPECT_EQ(bytesOf(evaluator, view), bytesOf(Evaluator(next), view));
    }
}

/// What changed in a filter's input is drawn anew where it shows, and known from then on.
TEST(Evaluator, KeepsWhatBoxesShowed) {
    const Asset first = assetOf(filtered), next = changed("#264", "#c64");
    const View view = turned(first, 0, 64);
    const Bytes before = bytesOf(Evaluator(first), view), after = bytesOf(Evaluator(next), view);
    Evaluator evaluator(first, {true});
    bytesOf(evaluator, view);
    Difference difference = nothing(next);
    difference.maps[1].paints = true;  // the circle's
    difference.areas = {{20, 24, 50, 44}};
    evaluator.update(next, difference);
    Bytes bytes = before;
    drawBox(evaluator, view, someBox, bytes);
    EXPECT_NE(bytes, before);
    const auto expectBox = [&](const Bytes& drawn) {
        for (int y = someBox.min.y; y < someBox.max.y; ++y)
            for (int i = 4 * someBox.min.x; i < 4 * someBox.max.x; ++i)
                ASSERT_NEAR(drawn[std::size_t(y * 64 * 4 + i)], after[std::size_t(y * 64 * 4 + i)], 2);
    };
    expectBox(bytes);
    // Back to the first asset's colour, which is not said: the box shows what it showed.
    evaluator.update(first, nothing(first));
    Bytes again = before;
    drawBox(evaluator, view, someBox, again);
    expectBox(again);
}

/// 64 MiB of pixels.
TEST(Evaluator, KeepsNoMoreThanItMay) {
    constexpr std::string_view all =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 8 8"><filter id="f"><feOffset dx="0"/></filter>
<rect width="8" height="8" fill="#264" filter="url(#f)"/></svg>)svg";
    const Asset first = assetOf(all);
    std::string other(all);
    other.replace(other.find("#264"), 4, "#c64");
    const Asset next = assetOf(other);
    for (const int side : {2048, 2049}) {
        const View view{side, side, {side / 8.0, 0, 0, side / 8.0, 0, 0}};
        Evaluator evaluator(first, {true});
        const Bytes before = bytesOf(evaluator, view);
        evaluator.update(next, nothing(next));  // which is wrong
        Bytes bytes = before;
        drawBox(evaluator, view, someBox, bytes);
        EXPECT_EQ(bytes == before, side == 2048) << side;
    }
}

}  // namespace
}  // namespace vtm::asset::test
