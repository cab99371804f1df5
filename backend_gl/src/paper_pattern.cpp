#include "backend_gl/paper_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "backend_gl/src/constants.hpp"
#include "backend_gl/src/placement.hpp"
#include "backend_gl/src/program.hpp"
#include "backend_gl/src/programs.hpp"
#include "backend_gl/src/requirements.hpp"
#include "backend_gl/src/state_guard.hpp"

namespace vtm::gl {

namespace {

using asset::Entry;
using asset::PaperCell;
using asset::PaperMask;
using glm::dvec2;

using PlaceTexel = std::uint32_t;
using CellTexel = std::array<float, 4>;

/// Texels of a cell, side by side; cells and nodes in a row of their textures.
constexpr std::size_t cellTexels = 4, cellsPerRow = 32, nodesPerRow = 16;
template <class Texel>
struct Texels {
    std::size_t width = 0, height = 0;
    std::vector<Texel> values;

    Texels(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
    void growTo(std::size_t h) {
        height = std::max(height, h);
        values.resize(width * height);
    }
    Texel& at(std::size_t x, std::size_t y) { return values[y * width + x]; }
    std::size_t bytes() const { return values.size() * sizeof(Texel); }
};

struct Tables {
    Texels<PlaceTexel> places;
    Texels<CellTexel> cells;
};

/// x: a multiple of 4.
PlaceTexel place(unsigned kind, std::size_t x, std::size_t y) {
    if (x > 0xFFFF || y > 0xFFFF)
        throw GlError("the mask has too many squares for a pattern");
    return kind | std::uint32_t(x) | std::uint32_t(y) << 16;
}

/// Levels below an entry.
unsigned depthOf(const PaperMask& mask, Entry entry) {
    unsigned depth = 0;
    if (entry.kind() == Entry::Kind::Node)
        for (const Entry child : mask.nodes[entry.payload()].children)
            depth = std::max(depth, 1 + depthOf(mask, child));
    return depth;
}

/// A square of the tree.
struct Square {
    Entry entry;
    dvec2 corner{0};  ///< periods
    double side = 1;

    Square child(const PaperMask& mask, std::size_t k) const {
        return {mask.nodes[entry.payload()].children[k], corner + side / 4 * dvec2(k % 4, k / 4), side / 4};
    }
};

/// Writes a square's cell, in periods, which single precision places as well as the point that is looked for;
/// what a place says of it.
PlaceTexel writeCell(const PaperMask& mask, const Square& square, Texels<CellTexel>& cells, std::size_t x,
                     std::size_t y) {
    const PaperCell& cell = mask.cells[square.entry.payload()];
    const auto inPeriods = [&](const std::array<std::uint16_t, 2>& p) {
        const dvec2 inSquare = dvec2(p[0], p[1]) / asset::paperExtent * (1 + 2 * asset::paperMargin);
        return square.corner + square.side * (inSquare - asset::paperMargin);
    };
    const float combine = cell.combine == asset::PaperOperator::Intersection ? 1.0f : -1.0f;
    for (std::size_t i = 0; i < cell.count; ++i) {
        const asset::PaperPiece& piece = cell.pieces[i];
        const dvec2 a = inPeriods(piece.a), b = inPeriods(piece.b);
        cells.at(x + 2 * i, y) = {float(a.x), float(a.y), float(b.x), float(b.y)};
        cells.at(x + 2 * i + 1, y) = {float(piece.slopeA / asset::paperSlopeScale),
                                      float(piece.slopeB / asset::paperSlopeScale), combine, 0};
    }
    return place(unsigned(PatternKind::Inside) + cell.count, x, y);
}

/// A 16-tree of one depth everywhere, as the paper's, so that nothing has to be asked on the way down. What
/// is the same over a larger square has nodes there whose children are all alike; those of no boundary are
/// shared.
class Tree {
public:
    Tree(const PaperMask& mask, unsigned depth) : mask_(mask), depth_(depth) {
        at({mask.root}, 0);  // the first node: at (0, 0)
    }
    Tables take() { return {std::move(places_), std::move(cells_)}; }

private:
    PlaceTexel at(const Square& square, unsigned level) {
        const Entry entry = square.entry;
        if (entry.kind() == Entry::Kind::Node) {
            const PlaceTexel made = newNode();
            for (std::size_t k = 0; k < 16; ++k) {
                const PlaceTexel below = at(square.child(mask_, k), level + 1);
                child(made, k) = below;
            }
            return made;
        }
        if (entry.kind() == Entry::Kind::Leaf)
            return alike([&] { return newCell(square); }, level);
        const std::pair key(level, entry.payload());
        const auto found = shared_.find(key);
        return found != shared_.end()
                   ? found->second
                   : shared_[key] = alike([&] { return place(entry.payload(), 0, 0); }, level);
    }

    /// Nodes from `level` down to the finest squares, which are all `finest`; made last, so that the root is
    /// first.
    template <class Make>
    PlaceTexel alike(Make&& finest, unsigned level) {
        if (level == depth_)
            return finest();
        const PlaceTexel made = newNode(), below = alike(finest, level + 1);
        for (std::size_t k = 0; k < 16; ++k)
            child(made, k) = below;
        return made;
    }

    PlaceTexel newNode() {
        const std::size_t x = nodeCount_ % nodesPerRow * 4, y = nodeCount_ / nodesPerRow * 4;
        ++nodeCount_;
        places_.growTo(y + 4);
        return place(0, x, y);
    }

    PlaceTexel& child(PlaceTexel node, std::size_t k) {
        return places_.at((node & 0xFFFF) + k % 4, (node >> 16) + k / 4);
    }

    PlaceTexel newCell(const Square& square) {
        const std::size_t x = cellCount_ % cellsPerRow * cellTexels, y = cellCount_ / cellsPerRow;
        ++cellCount_;
        cells_.growTo(y + 1);
        return writeCell(mask_, square, cells_, x, y);
    }

    const PaperMask& mask_;
    unsigned depth_;
    Texels<PlaceTexel> places_{4 * nodesPerRow, 4};
    Texels<CellTexel> cells_{cellTexels * cellsPerRow, 1};
    std::size_t nodeCount_ = 0, cellCount_ = 0;
    std::map<std::pair<unsigned, std::uint32_t>, PlaceTexel> shared_;
};

/// A place and room for a cell for each of the finest squares, whether or not it has a boundary.
Tables gridOf(const PaperMask& mask, unsigned depth) {
    const std::size_t side = std::size_t(1) << (2 * depth);
    if (int(cellTexels * side) > limit(GL_MAX_TEXTURE_SIZE))
        throw GlError("the mask's finest squares are too many for a grid");
    Tables t{{side, side}, {cellTexels * side, side}};
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
            Square square{mask.root};
            for (unsigned level = depth; square.entry.kind() == Entry::Kind::Node;) {
                --level;
                square = square.child(mask, (y >> (2 * level) & 3) * 4 + (x >> (2 * level) & 3));
            }
            t.places.at(x, y) = square.entry.kind() == Entry::Kind::Solid
                                    ? place(square.entry.payload(), 0, 0)
                                    : writeCell(mask, square, t.cells, cellTexels * x, y);
        }
    return t;
}

template <class Texel>
TextureHandle upload(const Texels<Texel>& texels, GLenum format, GLenum layout, GLenum type) {
    TextureHandle texture = makeTexture(format, int(texels.width), int(texels.height));
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(texels.width), GLsizei(texels.height), layout, type,
                    texels.values.data());
    checkErrors("upload of a pattern");
    return texture;
}

TextureHandle uploadMip(const asset::PaperMip& mip) {
    GLuint id = 0;
    glGenTextures(1, &id);
    TextureHandle texture(id);
    glBindTexture(GL_TEXTURE_2D, id);
    glTexStorage2D(GL_TEXTURE_2D, GLsizei(mip.sizeLog2 + 1), GL_R8, 1 << mip.sizeLog2, 1 << mip.sizeLog2);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const std::uint8_t* texels = mip.texels.data();
    for (unsigned level = 0; level <= mip.sizeLog2; ++level) {
        const GLsizei side = 1 << (mip.sizeLog2 - level);
        glTexSubImage2D(GL_TEXTURE_2D, GLint(level), 0, 0, side, side, GL_RED, GL_UNSIGNED_BYTE, texels);
        texels += std::size_t(side) * std::size_t(side);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    checkErrors("upload of a mip");
    return texture;
}

VertexArrayHandle makeVertexArray() {
    GLuint id = 0;
    glGenVertexArrays(1, &id);
    return VertexArrayHandle(id);
}

FramebufferHandle makeFramebuffer() {
    GLuint id = 0;
    glGenFramebuffers(1, &id);
    return FramebufferHandle(id);
}

/// Of a pixel so wide that the mip has its part, all, or none: it is not asked for what has no weight.
enum class Reach { Near, Between, Far };

ProgramSource sourceOf(PaperPatternForm form, unsigned depth, Reach range) {
    return paperPatternSource({form.compressed, form.filtered, form.linear, range != Reach::Far,
                               form.filtered && range != Reach::Near, depth});
}

}  // namespace

std::string paperPatternShader(PaperPatternForm form, unsigned depth) {
    return joined(sourceOf(form, depth, Reach::Between).fragment);
}

struct PaperPattern::Impl {
    Impl(const PaperMask& mask, PaperPatternForm f, StateContract c)
        : form(f),
          contract(std::move(c)),
          depth(std::max(1u, depthOf(mask, mask.root))),
          mipLog2(mask.mip.sizeLog2) {
        const Tables t = form.compressed ? Tree(mask, depth).take() : gridOf(mask, depth);
        places = upload(t.places, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT);
        cells = upload(t.cells, GL_RGBA32F, GL_RGBA, GL_FLOAT);
        bytes = t.places.bytes() + t.cells.bytes();
        if (form.filtered) {
            mip = uploadMip(mask.mip);
            bytes += mask.mip.texels.size();
        }
    }

    const Program& programOf(Reach range) {
        auto found = programs.find(range);
        if (found == programs.end()) {
            found = programs.emplace(range, Program(sourceOf(form, depth, range))).first;
            const Program& program = found->second;
            program.use();
            glUniform1i(program.uniform("places"), 0);
            glUniform1i(program.uniform("cells"), 1);
            glUniform1i(program.uniform("mip"), 2);
            glUniform4f(program.uniform("insideColor"), 1, 1, 1, 1);
            glUniform4f(program.uniform("outsideColor"), 0, 0, 0, 0);
        }
        return found->second;
    }

    /// Leaves its framebuffer bound.
    void draw(const asset::View& view) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
        if (view.width != width || view.height != height) {
            target = makeTexture(GL_RGBA8, view.width, view.height);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.get(), 0);
            width = view.width;
            height = view.height;
        }
        const glm::dmat2 linear(view.toPixels[0], view.toPixels[1]), inverse = glm::inverse(linear);
        const dvec2 origin = inverse * -view.toPixels[2];
        // As maskCoverage, which counts the analytic coverage as level 0.
        const double lod = std::log2(asset::PaperFootprint(linear).longer) + mipLog2;
        const Program& program = programOf(!form.filtered || lod <= -1 ? Reach::Near
                                           : lod < 0                   ? Reach::Between
                                                                       : Reach::Far);
        const glm::mat2 pixelInPeriods(inverse);
        const float toPattern[6] = {float(inverse[0].x), float(inverse[0].y), float(inverse[1].x),
                                    float(inverse[1].y), float(origin.x),     float(origin.y)};
        glViewport(0, 0, width, height);
        glBindVertexArray(vertexArray.get());
        program.use();
        const TextureHandle* textures[] = {&places, &cells, &mip};
        for (GLenum i = 0; i < 3; ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, textures[i]->get());
        }
        glUniformMatrix2fv(program.uniform("pixelInPeriods"), 1, GL_FALSE, &pixelInPeriods[0][0]);
        glUniformMatrix3x2fv(program.uniform("toPattern"), 1, GL_FALSE, toPattern);
        glUniform1f(program.uniform("lod"), float(lod));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glFinish();
        checkErrors("drawing a pattern");
    }

    PaperPatternForm form;
    StateContract contract;
    unsigned depth, mipLog2;
    std::map<Reach, Program> programs;  ///< compiled when first needed
    VertexArrayHandle vertexArray = makeVertexArray();
    FramebufferHandle framebuffer = makeFramebuffer();
    TextureHandle places, cells, mip, target;
    std::size_t bytes = 0;
    int width = 0, height = 0;
};

PaperPattern::PaperPattern(const PaperMask& mask, PaperPatternForm form) {
    requireContext();
    dropErrors();
    StateContract contract;
    const StateGuard guard(contract, true);
    impl_ = std::make_unique<Impl>(mask, form, contract);
}
PaperPattern::~PaperPattern() = default;

std::size_t PaperPattern::bytes() const { return impl_->bytes; }

void PaperPattern::draw(const asset::View& view) {
    asset::validate(view);
    if (view.width == 0 || view.height == 0 || !isInvertible(view))
        return;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(view);
}

image::Raster PaperPattern::render(const asset::View& view) {
    asset::validate(view);
    image::Raster raster(view.width, view.height);
    if (raster.rgba.empty() || !isInvertible(view))
        return raster;
    dropErrors();
    const StateGuard guard(impl_->contract, true);
    impl_->draw(view);
    std::vector<std::uint8_t> bytes(raster.rgba.size());
    glReadPixels(0, 0, view.width, view.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    checkErrors("reading a pattern");
    std::ranges::transform(bytes, raster.rgba.begin(), [](std::uint8_t b) { return float(b) / 255; });
    return raster;
}

}  // namespace vtm::gl
