// A page of text: vg_text TEXT.ttf HEADLINE.ttf OUT.png|window
//
// One VGFont a typeface. Kerning and word spaces are adjustments beside the glyphs; size and slope are a
// matrix; a gradient runs across a whole line.

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <VG/openvg.h>
#include <VG/vgu.h>

#include "examples/openvg/paints.hpp"
#include "examples/openvg/stage.hpp"
#include "examples/openvg/typeface.hpp"

namespace {

using typeface::Line;
using typeface::Typeface;

constexpr int width = 760, height = 826;
constexpr VGfloat margin = 60, gutter = 40, columnWidth = (width - 2 * margin - gutter) / 2;
constexpr VGfloat textSize = 15.5f, leading = 23, indent = 18;

const std::u32string_view paragraphs[] = {
    U"letter is a curve before it is a picture. Whoever cuts it, in steel or in numbers, draws only its "
    U"border; "
    U"all that the eye calls black lies between two lines that are not there. A page of text is the purest "
    U"vector "
    U"drawing that we have, and the oldest. Letters were kept as pixels for a few years only: screens grew "
    U"finer, "
    U"and the pixels were thrown away. The outlines stayed.",
    U"OpenVG takes letters as it takes any path. A font is a set of them, each with an origin and an "
    U"escapement, "
    U"the way to the next. A line is one call. What a typesetter adds, the pull of an A towards a V, or the "
    U"stretch of the spaces that makes both margins straight, goes beside the glyphs as adjustments.",
    U"Size is a matrix, and so is a slope. Nothing is kept as an image, so a headline costs no more memory "
    U"than a "
    U"footnote, and both are equally sharp. Paint is chosen when the text is drawn: a colour, or a gradient "
    U"that "
    U"knows nothing of single letters and runs across the whole line.",
};

/// A line of a column, with what stands before it.
struct Row {
    Line line;
    VGfloat indent;
};

/// Stretches the spaces until the line is `target` em wide.
void justify(Line& line, std::u32string_view text, VGfloat target) {
    VGint spaces = 0;
    for (const char32_t c : text)
        spaces += c == U' ';
    for (std::size_t i = 0; i < text.size() && spaces > 0; ++i)
        if (text[i] == U' ')
            line.adjustments[i] += (target - line.width) / VGfloat(spaces);
    line.width = target;
}

/// As many words as fit into a line, then the next line. The first three make room for the initial.
void breakLines(Typeface& face, std::u32string_view text, VGfloat initial, std::vector<Row>& rows) {
    for (bool isFirst = true; !text.empty(); isFirst = false) {
        const VGfloat before = rows.size() < 3 ? initial : isFirst ? indent : 0;
        const VGfloat target = (columnWidth - before) / textSize;
        std::size_t end = std::min(text.find(U' '), text.size());
        for (std::size_t next = end; next < text.size();) {
            next = std::min(text.find(U' ', next + 1), text.size());
            if (face.set(text.substr(0, next)).width > target)
                break;
            end = next;
        }
        Row row{face.set(text.substr(0, end)), before};
        if (end < text.size())
            justify(row.line, text.substr(0, end), target);
        rows.push_back(std::move(row));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// The glyphs' user space: em, the pen at (x, y).
void place(VGfloat x, VGfloat y, VGfloat size, VGfloat degrees = 0) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_GLYPH_USER_TO_SURFACE);
    vgLoadIdentity();
    vgTranslate(x, y);
    vgRotate(degrees);
    vgScale(size, size);
}

void setFill(VGPaint paint) {
    vgSetPaint(paint, VG_FILL_PATH);
    vgDestroyPaint(paint);
}

void drawHeadline(Typeface& face) {
    const Line headline = face.set(U"Type is a path");
    constexpr VGfloat size = 83;
    place(margin, 632, size, 6.5f);
    vgTranslate(0.035f, -0.035f);  // a soft shade below
    setFill(paints::solid(0x1f2a4420));
    face.draw(headline);
    place(margin, 632, size, 6.5f);
    setFill(paints::linear(0, 0, headline.width, 0,
                           {{0, 0xd7263dff}, {0.35f, 0xf46036ff}, {0.65f, 0x8a2be2ff}, {1, 0x1b7fdcff}}));
    face.drawAcross(headline);
}

/// Only the outlines of a letter, as large as the page allows.
void drawOrnament(Typeface& face) {
    place(478, 574, 292, -8);
    const VGPaint line = paints::solid(0xdccfb2ff);
    vgSetPaint(line, VG_STROKE_PATH);
    vgDestroyPaint(line);
    vgSetf(VG_STROKE_LINE_WIDTH, 1.4f / 292);
    face.draw(face.set(U"&"), VG_STROKE_PATH);
}

void drawColumns(Typeface& face, Typeface& initialFace) {
    const Line initial = initialFace.set(U"A");
    constexpr VGfloat initialSize = 84, top = 518;
    std::vector<Row> rows;
    for (const std::u32string_view text : paragraphs)
        breakLines(face, text, initial.width * initialSize + 4, rows);

    place(margin - 2, top - 2 * leading, initialSize);
    setFill(paints::linear(0, 0.7f, 0, 0, {{0, 0xf46036ff}, {1, 0xd7263dff}}));
    initialFace.draw(initial);

    setFill(paints::solid(0x22262eff));
    const std::size_t perColumn = (rows.size() + 1) / 2;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const VGfloat x = margin + (columnWidth + gutter) * VGfloat(i / perColumn);
        place(x + rows[i].indent, top - leading * VGfloat(i % perColumn), textSize);
        face.draw(rows[i].line);
    }
}

/// The same letters, larger and larger.
void drawSizes(Typeface& face) {
    const Line sample = face.set(U"AVag");
    setFill(paints::solid(0x1f2a44ff));
    VGfloat x = margin;
    for (const VGfloat size : {9.0f, 13.0f, 18.0f, 25.0f, 35.0f, 49.0f, 68.0f}) {
        place(x, 82, size);
        face.draw(sample);
        x += sample.width * size + 13;
    }
}

void drawRule(VGfloat y) {
    vgSeti(VG_MATRIX_MODE, VG_MATRIX_PATH_USER_TO_SURFACE);
    vgLoadIdentity();
    const VGPath line =
        vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 2, 4, VG_PATH_CAPABILITY_APPEND_TO);
    vguLine(line, margin, y, width - margin, y);
    paints::strokeOnce(line, paints::solid(0xb9a98cff), 1);
    vgDestroyPath(line);
}

}  // namespace

int main(int argc, char** argv) {
    return stage::run([&] {
        if (argc != 4)
            throw std::runtime_error("usage: vg_text TEXT.ttf HEADLINE.ttf OUT.png|window");
        const auto stage = stage::open(argv[3], width, height, "Text");
        Typeface text(argv[1]), headline(argv[2]);
        const VGfloat paper[] = {0.984f, 0.965f, 0.925f, 1};
        vgSetfv(VG_CLEAR_COLOR, 4, paper);
        vgSeti(VG_FILL_RULE, VG_NON_ZERO);  // as fonts mean it
        stage->show(0, [&](double) {
            vgClear(0, 0, width, height);
            drawOrnament(text);
            drawHeadline(headline);
            drawRule(556);
            drawColumns(text, headline);
            drawRule(160);
            drawSizes(text);
        });
    });
}
