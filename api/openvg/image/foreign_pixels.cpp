// Images of pixels that another API keeps (VG_KHR_EGL_image, vtm/vg_image.h).

#include <atomic>
#include <map>
#include <mutex>
#include <vector>

#include <vtm/vg_image.h>
#include "api/openvg/draw/compositor.hpp"
#include "api/openvg/gl/texture_copy.hpp"
#include "api/openvg/image/shared_pixels.hpp"

namespace vtm::openvg {

namespace {

/// Where the pixels are. Bytes red, green, blue, alpha, as the image's format has them.
class ForeignCopy final : public PixelCopy {
public:
    ForeignCopy(const VtmForeignFunctions& functions, const VtmForeignPixels& opened)
        : functions_(functions), pixels_(opened.pixels) {
        if (opened.texture != 0 && glCompositor())
            texture_ = gl::copyIn(*gl::Device::open(), opened.hasAlpha ? GL_RGBA : GL_RGB, opened.texture,
                                  opened.width, opened.height);
    }
    ~ForeignCopy() override { functions_.close(pixels_); }
    ForeignCopy(const ForeignCopy&) = delete;
    ForeignCopy& operator=(const ForeignCopy&) = delete;

    void take(const Pixels& from) override {
        if (texture_)
            texture_->take(from);
        else
            functions_.write(pixels_, from.at(0, 0));
    }
    void give(Pixels& to) override {
        if (texture_)
            texture_->give(to);
        else
            functions_.read(pixels_, to.at(0, 0));
    }
    void finish() override {
        if (texture_)
            texture_->finish();
    }
    std::shared_ptr<const gl::Texture> texture() const override {
        return texture_ ? texture_->texture() : nullptr;
    }

private:
    const VtmForeignFunctions functions_;
    void* const pixels_;
    std::unique_ptr<PixelCopy> texture_;  ///< where the compositor's context has it; null: it has not
};

struct Foreign {
    VtmForeignFunctions functions{};
    void* owner = nullptr;
    std::weak_ptr<const SharedPixels> opened{};
};

/// Never destroyed: programs may call at any time.
struct Foreigners {
    std::mutex mutex;
    std::map<VGeglImageKHR, Foreign> named;
    struct Opened {
        std::weak_ptr<ImageStorage> storage;
        void* owner;
    };
    std::vector<Opened> opened;

    /// Those that there are, of one owner or, if that is null, of all.
    std::vector<std::shared_ptr<ImageStorage>> storages(void* owner) {
        const std::lock_guard lock(mutex);
        std::erase_if(opened, [](const Opened& one) { return one.storage.expired(); });
        std::vector<std::shared_ptr<ImageStorage>> found;
        for (const Opened& one : opened)
            if (!owner || one.owner == owner)
                if (std::shared_ptr<ImageStorage> storage = one.storage.lock())
                    found.push_back(std::move(storage));
        return found;
    }
};
Foreigners& foreigners() {
    static auto& foreigners = *new Foreigners;
    return foreigners;
}

std::atomic<void (*)()> finishFunction = nullptr;

std::shared_ptr<const SharedPixels> openedPixels(const Context& context, VGeglImageKHR name,
                                                 const Foreign& foreign) {
    const bool isOnGpu = context.surface && &compositorOf(context) == glCompositor();
    VtmForeignPixels found{};
    require(foreign.functions.open(foreign.owner, name, VGboolean(isOnGpu), &found),
            VG_UNSUPPORTED_IMAGE_FORMAT_ERROR);
    auto copy = std::make_unique<ForeignCopy>(foreign.functions, found);
    const VGImageFormat format = found.hasAlpha ? VG_sABGR_8888 : VG_sXBGR_8888;
    auto storage =
        std::make_shared<ImageStorage>(Pixels(found.width, found.height, *imageFormat(VGint(format))));
    storage->pixels.share(std::move(copy));
    const Rectangle area{0, 0, found.width, found.height};
    constexpr VGbitfield all =
        VG_IMAGE_QUALITY_NONANTIALIASED | VG_IMAGE_QUALITY_FASTER | VG_IMAGE_QUALITY_BETTER;
    auto pixels =
        std::make_shared<const SharedPixels>(SharedPixels{std::move(storage), area, VGint(format), all});
    pixels->storage->shared = pixels;
    return pixels;
}

}  // namespace

std::shared_ptr<const SharedPixels> foreignPixels(const Context& context, VGeglImageKHR name) {
    Foreigners& all = foreigners();
    const std::lock_guard lock(all.mutex);
    const auto it = all.named.find(name);
    if (it == all.named.end())
        return nullptr;
    Foreign& foreign = it->second;
    std::shared_ptr<const SharedPixels> pixels = foreign.opened.lock();
    if (!pixels) {
        pixels = openedPixels(context, name, foreign);
        foreign.opened = pixels;
        all.opened.push_back({pixels->storage, foreign.owner});
    }
    return pixels;
}

void handOverPixels() {
    vtmFinishForeignPixels(VG_FALSE);
    if (const auto function = finishFunction.load())
        function();
}

}  // namespace vtm::openvg

using namespace vtm::openvg;

VGboolean vtmNameForeignPixels(VGeglImageKHR name, const VtmForeignFunctions* functions, void* owner) try {
    const std::lock_guard lock(foreigners().mutex);
    foreigners().named.insert_or_assign(name, Foreign{*functions, owner});
    return VG_TRUE;
} catch (const std::bad_alloc&) {
    return VG_FALSE;
}

void vtmSetFinishFunction(void (*function)(void)) { finishFunction = function; }

void vtmForgetForeignPixels(VGeglImageKHR name, void* owner) {
    const std::lock_guard lock(foreigners().mutex);
    auto& named = foreigners().named;
    if (const auto it = named.find(name); it != named.end() && it->second.owner == owner)
        named.erase(it);
}

void vtmFinishForeignPixels(VGboolean mayChange) {
    for (const auto& storage : foreigners().storages(nullptr))
        storage->pixels.handOver(mayChange != VG_FALSE);
}

void vtmDetachForeignPixels(void* owner) {
    {
        const std::lock_guard lock(foreigners().mutex);
        std::erase_if(foreigners().named, [&](const auto& one) { return one.second.owner == owner; });
    }
    for (const auto& storage : foreigners().storages(owner))
        storage->pixels.setCopy(nullptr);
}
