#include "bench/input/font.hpp"

#ifdef VTM_HAVE_FREETYPE
#include <filesystem>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#endif

namespace vtm::bench {

#ifndef VTM_HAVE_FREETYPE

std::optional<scene::Scene> fontSheet(const std::string&, std::string& why) {
    why = "built without FreeType (libfreetype-dev)";
    return std::nullopt;
}

#else

namespace {

namespace fs = std::filesystem;
using scene::Point;

constexpr int columns = 12, firstCharacter = 33, lastCharacter = 126;
constexpr double cellSide = 1;

std::string systemFont() {
    std::error_code ignored;
    for (const char* root : {"/usr/share/fonts", "/usr/local/share/fonts"})
        for (const auto& entry : fs::recursive_directory_iterator(root, ignored))
            if (entry.path().filename() == "DejaVuSans.ttf")
                return entry.path().string();
    return {};
}

/// Turns FreeType's outline into a path: font units, y up, to the cell of the sheet.
struct Builder {
    scene::Path path;
    Point origin;
    double scale;

    Point point(const FT_Vector* v) const { return origin + scale * Point{double(v->x), -double(v->y)}; }
    static Builder& of(void* user) { return *static_cast<Builder*>(user); }
};

scene::Path outlineOf(FT_Outline& outline, Point origin, double scale) {
    Builder builder{{}, origin, scale};
    FT_Outline_Funcs functions{};
    functions.move_to = [](const FT_Vector* to, void* user) {
        Builder& b = Builder::of(user);
        b.path.push_back(scene::MoveTo{b.point(to)});
        return 0;
    };
    functions.line_to = [](const FT_Vector* to, void* user) {
        Builder& b = Builder::of(user);
        b.path.push_back(scene::LineTo{b.point(to)});
        return 0;
    };
    functions.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* user) {
        Builder& b = Builder::of(user);
        b.path.push_back(scene::QuadTo{b.point(control), b.point(to)});
        return 0;
    };
    functions.cubic_to = [](const FT_Vector* c1, const FT_Vector* c2, const FT_Vector* to, void* user) {
        Builder& b = Builder::of(user);
        b.path.push_back(scene::CubicTo{b.point(c1), b.point(c2), b.point(to)});
        return 0;
    };
    FT_Outline_Decompose(&outline, &functions, &builder);
    return builder.path;
}

scene::Scene sheetOf(FT_Face face) {
    constexpr int rows = (lastCharacter - firstCharacter + columns) / columns;
    scene::Scene sheet{columns * cellSide, rows * cellSide, {}};
    const double scale = cellSide / double(face->ascender - face->descender);
    for (int character = firstCharacter; character <= lastCharacter; ++character) {
        if (FT_Load_Char(face, FT_ULong(character), FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING) != 0)
            continue;
        const int index = character - firstCharacter;
        const double baseline = (index / columns) * cellSide + scale * face->ascender;
        const double left =
            (index % columns + 0.5) * cellSide - scale * double(face->glyph->metrics.horiAdvance) / 2;
        scene::Item item;
        item.path = std::make_shared<scene::Path>(outlineOf(face->glyph->outline, {left, baseline}, scale));
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{0, 0, 0, 1};
        sheet.root.children.push_back({item});
    }
    return sheet;
}

}  // namespace

std::optional<scene::Scene> fontSheet(const std::string& path, std::string& why) {
    const std::string file = path.empty() ? systemFont() : path;
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    std::optional<scene::Scene> sheet;
    if (file.empty())
        why = "no DejaVu Sans on this system (fonts-dejavu-core)";
    else if (FT_Init_FreeType(&library) != 0 || FT_New_Face(library, file.c_str(), 0, &face) != 0)
        why = file + " is no font that FreeType reads";
    else
        sheet = sheetOf(face);
    FT_Done_Face(face);
    FT_Done_FreeType(library);
    return sheet;
}

#endif

}  // namespace vtm::bench
