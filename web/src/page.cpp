#include "web/page.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "backend_gl/sampled_data.hpp"
#include "image/base64.hpp"
#include "web/src/chunks.hpp"
#include "web/src/page_text.hpp"
#include "web/src/shader_text.hpp"

namespace vtm::web {

namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;

/// The page's data begin with this number; docs/view.md.
constexpr int version = 1;

/// Script and style elements end at "</", comments begin at "<!--": no "<" is left.
std::string scriptText(const Json& json) {
    std::string result;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace))
        c == '<' ? result += "\\u003c" : result += c;
    return result;
}

// ---- Chunks ---------------------------------------------------------------------------------------

/// What a chunk may be stored as the difference to.
struct Base {
    std::string name;
    std::span<const std::uint8_t> bytes;
};

/// Elements of the page that hold bytes, and their list.
class Chunks {
public:
    /// As the difference to `base` if that is smaller. Returns the chunk's name.
    std::string add(const std::string& name, std::span<const std::uint8_t> bytes, const Base& base = {}) {
        Bytes packed = deflated(bytes);
        bool isDifference = false;
        if (!base.name.empty()) {
            const Bytes other = deflated(difference(bytes, base.bytes));
            isDifference = other.size() < packed.size();
            packed = isDifference ? other : packed;
        }
        list_[name] = {{"bytes", bytes.size()}, {"base", isDifference ? Json(base.name) : Json()}};
        elements_ += fmt::format("<script type=\"application/octet-stream\" id=\"chunk-{}\">{}</script>\n",
                                 name, image::base64(packed));
        return name;
    }
    std::string add(const std::string& name, std::string_view text) {
        return add(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    }

    const Json& list() const { return list_; }
    const std::string& elements() const { return elements_; }

private:
    Json list_ = Json::object();
    std::string elements_;
};

// ---- Shaders' inputs ------------------------------------------------------------------------------

const char* formatName(gl::TextureData::Format format) {
    return format == gl::TextureData::Format::Rgba32ui ? "rgba32ui" : "rgba8";
}

Json toJson(const gl::UniformValue& uniform) {
    static constexpr const char* types[] = {"int", "uint", "float"};
    Json numbers = std::visit([](const auto& list) { return Json(list); }, uniform.numbers);
    return {{"name", uniform.name}, {"type", types[uniform.numbers.index()]}, {"numbers", numbers}};
}

Json addTexture(Chunks& chunks, const std::string& view, const gl::TextureData& texture, const Base& base) {
    const bool isRecords = texture.format == gl::TextureData::Format::Rgba32ui;
    const std::string name = view + '-' + texture.name;
    chunks.add(name, texture.bytes, isRecords ? base : Base());
    return {{"name", texture.name},
            {"format", formatName(texture.format)},
            {"width", texture.width},
            {"height", texture.height},
            {"levels", texture.levels},
            {"filtered", texture.isFiltered},
            {"chunk", name}};
}

Json addData(Chunks& chunks, const std::string& view, const gl::ShaderData& data, const Base& base = {}) {
    Json json = {{"textures", Json::array()}, {"uniforms", Json::array()}};
    for (const gl::TextureData& texture : data.textures)
        json["textures"].push_back(addTexture(chunks, view, texture, base));
    for (const gl::UniformValue& uniform : data.uniforms)
        json["uniforms"].push_back(toJson(uniform));
    return json;
}

// ---- Parts of the page ----------------------------------------------------------------------------

/// x, y, width, height: floats; red, green, blue, 255: bytes.
Bytes outlineBytes(const std::vector<Outline>& outlines) {
    Bytes bytes;
    for (const Outline& o : outlines) {
        for (const double number : {o.x, o.y, o.width, o.height}) {
            const auto word = std::bit_cast<std::array<std::uint8_t, 4>>(float(number));
            bytes.insert(bytes.end(), word.begin(), word.end());
        }
        bytes.insert(bytes.end(), {o.color[0], o.color[1], o.color[2], 255});
    }
    return bytes;
}

Json addView(Chunks& chunks, const View& view, const Base& picture) {
    Json legend = Json::array();
    for (const Mark& mark : view.legend)
        legend.push_back({{"color", mark.color}, {"text", mark.text}});
    Json json = {{"name", view.name}, {"title", view.title}, {"legend", legend}};
    if (view.asset) {
        // Views are looked at closely: a small pyramid will do.
        asset::PrefilterOptions small;
        small.largestSide = 16;
        json["data"] = addData(chunks, view.name, gl::sampledData(*view.asset, small), picture);
    }
    if (!view.outlines.empty())
        json["outlines"] = chunks.add(view.name + "-outlines", outlineBytes(view.outlines));
    return json;
}

Json addIds(Chunks& chunks, const Ids& ids, const Base& picture) {
    const gl::IdData data = gl::idData(ids.asset, ids.idOfPaint);
    Json items = Json::array();
    for (const Item& item : ids.items)
        items.push_back({item.element, item.line, item.column, int(item.isStroke)});
    return {{"data", addData(chunks, "ids", data.data, picture)},
            {"vertex", chunks.add("ids-vertex", data.vertex)},
            {"fragment", chunks.add("ids-fragment", data.fragment)},
            {"square", data.square},
            {"unitsPerSide", data.unitsPerSide},
            {"items", items}};
}

std::string sourceOf(std::string_view stage) { return "#version 300 es\n" + std::string(stage); }

Json addPrograms(Chunks& chunks, const asset::Asset& picture) {
    using namespace shaders;
    return {{"viewVertex", chunks.add("view-vertex", sourceOf(view_vertex))},
            {"viewFragment", chunks.add("view-fragment", "#version 300 es\n" + gl::sampleInclude({picture}) +
                                                             std::string(view_fragment))},
            {"outlineVertex", chunks.add("outline-vertex", sourceOf(outline_vertex))},
            {"outlineFragment", chunks.add("outline-fragment", sourceOf(outline_fragment))}};
}

std::string filled(std::string_view format, const std::map<std::string_view, std::string>& values) {
    std::string result;
    for (std::size_t at = 0; at < format.size();) {
        const std::size_t open = format.find("{{", at), close = format.find("}}", open);
        result += format.substr(at, open - at);
        if (open == std::string_view::npos)
            break;
        result += values.at(format.substr(open + 2, close - open - 2));
        at = close + 2;
    }
    return result;
}

/// Nothing is loaded, and nothing runs but what we wrote.
std::string policy() {
    const auto hash = [](std::string_view digits) {
        return "'sha256-" + image::base64(fromHexadecimal(digits)) + "'";
    };
    return fmt::format(
        "default-src 'none'; script-src {}; style-src {}; img-src blob:; base-uri 'none'; form-action 'none'",
        hash(text::scriptSha256), hash(text::styleSha256));
}

}  // namespace

std::string page(const Source& source) {
    Chunks chunks;
    // A page is downloaded: bytes count for more than time.
    const gl::ShaderData picture = gl::sampledData(source.picture, {.timesTree = 0});
    Json manifest = {{"version", version},
                     {"title", source.title},
                     {"width", source.picture.width},
                     {"height", source.picture.height},
                     {"finestPixel", source.finestPixel},
                     {"programs", addPrograms(chunks, source.picture)},
                     {"picture", addData(chunks, "picture", picture)},
                     {"views", Json::array()}};
    const Base records{"picture-texels", picture.textures[0].bytes};
    for (const View& view : source.views)
        manifest["views"].push_back(addView(chunks, view, records));
    manifest["ids"] = source.ids ? addIds(chunks, *source.ids, records) : Json();
    manifest["svg"] = source.svg.empty() ? Json() : Json(chunks.add("svg", source.svg));
    manifest["chunks"] = chunks.list();
    return filled(text::html, {{"policy", policy()},
                               {"title", escaped(source.title)},
                               {"style", std::string(text::style)},
                               {"script", std::string(text::script)},
                               {"manifest", scriptText(manifest)},
                               {"chunks", chunks.elements()}});
}

}  // namespace vtm::web
