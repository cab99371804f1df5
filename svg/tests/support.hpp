/// \file
/// Short ways to load a document and to look into its scene.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <vtm/svg/load.hpp>

namespace vtm::svg {

inline std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

inline Document loadText(std::string_view text, const Options& options = {}) {
    return load(bytesOf(text), options);
}

/// A 100 x 100 document around `body`.
inline std::string document(std::string_view body) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
           "width=\"100\" "
           "height=\"100\">" +
           std::string(body) + "</svg>";
}

inline Document loadBody(std::string_view body) { return loadText(document(body)); }

inline void collectItems(const std::vector<scene::Node>& nodes, std::vector<scene::Item>& out) {
    for (const scene::Node& node : nodes)
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            out.push_back(*item);
        else
            collectItems(std::get<scene::Group>(node.value).children, out);
}

/// All items, groups opened, bottom first.
inline std::vector<scene::Item> itemsOf(const Document& document) {
    std::vector<scene::Item> items;
    collectItems(document.scene.root.children, items);
    return items;
}

/// The only item of a body.
inline scene::Item itemOf(std::string_view body) {
    const std::vector<scene::Item> items = itemsOf(loadBody(body));
    EXPECT_EQ(items.size(), 1u);
    return items.empty() ? scene::Item{} : items.front();
}

/// The only group at the top of a body.
inline scene::Group groupOf(std::string_view body) {
    const Document loaded = loadBody(body);
    const auto& children = loaded.scene.root.children;
    EXPECT_EQ(children.size(), 1u);
    const auto* group = children.empty() ? nullptr : std::get_if<scene::Group>(&children.front().value);
    EXPECT_TRUE(group);
    return group ? *group : scene::Group{};
}

/// 0xrrggbb of a solid item, -1 for other paints.
inline int rgbOf(const scene::Paint& paint) {
    const auto* color = std::get_if<scene::Color>(&paint);
    const auto byte = [](float v) { return static_cast<int>(v * 255 + 0.5f); };
    return color ? byte(color->r) << 16 | byte(color->g) << 8 | byte(color->b) : -1;
}

inline int fillOf(std::string_view body) { return rgbOf(itemOf(body).paint); }

inline void expectNear(const scene::Affine& actual, const scene::Affine& expected, double tolerance = 1e-9) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 2; ++row)
            EXPECT_NEAR(actual[column][row], expected[column][row], tolerance)
                << "column " << column << " row " << row;
}

inline void expectNear(glm::dvec2 actual, glm::dvec2 expected, double tolerance = 1e-9) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
}

inline std::filesystem::path sharedFolder() {
    const char* shared = std::getenv("VTM_SHARED");
    return shared ? shared : std::string(VTM_SOURCE_DIR) + "/../shared";
}

}  // namespace vtm::svg
