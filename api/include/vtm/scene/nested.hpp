/// \file
/// How parts of a scene hold parts of their own kind. A scene may be nested a million levels deep before
/// anybody looks at it, so what is nested is destroyed by a loop: the stack stays flat.
#pragma once

#include <memory>
#include <utility>

#pragma GCC visibility push(default)

namespace vtm::scene {

namespace detail {
/// Destroys the part, if it is the last link to it, and the parts that it holds, one after the other.
void release(std::shared_ptr<const void> part) noexcept;
}  // namespace detail

/// A shared_ptr whose part may hold links again.
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
