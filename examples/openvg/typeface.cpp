#include "examples/openvg/typeface.hpp"

#include <numeric>
#include <stdexcept>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

namespace typeface {

struct Typeface::File {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    explicit File(const std::string& name) {
        if (FT_Init_FreeType(&library) != 0)
            throw std::runtime_error("FreeType does not start");
        if (FT_New_Face(library, name.c_str(), 0, &face) != 0 || !FT_IS_SCALABLE(face)) {
            FT_Done_FreeType(library);
            throw std::runtime_error(name + ": no font with outlines");
        }
    }
    ~File() { FT_Done_FreeType(library); }  // and its faces
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    VGfloat em(FT_Pos units) const { return VGfloat(units) / VGfloat(face->units_per_EM); }
};

namespace {

/// An outline in font units, which are whole numbers and fit 16 bits.
struct Outline {
    std::vector<VGubyte> segments;
    std::vector<VGshort> numbers;

    template <class... Points>
    int add(VGubyte segment, const Points*... points) {
        segments.push_back(segment);
        (numbers.insert(numbers.end(), {VGshort(points->x), VGshort(points->y)}), ...);
        return 0;
    }
    static Outline& of(void* user) { return *static_cast<Outline*>(user); }
};

Outline outlineOf(FT_Outline& source) {
    FT_Outline_Funcs callbacks{};
    callbacks.move_to = [](const FT_Vector* to, void* user) {
        Outline& outline = Outline::of(user);
        if (!outline.segments.empty())
            outline.add(VG_CLOSE_PATH);
        return outline.add(VG_MOVE_TO_ABS, to);
    };
    callbacks.line_to = [](const FT_Vector* to, void* user) {
        return Outline::of(user).add(VG_LINE_TO_ABS, to);
    };
    callbacks.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* user) {
        return Outline::of(user).add(VG_QUAD_TO_ABS, control, to);
    };
    callbacks.cubic_to = [](const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to,
                            void* user) {
        return Outline::of(user).add(VG_CUBIC_TO_ABS, control1, control2, to);
    };
    Outline outline;
    FT_Outline_Decompose(&source, &callbacks, &outline);
    if (!outline.segments.empty())
        outline.add(VG_CLOSE_PATH);
    return outline;
}

}  // namespace

Typeface::Typeface(const std::string& file)
    : file_(std::make_unique<File>(file)),
      font_(vgCreateFont(VGint(file_->face->num_glyphs))),
      advances_(std::size_t(file_->face->num_glyphs), -1.0f) {}

Typeface::~Typeface() { vgDestroyFont(font_); }

VGuint Typeface::glyph(char32_t character) {
    const FT_Face face = file_->face;
    const VGuint index = FT_Get_Char_Index(face, character);
    if (advances_[index] >= 0)
        return index;
    if (FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE) != 0)
        throw std::runtime_error("a glyph cannot be read");
    const Outline outline = outlineOf(face->glyph->outline);
    // The scale makes the font's units an em, so the numbers stay as they are in the file.
    const VGPath path = vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_S_16, file_->em(1), 0,
                                     VGint(outline.segments.size()), VGint(outline.numbers.size()),
                                     VG_PATH_CAPABILITY_APPEND_TO);
    if (!outline.segments.empty())
        vgAppendPathData(path, VGint(outline.segments.size()), outline.segments.data(),
                         outline.numbers.data());
    advances_[index] = file_->em(face->glyph->advance.x);
    const VGfloat origin[] = {0, 0}, escapement[] = {advances_[index], 0};
    vgSetGlyphToPath(font_, index, path, VG_FALSE, origin, escapement);
    vgDestroyPath(path);  // the font keeps it
    return index;
}

Line Typeface::set(std::u32string_view text) {
    Line line;
    for (const char32_t character : text) {
        const VGuint next = glyph(character);
        FT_Vector kerning{};
        if (!line.glyphs.empty() && FT_HAS_KERNING(file_->face) &&
            FT_Get_Kerning(file_->face, line.glyphs.back(), next, FT_KERNING_UNSCALED, &kerning) == 0)
            line.adjustments.back() = file_->em(kerning.x);
        line.glyphs.push_back(next);
        line.adjustments.push_back(0);
    }
    line.width = std::accumulate(line.adjustments.begin(), line.adjustments.end(), 0.0f);
    for (const VGuint index : line.glyphs)
        line.width += advances_[index];
    return line;
}

void Typeface::draw(const Line& line, VGbitfield paintModes) const {
    const VGfloat pen[] = {0, 0};
    vgSetfv(VG_GLYPH_ORIGIN, 2, pen);
    if (!line.glyphs.empty())
        vgDrawGlyphs(font_, VGint(line.glyphs.size()), line.glyphs.data(), line.adjustments.data(), nullptr,
                     paintModes, VG_TRUE);
}

void Typeface::drawAcross(const Line& line) const {
    VGfloat pen[] = {0, 0};
    vgSetfv(VG_GLYPH_ORIGIN, 2, pen);
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_FILL_PAINT_TO_USER);
    for (std::size_t i = 0; i < line.glyphs.size(); ++i) {
        vgGetfv(VG_GLYPH_ORIGIN, 2, pen);
        vgLoadIdentity();
        vgTranslate(-pen[0], -pen[1]);
        vgDrawGlyphs(font_, 1, &line.glyphs[i], &line.adjustments[i], nullptr, VG_FILL_PATH, VG_TRUE);
    }
    vgLoadIdentity();
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
}

}  // namespace typeface
