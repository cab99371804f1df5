#include "trace/trace.hpp"

#include <string>
#include <type_traits>

#include <vtm/limits/limits.hpp>
#include "trace/src/palette.hpp"

#ifdef VTM_WITH_POTRACE
#include <cmath>
#include <memory>

#include <dlfcn.h>

#include <potracelib.h>
#endif

namespace vtm::trace {

#ifndef VTM_WITH_POTRACE

bool available() { return false; }

scene::Scene trace(const image::Bitmap&, const Options&) {
    throw TraceError(
        "built without potrace: configure with -DVTM_WITH_POTRACE=ON (libpotrace-dev) to trace bitmaps");
}

#else

namespace {

using scene::Point;

/// potrace's functions, from its library where that is installed. It stays loaded.
struct Potrace {
    decltype(&potrace_param_default) defaults = nullptr;
    decltype(&potrace_param_free) freeParameters = nullptr;
    decltype(&potrace_trace) trace = nullptr;
    decltype(&potrace_state_free) freeState = nullptr;

    Potrace() {
        void* const library = dlopen("libpotrace.so.0", RTLD_NOW | RTLD_LOCAL);
        if (!library)
            return;
        const auto find = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)> >(dlsym(library, name));
        };
        find(defaults, "potrace_param_default");
        find(freeParameters, "potrace_param_free");
        find(trace, "potrace_trace");
        find(freeState, "potrace_state_free");
    }
    bool isThere() const { return defaults && freeParameters && trace && freeState; }
};

const Potrace& potrace() {
    static const Potrace loaded;
    return loaded;
}

constexpr double smoothest = 1.3334;
constexpr int largestSpeckle = 1'000'000;
/// Coordinates are rounded to a hundredth of a pixel, far below what pixels tell, so that they are short as
/// text.
constexpr double stepsPerPixel = 100;

void check(const image::Bitmap& bitmap, const Options& options) {
    if (options.colors < 1 || options.colors > 256)
        throw TraceError("colors is " + std::to_string(options.colors) + ", not in [1, 256]");
    if (options.speckle < 0 || options.speckle > largestSpeckle)
        throw TraceError("speckle is " + std::to_string(options.speckle) + ", not in [0, 1000000]");
    if (!(options.smooth >= 0 && options.smooth <= smoothest))
        throw TraceError("smooth is " + std::to_string(options.smooth) + ", not in [0, 1.3334]");
    if (bitmap.width < 1 || bitmap.height < 1)
        throw TraceError("the picture is empty");
}

/// One bit a pixel, as potrace wants it: the first of a word is its highest, rows from the bottom.
class Bits {
public:
    Bits(int width, int height)
        : wordsOfRow_((width + wordBits - 1) / wordBits),
          words_(std::size_t(wordsOfRow_) * std::size_t(height)),
          bitmap_{width, height, wordsOfRow_, words_.data()} {}

    void set(int x, int y) {
        const std::size_t row = std::size_t(bitmap_.h - 1 - y) * std::size_t(wordsOfRow_);
        words_[row + std::size_t(x / wordBits)] |= potrace_word(1) << (wordBits - 1 - x % wordBits);
    }
    const potrace_bitmap_t* get() const { return &bitmap_; }

private:
    static constexpr int wordBits = 8 * int(sizeof(potrace_word));
    int wordsOfRow_;
    std::vector<potrace_word> words_;
    potrace_bitmap_t bitmap_;
};

/// The pixels of this colour and all darker ones.
Bits pixelsFrom(const Palette& palette, int color, int width, int height) {
    Bits bits(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (palette.indices[std::size_t(y) * std::size_t(width) + std::size_t(x)] >= color)
                bits.set(x, y);
    return bits;
}

void append(scene::Path& path, const potrace_curve_t& curve, int height) {
    const auto rounded = [](double v) { return std::round(v * stepsPerPixel) / stepsPerPixel; };
    const auto point = [&](const potrace_dpoint_t& p) { return Point{rounded(p.x), rounded(height - p.y)}; };
    path.push_back(scene::MoveTo{point(curve.c[curve.n - 1][2])});
    for (int i = 0; i < curve.n; ++i) {
        const potrace_dpoint_t* c = curve.c[i];
        if (curve.tag[i] == POTRACE_CORNER) {
            path.push_back(scene::LineTo{point(c[1])});
            path.push_back(scene::LineTo{point(c[2])});
        } else {
            path.push_back(scene::CubicTo{point(c[0]), point(c[1]), point(c[2])});
        }
    }
    path.push_back(scene::Close{});
}

/// The outlines of the set pixels, holes turning the other way round.
scene::Path outlineOf(const Bits& bits, const Options& options) {
    const std::unique_ptr<potrace_param_t, decltype(&potrace_param_free)> parameters(
        potrace().defaults(), potrace().freeParameters);
    if (!parameters)
        throw std::bad_alloc();
    parameters->turdsize = options.speckle;
    parameters->alphamax = options.smooth;
    const std::unique_ptr<potrace_state_t, decltype(&potrace_state_free)> state(
        potrace().trace(parameters.get(), bits.get()), potrace().freeState);
    if (!state || state->status != POTRACE_STATUS_OK)
        throw TraceError("potrace could not trace the picture");
    scene::Path path;
    for (const potrace_path_t* p = state->plist; p != nullptr; p = p->next)
        append(path, p->curve, bits.get()->h);
    return path;
}

}  // namespace

bool available() { return potrace().isThere(); }

scene::Scene trace(const image::Bitmap& bitmap, const Options& options) {
    check(bitmap, options);
    if (!available())
        throw TraceError("potrace is not installed (libpotrace.so.0)");
    const limits::Stage stage("tracing");
    const Palette palette = quantise(bitmap, options.colors);
    scene::Scene scene{double(bitmap.width), double(bitmap.height), {}};
    for (std::size_t k = 0; k < palette.colors.size(); ++k) {
        limits::check();
        limits::progress(double(k) / double(palette.colors.size()));
        const Rgb& rgb = palette.colors[k];
        scene::Item item;
        item.path = std::make_shared<scene::Path>(
            outlineOf(pixelsFrom(palette, int(k), bitmap.width, bitmap.height), options));
        item.geometry = scene::FillRule::NonZero;
        item.paint = scene::Color{float(rgb[0]) / 255, float(rgb[1]) / 255, float(rgb[2]) / 255, 1};
        if (!item.path->empty())
            scene.root.children.push_back({item});
    }
    return scene;
}

#endif

}  // namespace vtm::trace
