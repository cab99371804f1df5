/// \file
/// An X server, for pictures on its windows and pixmaps without OpenGL. What is used of libxcb and libxcb-shm
/// is loaded when first needed; libX11 would end the process for a window that is none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace vtm::egl {

class XServer {
public:
    /// By a name as the variable DISPLAY has it. The connection is kept for ever. Null: there is none.
    static const XServer* named(const std::string& name);

    struct Drawable {
        std::uint32_t id;
        int width, height, depth;

        /// As the server has pictures: a word for each pixel, and rows that end at multiples of four bytes.
        std::size_t wordBytes() const { return depth == 16 ? 2 : 4; }
        std::size_t rowBytes() const { return (std::size_t(width) * wordBytes() + 3) / 4 * 4; }
    };
    /// Nothing if the server has no window or pixmap of this number. Answers after all that was asked for
    /// before is done.
    std::optional<Drawable> find(std::uintptr_t id) const;

    /// Memory that the server reads; of another machine it cannot.
    class SharedMemory {
    public:
        SharedMemory(const XServer& server, std::uint32_t segment, std::uint8_t* bytes, std::size_t size)
            : server_(server), segment_(segment), bytes_(bytes), size_(size) {}
        ~SharedMemory();
        SharedMemory(const SharedMemory&) = delete;
        SharedMemory& operator=(const SharedMemory&) = delete;

        std::uint8_t* bytes() const { return bytes_; }
        std::size_t size() const { return size_; }

    private:
        friend XServer;
        const XServer& server_;
        const std::uint32_t segment_;
        std::uint8_t* const bytes_;
        const std::size_t size_;
    };
    /// Null: the server shares none.
    std::unique_ptr<SharedMemory> share(std::size_t bytes) const;

    /// All rows of a picture. Shared memory must stay as it is until find() has answered.
    void put(const Drawable& drawable, const SharedMemory& picture) const;
    void put(const Drawable& drawable, const std::uint8_t* picture) const;

private:
    explicit XServer(void* connection);

    void* const connection_;
    std::size_t largestRequest_ = 0;  ///< bytes
    bool sharesMemory_ = false;
};

}  // namespace vtm::egl
