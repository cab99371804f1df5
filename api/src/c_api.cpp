#include <algorithm>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include <vtm/vtm.h>
#include <vtm/vtm.hpp>

struct VtmPicture {
    vtm::Picture picture;
};

struct VtmImage {
    vtm::Image image;
};

namespace {

/// Without allocation, so that running out of memory can be told.
thread_local char lastError[1024] = "";

void fail(const char* what) noexcept { std::strncpy(lastError, what, sizeof lastError - 1); }

/// What `make` returns, or zero.
template <class Make>
auto guarded(Make make) noexcept -> decltype(make()) {
    try {
        return make();
    } catch (const std::exception& error) {
        fail(error.what());
    } catch (...) {
        fail("unknown error");
    }
    return {};
}

template <class Handle>
Handle& given(Handle* handle, const char* what) {
    if (!handle)
        throw vtm::Error(std::string(what) + " is NULL");
    return *handle;
}

template <class Number, std::size_t n>
bool isZero(const Number (&numbers)[n]) {
    return std::all_of(numbers, numbers + n, [](Number x) { return x == 0; });
}

/// Programs in C may hand over any number.
int oneOf(int value, int last, const char* what) {
    if (value < 0 || value > last)
        throw std::invalid_argument(std::string("VtmRenderOptions: unknown ") + what);
    return value;
}

/// The default stays where C says nothing.
void assign(std::string& to, const char* given) {
    if (given)
        to = given;
}

vtm::LoadOptions optionsOf(const VtmLoadOptions& c) {
    vtm::LoadOptions options;
    assign(options.name, c.name);
    assign(options.folder, c.folder);
    options.dpi = c.dpi == 0 ? options.dpi : c.dpi;
    assign(options.language, c.language);
    for (const char* const* directory = c.fontDirectories; directory && *directory; ++directory)
        options.fonts.directories.emplace_back(*directory);
    options.fonts.systemFonts = !c.noSystemFonts;
    assign(options.fonts.serifFamily, c.serifFamily);
    assign(options.fonts.sansSerifFamily, c.sansSerifFamily);
    assign(options.fonts.cursiveFamily, c.cursiveFamily);
    assign(options.fonts.fantasyFamily, c.fantasyFamily);
    assign(options.fonts.monospaceFamily, c.monospaceFamily);
    assign(options.fonts.defaultFamily, c.defaultFamily);
    options.defaultFontSize = c.defaultFontSize == 0 ? options.defaultFontSize : c.defaultFontSize;
    return options;
}

std::optional<int> side(int pixels) { return pixels == 0 ? std::nullopt : std::optional(pixels); }

vtm::RenderOptions optionsOf(const VtmRenderOptions& c) {
    vtm::RenderOptions options;
    options.width = side(c.width);
    options.height = side(c.height);
    options.scale = c.scale == 0 ? 1 : c.scale;
    options.fit = vtm::Fit(oneOf(c.fit, VTM_FIT_STRETCH, "fit"));
    if (!isZero(c.view))
        options.view = {c.view[0], c.view[1], c.view[2], c.view[3]};
    options.rotation = c.rotation;
    if (!isZero(c.matrix))
        std::copy(c.matrix, c.matrix + 6, options.matrix.emplace().begin());
    options.background = {c.background[0], c.background[1], c.background[2], c.background[3]};
    options.engine = vtm::Engine(oneOf(c.engine, VTM_ENGINE_GL, "engine"));
    return options;
}

static_assert(int(vtm::Fit::Contain) == VTM_FIT_CONTAIN && int(vtm::Fit::Cover) == VTM_FIT_COVER &&
              int(vtm::Fit::Stretch) == VTM_FIT_STRETCH);
static_assert(int(vtm::Engine::Auto) == VTM_ENGINE_AUTO && int(vtm::Engine::Cpu) == VTM_ENGINE_CPU &&
              int(vtm::Engine::Gl) == VTM_ENGINE_GL);

}  // namespace

const char* vtmVersion(void) { return vtm::version(); }

const char* vtmGetError(void) { return lastError; }

VtmPicture* vtmLoadPicture(const char* path) { return vtmLoadPictureWithOptions(path, nullptr); }

VtmPicture* vtmLoadPictureFromMemory(const void* bytes, size_t size, const char* name) {
    VtmLoadOptions options{};
    options.name = name;
    return vtmLoadPictureFromMemoryWithOptions(bytes, size, &options);
}

VtmPicture* vtmLoadPictureWithOptions(const char* path, const VtmLoadOptions* options) {
    return guarded([&] {
        const std::string file = &given(path, "the path");
        return new VtmPicture{vtm::Picture::load(file, options ? optionsOf(*options) : vtm::LoadOptions())};
    });
}

VtmPicture* vtmLoadPictureFromMemoryWithOptions(const void* bytes, size_t size,
                                                const VtmLoadOptions* options) {
    return guarded([&] {
        const auto* first = static_cast<const std::uint8_t*>(bytes);
        if (!first && size > 0)
            given(first, "the memory");
        return new VtmPicture{
            vtm::Picture::load(std::span(first, size), options ? optionsOf(*options) : vtm::LoadOptions())};
    });
}

void vtmDestroyPicture(VtmPicture* picture) { delete picture; }

double vtmPictureWidth(const VtmPicture* picture) {
    return guarded([&] { return given(picture, "the picture").picture.width(); });
}

double vtmPictureHeight(const VtmPicture* picture) {
    return guarded([&] { return given(picture, "the picture").picture.height(); });
}

size_t vtmPictureWarningCount(const VtmPicture* picture) {
    return guarded([&] { return given(picture, "the picture").picture.warnings().size(); });
}

size_t vtmGetPictureWarning(const VtmPicture* picture, size_t index, char* text, size_t size) {
    return guarded([&]() -> std::size_t {
        const auto warnings = given(picture, "the picture").picture.warnings();
        if (index >= warnings.size())
            return 0;
        const std::string& warning = warnings[index];
        if (text && size > 0)
            text[warning.copy(text, size - 1)] = 0;
        return warning.size();
    });
}

int vtmSavePicture(const VtmPicture* picture, const char* path) {
    return guarded([&] {
        given(picture, "the picture").picture.save(&given(path, "the path"));
        return 1;
    });
}

VtmImage* vtmRenderPicture(const VtmPicture* picture, const VtmRenderOptions* options) {
    return guarded([&] {
        const vtm::Picture& drawn = given(picture, "the picture").picture;
        return new VtmImage{drawn.render(options ? optionsOf(*options) : vtm::RenderOptions())};
    });
}

void vtmDestroyImage(VtmImage* image) { delete image; }

int vtmImageWidth(const VtmImage* image) {
    return guarded([&] { return given(image, "the image").image.width; });
}

int vtmImageHeight(const VtmImage* image) {
    return guarded([&] { return given(image, "the image").image.height; });
}

VtmEngine vtmImageEngine(const VtmImage* image) {
    return guarded([&] { return VtmEngine(given(image, "the image").image.engine); });
}

const uint8_t* vtmImagePixels(const VtmImage* image) {
    return guarded([&]() -> const uint8_t* { return given(image, "the image").image.rgba.data(); });
}

int vtmSaveImage(const VtmImage* image, const char* path) {
    return guarded([&] {
        given(image, "the image").image.save(&given(path, "the path"));
        return 1;
    });
}
