#include "asset/testing.hpp"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace vtm::asset::test {

namespace {

Point discPoint(int i) {
    const double angle = i * std::numbers::pi / 8;
    const glm::dvec2 p = discCentre + discRadius * glm::dvec2(std::cos(angle), std::sin(angle));
    return {std::uint16_t(std::lround(p.x)), std::uint16_t(std::lround(p.y))};
}

template <class Record>
void append(std::vector<Texel>& data, const Record& record) {
    const auto texels = std::bit_cast<std::array<Texel, sizeof(Record) / sizeof(Texel)>>(record);
    data.insert(data.end(), texels.begin(), texels.end());
}

Entry solidEntry(std::uint32_t paint) { return Entry::make(Entry::Kind::Solid, paint); }

GradientStop stop(float offset, float r, float g, float b, float a) {
    const auto word = [](float v) { return std::uint16_t(std::lround(v * 65535)); };
    return {offset, {word(r), word(g), word(b), word(a)}, 0};
}

std::vector<GradientStop> fourStops() {
    return {stop(0, 1, 0, 0, 1), stop(0.25f, 1, 1, 0, 0.5f), stop(0.5f, 0, 0, 1, 0.25f), stop(1, 0, 1, 1, 1)};
}

Gradient linear(Spread spread) {
    Gradient g;
    g.matrix = {1.0f / 24, 0.01f, 1.0f / 40, 0.02f, -0.5f, 0};
    g.spread = spread;
    g.stopCount = 4;
    return g;
}

Gradient radial(Spread spread, float fx, float fr) {
    Gradient g = linear(spread);
    g.matrix = {1.0f / 20, 0, 0, 1.0f / 14, -1.6f, -2.2f};
    g.fx = fx;
    g.fy = 0.2f;
    g.fr = fr;
    return g;
}

std::uint16_t addProgram(Asset& asset, const std::vector<Instruction>& program) {
    const auto first = std::uint32_t(asset.data.size());
    for (const Instruction& in : program)
        append(asset.data, in);
    asset.paints.push_back({first, std::uint32_t(program.size()), 0, programTag});
    return std::uint16_t(asset.paints.size() - 1);
}

Instruction layer(Op op, std::uint32_t argument, float opacity = 1) {
    return {op, Blend::Normal, opacity, argument};
}

Instruction pop(Blend mode, float opacity = 1) { return {Op::Pop, mode, opacity, 0}; }

}  // namespace

Asset disc() {
    // An arc's slopes over its chord are ± the tangent of half the angle it turns by.
    const auto slope = std::int16_t(std::lround(std::tan(std::numbers::pi / 16) * slopeScale));
    std::vector<Piece> arcs;
    for (int i = 0; i < 16; ++i)
        arcs.push_back({discPoint(i), discPoint(i + 1), std::int16_t(-slope), slope, 1, 0});
    return oneLeaf({0, 0, 0, 0}, arcs);
}

Asset twoLevels() {
    Asset asset = emptyAsset();
    const Entry diagonal = addLeaf(asset, {1, 1, 2, 1}, {line({65535, 100}, {100, 65535}, 1, 2)});
    Node root, inner;
    for (std::uint32_t i = 0; i < 16; ++i) {
        root.children[i] = solidEntry(i % 5);
        inner.children[i] = i % 3 == 0 ? diagonal : solidEntry((i + 2) % 5);
    }
    root.children[5] = Entry::make(Entry::Kind::Node, 1);
    root.children[6] = diagonal;
    asset.nodes = {root, inner};
    asset.maps[0].root = Entry::make(Entry::Kind::Node, 0);
    return asset;
}

std::uint32_t addGradient(std::vector<Texel>& data, const Gradient& gradient,
                          const std::vector<GradientStop>& stops) {
    const auto first = std::uint32_t(data.size());
    append(data, gradient);
    for (const GradientStop& s : stops)
        append(data, s);
    return first;
}

std::uint32_t addImage(std::vector<Texel>& data, const ImageFill& fill) {
    append(data, fill);
    return std::uint32_t(data.size() - sizeof(ImageFill) / sizeof(Texel));
}

std::uint32_t addMaterial(std::vector<Texel>& data, const MaterialFill& fill) {
    append(data, fill);
    return std::uint32_t(data.size() - sizeof(MaterialFill) / sizeof(Texel));
}

std::uint32_t addColor(std::vector<Texel>& data, glm::vec4 premultiplied) {
    append(data, premultiplied);
    return std::uint32_t(data.size() - 1);
}

image::Bitmap smallPicture() {
    image::Bitmap bitmap{4, 3, {}};
    for (int i = 0; i < 12; ++i)
        for (const int channel : {i * 20, 255 - i * 15, i * 77 % 256, i % 3 == 0 ? 100 : 255})
            bitmap.rgba.push_back(std::uint8_t(channel));
    return bitmap;
}

Asset programAsset(const std::vector<Instruction>& program, const std::vector<Texel>& arguments) {
    Asset asset = emptyAsset();
    asset.data = arguments;
    asset.images = {smallPicture()};
    asset.maps[0].root = solidEntry(addProgram(asset, program));
    return asset;
}

// ---- Steep gradients ------------------------------------------------------------------------------

namespace {

constexpr Point steepBottom{20001, 0}, steepTop{40003, 65535};
const glm::dvec2 steepWay(0.8, 0.6), steepMiddle(31, 29);
const glm::dvec4 steepLeft(1, 0.5, 0, 1), steepRight(0, 0.75, 1, 1);

glm::dvec2 inMap(Point p) { return glm::dvec2(p[0], p[1]) * (mapSide / leafExtent); }

double toAndFro(double u) { return 1 - std::abs(1 - (u - 2 * std::floor(u / 2))); }

glm::dvec4 steepColor(double length, glm::dvec2 p) {
    const glm::dvec2 along = inMap(steepTop) - inMap(steepBottom), way = p - inMap(steepBottom);
    const bool left = along.x * way.y - along.y * way.x > 0;
    const double u = left ? glm::dot(p, steepWay) / length : glm::length(p - steepMiddle) / length;
    return glm::mix(glm::dvec4(0, 0, 0, 1), left ? steepLeft : steepRight, toAndFro(u));
}

/// The gradients, of `length` units, left and right of the edge.
Asset halves(double length, Spread spread, const std::vector<GradientStop>& left,
             const std::vector<GradientStop>& right) {
    Asset asset = oneLeaf({5, 6, 6, 5}, {line(steepBottom, steepTop, 5, 6)});
    const auto scale = float(1 / length);
    Gradient gradient;
    gradient.spread = spread;
    gradient.stopCount = std::uint32_t(left.size());
    gradient.matrix = {scale * float(steepWay.x), 0, scale * float(steepWay.y), 0, 0, 0};
    const std::uint32_t linear = addGradient(asset.data, gradient, left);
    gradient.stopCount = std::uint32_t(right.size());
    gradient.matrix = {scale, 0, 0, scale, -scale * float(steepMiddle.x), -scale * float(steepMiddle.y)};
    const std::uint32_t radial = addGradient(asset.data, gradient, right);
    addProgram(asset, {layer(Op::Linear, linear)});
    addProgram(asset, {layer(Op::Radial, radial)});
    return asset;
}

}  // namespace

Asset steepHalves(double length) {
    const auto stops = [](const glm::vec4& c) {
        return std::vector{stop(0, 0, 0, 0, 1), stop(1, c.r, c.g, c.b, c.a)};
    };
    return halves(length, Spread::Reflect, stops(steepLeft), stops(steepRight));
}

Asset stripedHalves(double width) {
    std::vector<GradientStop> stops;
    constexpr int last = 64;
    for (int i = 0; i <= last; ++i) {
        const glm::vec4 c = i % 2 == 0 ? glm::dvec4(0, 0, 0, 1) : steepLeft;
        stops.push_back(stop(float(i) / last, c.r, c.g, c.b, c.a));
    }
    return halves(width * last, Spread::Pad, stops, stops);
}

image::Raster steepHalvesByPoints(double length, int width, int height, const glm::dmat3x2& toPixels) {
    constexpr int side = 32;
    const glm::dmat2 inverse = glm::inverse(glm::dmat2(toPixels[0], toPixels[1]));
    image::Raster raster(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec4 sum(0);
            for (int i = 0; i < side * side; ++i) {
                const glm::dvec2 within(i % side + 0.5, i / side + 0.5);
                sum += steepColor(length, inverse * (glm::dvec2(x, y) + within / double(side) - toPixels[2]));
            }
            for (int c = 0; c < 4; ++c)
                raster.pixel(x, y)[c] = float(sum[c] / (side * side));
        }
    return raster;
}

Asset everyPaint() {
    Asset asset = emptyAsset();
    asset.images = {smallPicture()};
    std::vector<Texel>& data = asset.data;
    std::vector<std::uint16_t> paints;
    const std::uint32_t color = addColor(data, haze),
                        ramp = addGradient(data, linear(Spread::Pad), fourStops());
    for (const Spread spread : {Spread::Pad, Spread::Reflect, Spread::Repeat}) {
        const std::uint32_t straight = addGradient(data, linear(spread), fourStops());
        const std::uint32_t round = addGradient(data, radial(spread, 0.3f, 0.1f), fourStops());
        paints.push_back(addProgram(asset, {layer(Op::Linear, straight)}));
        paints.push_back(addProgram(asset, {layer(Op::Solid, color), layer(Op::Radial, round, 0.75f)}));
    }
    ImageFill fill{{0.1f, 0.02f, -0.03f, 0.09f, -1.5f, -1}, 0, ImageFilter::Bilinear};
    const std::uint32_t bilinear = addImage(data, fill);
    fill.filter = ImageFilter::Nearest;
    const std::uint32_t nearest = addImage(data, fill);
    fill.filter = ImageFilter::Trilinear;
    const std::uint32_t trilinear = addImage(data, fill);
    fill.filter = ImageFilter::Bicubic;
    const std::uint32_t bicubic = addImage(data, fill);
    const std::uint32_t outside = addGradient(data, radial(Spread::Pad, 0.95f, 0.2f), fourStops());
    paints.push_back(addProgram(asset, {layer(Op::Image, bilinear)}));
    paints.push_back(addProgram(asset, {layer(Op::Image, nearest, 0.5f)}));
    paints.push_back(addProgram(asset, {layer(Op::Radial, outside)}));
    for (const Op mask : {Op::PopMaskLuminance, Op::PopMaskLinear, Op::PopMaskAlpha})
        paints.push_back(
            addProgram(asset, {layer(Op::Image, bilinear), layer(Op::Push, 0), layer(Op::Linear, ramp),
                               layer(Op::Solid, color), layer(mask, 0)}));
    asset.materials = {{"plain", "vec4 plain(vec2 p) { return vec4(0.25, 0.125, 0.0, 0.5); }"}};
    const std::uint32_t plain = addMaterial(data, {{1, 0, 0, 1, 0, 0}, 0, 0, {0.25f, 0.125f, 0, 0.5f}});
    paints.push_back(addProgram(asset, {layer(Op::Linear, ramp), layer(Op::Material, plain, 0.5f)}));
    paints.push_back(addProgram(asset, {layer(Op::Image, trilinear), layer(Op::Image, bicubic, 0.5f)}));
    Node root;
    for (std::uint32_t i = 0; i < 16; ++i) {
        const std::uint16_t a = paints[i % paints.size()], b = paints[(i * 5 + 3) % paints.size()];
        root.children[i] = i % 2 == 0 ? solidEntry(a)
                                      : addLeaf(asset, {a, b, b, a}, {line({9001, 0}, {50001, 65535}, a, b)});
    }
    asset.nodes = {root};
    asset.maps[0].root = Entry::make(Entry::Kind::Node, 0);
    return asset;
}

Asset blendAsset(Blend mode) {
    std::vector<Texel> data;
    const std::uint32_t below = addGradient(data, linear(Spread::Reflect), fourStops());
    const std::uint32_t above = addGradient(data, radial(Spread::Pad, 0.2f, 0), fourStops());
    return programAsset(
        {layer(Op::Linear, below), layer(Op::Push, 0), layer(Op::Radial, above), pop(mode, 0.9f)}, data);
}

Asset placedMaps() {
    Asset asset = disc();
    asset.maps = {{0, 0, mapSide, Entry::make(Entry::Kind::Node, 0), 1},
                  {0, 0, 1, Entry::make(Entry::Kind::Solid, 0), 2},
                  {0, 0, 1, asset.maps[0].root, 0}};
    asset.symbols = {{1, 0, 0, 0.5f, 0}, {1, 0, 1, 0.5f, 0}, {2, 0, 2, 1.0f, 0}};
    asset.palettes = {2, 3, 1};
    const std::uint32_t fourth = 1u << 22;
    constexpr std::int16_t full = 32767, half = 16384;
    asset.instances = {Instance::make(0, {fourth, fourth}, {full, 0, 0, full}),
                       Instance::make(1, {3 * fourth, 2 * fourth}, {0, full, -full, 0}),
                       Instance::make(2, {2 * fourth, 2 * fourth}, {half, 0, 0, half})};
    asset.nodes.resize(2);
    asset.nodes[0].children.fill(Entry::make(Entry::Kind::Solid, 0));
    asset.nodes[1].children.fill(Entry::make(Entry::Kind::Solid, 0));
    asset.nodes[1].children[5] = InstanceRange::entry(0, 1);
    asset.nodes[1].children[11] = InstanceRange::entry(1, 1);
    asset.instanceTrees = {{Entry::make(Entry::Kind::Node, 1), 0.25f, 0, 0},
                           {InstanceRange::entry(2, 1), 0.26f, 0, 0}};
    asset.font = Font{0x123456789ABCDEF0u, 0.75f, 0.25f};
    asset.glyphs = {{3, 0, 0.25f, ' '}, {36, 1 | 1 << 24, 0.5f, 'i'}};
    asset.glyphParts = {{2, 0, 0, 0}, {2, 0.25f, -0.5f, 0}};
    return asset;
}

Asset layers() {
    Asset asset = emptyAsset();
    asset.mode = Mode::Compat;
    const std::uint32_t gradient = addGradient(asset.data, linear(Spread::Reflect), fourStops());
    const std::uint16_t shaded = addProgram(asset, {layer(Op::Linear, gradient)});
    const auto shape = [&](double x, double y, double side, std::array<std::uint16_t, 4> corners,
                           const std::vector<Piece>& pieces) {
        asset.maps.push_back({x, y, side, addLeaf(asset, corners, pieces)});
        return std::uint32_t(asset.maps.size() - 1);
    };
    asset.maps.clear();
    const std::uint32_t big = shape(2, 3, 60, {1, 0, 0, 0}, {line({30001, 0}, {0, 40001}, 1, 0)});
    const std::uint32_t left = shape(5, 5, 30, {1, 0, 0, 1}, {line({20001, 0}, {30001, 65535}, 1, 0)});
    const std::uint32_t right = shape(36, 30, 25, {0, 1, 1, 0}, {line({20001, 0}, {30001, 65535}, 0, 1)});
    const std::uint32_t whole = std::uint32_t(asset.maps.size());
    asset.maps.push_back({10, 10, 44, solidEntry(1)});
    using K = Command::Kind;
    asset.commands = {{K::FillMask, {}, 1, whole, 2},
                      {K::FillMask, {}, 1, left, shaded},
                      {K::FillMask, {}, 1, right, 4},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, big, shaded},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, whole, 4},
                      {K::PopMaskLuminance, {}, 1, 0, 0},
                      {K::Pop, Blend::Multiply, 0.8f, 0, 0},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, right, 3},
                      {K::FillMask, {}, 1, left, 1},
                      {K::ClipMask, {}, 1, whole, 0},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, left, shaded},
                      {K::FillMask, {}, 1, right, 2},
                      {K::PopMaskAlpha, {}, 1, 0, 0},
                      {K::Pop, Blend::Normal, 0.5f, 0, 0},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, big, 2},
                      {K::Push, {}, 1, 0, 0},
                      {K::FillMask, {}, 1, whole, shaded},
                      {K::PopMaskLinear, {}, 1, 0, 0},
                      {K::Pop, Blend::Luminosity, 1, 0, 0}};
    return asset;
}

Asset filtered() {
    Asset asset = disc();
    const auto word = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    const std::array<double, 4> box{4, 4, 60, 60};
    asset.filterWords = {0, word(2), word(1.5f), word(1), 2, 3, word(6), word(0), word(0), word(0), word(0)};
    asset.filterPrimitives = {{FilterOp::GaussianBlur, 1, 0, 1, 2, 0, box},
                              {FilterOp::Picture, 0, 3, 0, 1, 0, box},
                              {FilterOp::Composite, 0, 4, 2, 5, 0, box}};
    asset.filters = {{{1, 0, 0, 1, 0, 0}, box, 0, 3, 2, 0}};
    using K = Command::Kind;
    asset.commands = {
        {K::DrawMap, {}, 1, 0, 0}, {K::Push, {}, 1, 0, 0},      {K::PushInput, {}, 1, 0, 0},
        {K::DrawMap, {}, 1, 0, 0}, {K::PushInput, {}, 1, 0, 0}, {K::DrawMap, {}, 1, 0, 0},
        {K::Filter, {}, 1, 0, 0},  {K::Pop, {}, 1, 0, 0},       {K::Pop, Blend::Multiply, 0.5f, 0, 0}};
    return asset;
}

}  // namespace vtm::asset::test
