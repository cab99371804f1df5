#include "conformance/vgscript/vgscript.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <VG/openvg.h>
#include <fmt/format.h>

#include <vtm/vg.h>
#include <vtm/svg/load.hpp>
#include "conformance/vgscript/src/frame.hpp"
#include "conformance/vgscript/src/names.hpp"

namespace vtm::vgscript {

namespace {

struct PathData {
    std::vector<VGubyte> segments;
    std::vector<VGfloat> coordinates;  ///< absolute
};

/// Appends a command and its points.
struct Appender {
    PathData& data;

    void append(VGPathCommand command, std::initializer_list<double> numbers) const {
        data.segments.push_back(VGubyte(command));
        for (const double number : numbers)
            data.coordinates.push_back(VGfloat(number));
    }
    void operator()(const scene::MoveTo& c) const { append(VG_MOVE_TO_ABS, {c.to.x, c.to.y}); }
    void operator()(const scene::LineTo& c) const { append(VG_LINE_TO_ABS, {c.to.x, c.to.y}); }
    void operator()(const scene::QuadTo& c) const {
        append(VG_QUAD_TO_ABS, {c.control.x, c.control.y, c.to.x, c.to.y});
    }
    void operator()(const scene::CubicTo& c) const {
        append(VG_CUBIC_TO_ABS, {c.control1.x, c.control1.y, c.control2.x, c.control2.y, c.to.x, c.to.y});
    }
    /// SVG's sweep turns from x towards y, which OpenVG calls counter-clockwise.
    void operator()(const scene::ArcTo& c) const {
        const VGPathCommand command = c.largeArc ? (c.sweep ? VG_LCCWARC_TO_ABS : VG_LCWARC_TO_ABS)
                                                 : (c.sweep ? VG_SCCWARC_TO_ABS : VG_SCWARC_TO_ABS);
        append(command, {c.radii.x, c.radii.y, c.rotation * 180 / 3.14159265358979323846, c.to.x, c.to.y});
    }
    void operator()(const scene::Close&) const { append(VGPathCommand(VG_CLOSE_PATH), {}); }
};

/// As the SVG importer reads it; empty where it reads nothing.
PathData pathData(const std::string& text) {
    // A stroke with caps: the importer leaves out what covers nothing.
    const std::string document = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'>"
        "<path fill='none' stroke='#000' stroke-linecap='round' d='{}'/></svg>",
        text);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(document.data());
    const svg::Document read = svg::load({bytes, document.size()});
    PathData data;
    for (const scene::Node& node : read.scene.root.children)
        if (const auto* item = std::get_if<scene::Item>(&node.value))
            for (const scene::Command& command : *item->path)
                std::visit(Appender{data}, command);
    return data;
}

/// Where OpenVG's own bound on coverage comes from: a border lies within 1/64 pixel of the true one, which
/// along a pixel's diagonal is 4 · √2 / 255; half a step is rounding.
constexpr double coverageBound = 4 * 1.4143 + 0.5;

struct SurfaceDeleter {
    void operator()(VtmSurface* surface) const { vtmDestroySurface(surface); }
};
struct ContextDeleter {
    void operator()(VtmContext* context) const { vtmDestroyContext(context); }
};

/// What was current before is current again in the end.
class Current {
public:
    Current() : context_(vtmGetCurrentContext()), surface_(vtmGetCurrentSurface()) {}
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    ~Current() { vtmMakeCurrent(context_, surface_); }

private:
    VtmContext* context_;
    VtmSurface* surface_;
};

class Player {
public:
    Player(const std::string& name, VtmCompositor compositor) : frame_(name), compositor_(compositor) {
        outcome_.bound = coverageBound;
    }

    Outcome play(const std::vector<Statement>& statements) {
        auto statement = statements.begin();
        for (; statement != statements.end() && statement->words[0].text == "surface"; ++statement) {
            frame_.at(statement->line);
            describeSurface(statement->words);
        }
        makeSurface();
        for (; statement != statements.end(); ++statement) {
            frame_.at(statement->line);
            line_ = statement->line;
            run(*statement);
        }
        if (const VGErrorCode error = vgGetError(); error != VG_NO_ERROR)
            miss(
                fmt::format("the script ends with an error that it did not ask for, {:#x}", unsigned(error)));
        read();
        return std::move(outcome_);
    }

private:
    /// surface WIDTH HEIGHT [sRGB] [straight] [565|5551|4444|888|alpha|luminance|black-white] [no-mask]
    void describeSurface(const std::vector<Word>& words) {
        if (words.size() < 3)
            frame_.fail("surface takes a width and a height");
        width_ = frame_.argument<VGint>(words[1]);
        height_ = frame_.argument<VGint>(words[2]);
        for (std::size_t i = 3; i < words.size(); ++i) {
            const std::string& word = words[i].text;
            const auto bits = [&](VGint r, VGint g, VGint b, VGint a, VGint l) {
                format_.redBits = r, format_.greenBits = g, format_.blueBits = b;
                format_.alphaBits = a, format_.luminanceBits = l;
            };
            if (word == "sRGB")
                format_.linear = VG_FALSE;
            else if (word == "straight")
                format_.premultiplied = VG_FALSE;
            else if (word == "888")
                bits(8, 8, 8, 0, 0);
            else if (word == "565")
                bits(5, 6, 5, 0, 0);
            else if (word == "5551")
                bits(5, 5, 5, 1, 0);
            else if (word == "4444")
                bits(4, 4, 4, 4, 0);
            else if (word == "alpha")
                bits(0, 0, 0, 8, 0);
            else if (word == "luminance")
                bits(0, 0, 0, 0, 8);
            else if (word == "black-white")
                bits(0, 0, 0, 0, 1);
            else if (word == "no-mask")
                format_.maskBits = 0;
            else
                frame_.fail(fmt::format("'{}' is no word for a surface", word));
        }
    }

    void makeSurface() {
        context_.reset(vtmCreateContext(nullptr));
        surface_.reset(vtmCreateSurface(width_, height_, &format_));
        if (!context_ || !surface_)
            frame_.fail("no such surface");
        vtmChooseCompositor(surface_.get(), compositor_);
        vtmMakeCurrent(context_.get(), surface_.get());
    }

    void run(const Statement& statement) {
        const std::string& verb = statement.words[0].text;
        if (verb == "path")
            path(statement);
        else if (verb == "bound")
            bound(statement);
        else if (verb == "pixel")
            pixel(statement);
        else if (const Function* function = functionOf(verb))
            call(statement, *function);
        else if (const Memory* memory = frame_.memory(verb); memory && statement.words.size() == 1)
            compareMemory(statement, *memory);
        else if (statement.words.size() == 1 && (!statement.expected.empty() || !statement.target.empty()))
            use(statement, {Value::Kind::Number, frame_.number(statement.words[0]), {}});
        else
            frame_.fail(fmt::format("'{}' is no function of OpenVG and no word of scripts", verb));
    }

    /// path NAME SVG-PATH-DATA: a path of floats with all capabilities.
    void path(const Statement& statement) {
        if (statement.words.size() != 3 || !statement.words[2].isQuoted)
            frame_.fail("path takes a name and SVG's path data in quotation marks");
        const PathData data = pathData(statement.words[2].text);
        if (data.segments.empty())
            frame_.fail("no path data");
        const VGPath handle =
            vgCreatePath(VG_PATH_FORMAT_STANDARD, VG_PATH_DATATYPE_F, 1, 0, 0, 0, VG_PATH_CAPABILITY_ALL);
        vgAppendPathData(handle, VGint(data.segments.size()), data.segments.data(), data.coordinates.data());
        frame_.setNumber(statement.words[1].text, handle);
    }

    void bound(const Statement& statement) {
        if (statement.words.size() != 2)
            frame_.fail("bound takes a number");
        outcome_.bound = frame_.number(statement.words[1]);
    }

    /// pixel X Y == 0xRRGGBBAA: of the surface's own space, not premultiplied; y up.
    void pixel(const Statement& statement) {
        if (statement.words.size() != 3 || statement.expected.empty())
            frame_.fail("pixel takes x and y, then == and a colour");
        const auto x = frame_.argument<VGint>(statement.words[1]),
                   y = frame_.argument<VGint>(statement.words[2]);
        VGuint word = 0;
        vgReadPixels(&word, 4, format_.linear ? VG_lRGBA_8888 : VG_sRGBA_8888, x, y, 1, 1);
        const auto expected = frame_.argument<VGuint>(statement.expected[0]);
        if ((distance(word, expected) <= statement.within) != statement.isEqual)
            miss(fmt::format("pixel {} {} is {:#010x}, not {:#010x}", x, y, word, expected));
    }

    void call(const Statement& statement, const Function& function) {
        const std::span<const Word> words = std::span(statement.words).subspan(1);
        if (words.size() != function.parameters)
            frame_.fail(fmt::format("{} takes {} arguments, not {}", statement.words[0].text,
                                    function.parameters, words.size()));
        const Value value = function.call(frame_, words);
        for (const std::string& broken : frame_.finishCall())
            miss(fmt::format("memory beyond the end of '{}' was written", broken));
        use(statement, value);
    }

    void use(const Statement& statement, const Value& value) {
        const bool isUsed = !statement.target.empty() || !statement.expected.empty();
        if (isUsed && value.kind == Value::Kind::Nothing)
            frame_.fail("there is no result");
        if (!statement.target.empty())
            frame_.setNumber(statement.target, value.number);
        if (statement.expected.empty())
            return;
        const Word& expected = statement.expected[0];
        if (value.kind == Value::Kind::Text) {
            if ((value.text == expected.text) != statement.isEqual)
                miss(fmt::format("'{}', not '{}'", value.text, expected.text));
        } else if ((std::abs(value.number - frame_.number(expected)) <= statement.within) !=
                   statement.isEqual) {
            miss(fmt::format("{}, {} {}", value.number, statement.isEqual ? "not" : "but should not be",
                             expected.text));
        }
    }

    void compareMemory(const Statement& statement, const Memory& memory) {
        if (statement.expected.empty() || !statement.expected[0].isList)
            frame_.fail("memory is compared with a list");
        const std::vector<Word>& items = statement.expected[0].items;
        if (items.size() > memory.count)
            frame_.fail(fmt::format("'{}' holds {} values", statement.words[0].text, memory.count));
        bool isSame = true;
        std::string first;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const double expected = frame_.number(items[i]), found = memory.at(i);
            const double apart = memory.type == 'w'
                                     ? distance(std::uint32_t(found), std::uint32_t(std::int64_t(expected)))
                                     : std::abs(found - expected);
            if (!(apart <= statement.within) && isSame) {
                isSame = false;
                first = memory.type == 'w' ? fmt::format("[{}] is {:#010x}", i, std::uint32_t(found))
                                           : fmt::format("[{}] is {}", i, found);
            }
        }
        if (isSame != statement.isEqual)
            miss(fmt::format("{}{}", statement.words[0].text, isSame ? " is just that" : first));
    }

    /// The largest difference of a byte.
    static double distance(std::uint32_t a, std::uint32_t b) {
        int maximum = 0;
        for (int shift = 0; shift < 32; shift += 8)
            maximum = std::max(maximum, std::abs(int(a >> shift & 255) - int(b >> shift & 255)));
        return maximum;
    }

    void miss(const std::string& what) {
        outcome_.failures.push_back(fmt::format("{}:{}: {}", frame_.name(), line_, what));
    }

    void read() {
        vgSeti(VG_SCISSORING, VG_FALSE);
        outcome_.picture = image::Raster(width_, height_);
        std::vector<VGuint> row(std::size_t(width_), 0);
        for (int y = 0; y < height_; ++y) {
            vgReadPixels(row.data(), 4 * width_, format_.linear ? VG_lRGBA_8888_PRE : VG_sRGBA_8888_PRE, 0,
                         height_ - 1 - y, width_, 1);
            for (int x = 0; x < width_; ++x)
                for (int channel = 0; channel < 4; ++channel)
                    outcome_.picture.pixel(x, y)[channel] =
                        float(row[std::size_t(x)] >> (24 - 8 * channel) & 255) / 255;
        }
    }

    Frame frame_;
    VtmCompositor compositor_;
    Outcome outcome_;
    int line_ = 0;
    VGint width_ = 64, height_ = 64;
    VtmSurfaceFormat format_{8, 8, 8, 8, 0, 8, VG_TRUE, VG_TRUE};
    // Made current after `before_` looked, destroyed before it makes what it found current again.
    Current before_;
    std::unique_ptr<VtmSurface, SurfaceDeleter> surface_;
    std::unique_ptr<VtmContext, ContextDeleter> context_;
};

}  // namespace

Outcome play(std::string_view text, const std::string& name, VtmCompositor compositor) {
    return Player(name, compositor).play(parse(text, name));
}

}  // namespace vtm::vgscript
