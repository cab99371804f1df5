/// \file
/// Link, the shared pointer between nested parts of a scene. Nested parts are destroyed in a loop, not by
/// recursion: an importer may build a scene that is a million levels deep before validate() rejects it.
#pragma once

#include <memory>
#include <utility>

#pragma GCC visibility push(default)

namespace vtm::scene {

namespace detail {
/// Gives up the part. If this was its last owner, destroys it and then, one after the other, the parts that
/// it was the last owner of.
void release(std::shared_ptr<const void> part) noexcept;
}  // namespace detail

/// A shared_ptr to an immutable part that may contain links itself. May be null.
template <class Part>
class Link : public std::shared_ptr<const Part> {
    using Base = std::shared_ptr<const Part>;

public:
    using Base::Base;
    Link() = default;
    Link(Base part) noexcept : Base(std::move(part)) {}
    Link(const Link&) = default;
    Link(Link&&) noexcept = default;
    Link& operator=(const Link&) = default;
    Link& operator=(Link&&) noexcept = default;
    ~Link() {
        if (this->use_count() == 1)
            detail::release(static_cast<Base&&>(*this));
    }
};

}  // namespace vtm::scene

#pragma GCC visibility pop
