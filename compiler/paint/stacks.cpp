#include "compiler/paint/stacks.hpp"

#include "compiler/containers/hash.hpp"

namespace vtm::compiler {

std::size_t StackHash::operator()(const Stack& stack) const {
    std::uint64_t h = stack.size();
    for (std::uint32_t name : stack)
        h = hashCombine(h, name);
    return h;
}

std::uint32_t StackTable::add(const Stack& stack) {
    if (stacks_.empty() && !stack.empty())
        add({});
    const auto [found, isNew] = index_.try_emplace(stack, static_cast<std::uint32_t>(stacks_.size()));
    if (isNew)
        stacks_.push_back(&found->first);
    return found->second;
}

}  // namespace vtm::compiler
