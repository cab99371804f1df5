#include <vtm/scene/nested.hpp>

#include <algorithm>

#include <vtm/scene/scene.hpp>

namespace vtm::scene {
namespace {

using Pile = std::vector<std::shared_ptr<const void>>;

/// What waits to be destroyed, while a loop on this thread is at it.
thread_local constinit Pile* pile = nullptr;

void destroyAll(std::shared_ptr<const void> first) {
    Pile parts{std::move(first)};
    pile = &parts;
    while (!parts.empty()) {
        const auto part = std::move(parts.back());
        parts.pop_back();
    }
    pile = nullptr;
}

bool isFilledGroup(const Node& node) {
    const auto* group = std::get_if<Group>(&node.value);
    return group && !group->children.empty();
}

/// Levels of lists that are being copied on this thread.
thread_local constinit int copies = 0;

struct Copying {
    Copying() {
        if (++copies > 2 * maxNesting) {
            --copies;
            throw InvalidScene("groups are nested too deeply to be copied");
        }
    }
    ~Copying() { --copies; }
    Copying(const Copying&) = delete;
    Copying& operator=(const Copying&) = delete;
};

const NodeList& counted(const NodeList& list, const Copying&) { return list; }

}  // namespace

namespace detail {

/// Where memory for the pile is missing the part is destroyed at once, with what it holds.
void release(std::shared_ptr<const void> part) noexcept {
    try {
        if (pile)
            pile->push_back(std::move(part));
        else
            destroyAll(std::move(part));
    } catch (...) {
    }
}

}  // namespace detail

NodeList::NodeList() noexcept = default;
NodeList::NodeList(std::vector<Node> nodes) noexcept : std::vector<Node>(std::move(nodes)) {}
NodeList::NodeList(NodeList&&) noexcept = default;
NodeList& NodeList::operator=(NodeList&&) noexcept = default;

NodeList::NodeList(const NodeList& other) : std::vector<Node>(counted(other, Copying())) {}

NodeList& NodeList::operator=(const NodeList& other) { return *this = NodeList(other); }

NodeList::~NodeList() {
    if (!std::any_of(begin(), end(), isFilledGroup))
        return;
    try {
        detail::release(std::make_shared<const std::vector<Node>>(std::move(*this)));
    } catch (...) {
    }
}

}  // namespace vtm::scene
