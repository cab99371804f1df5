/// \file
/// Custom properties and var(). Source: CSS Custom Properties 1.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vtm::svg {

/// The custom properties of an element, those that it inherits included. The text must outlive it.
class Variables {
public:
    /// `parent`: null for the root. A later declaration of a name replaces an earlier one.
    explicit Variables(std::shared_ptr<const Variables> parent) : parent_(std::move(parent)) {}
    void declare(std::string_view name, std::string_view value) { own_[name] = value; }

    /// A value with what its var() stand for. Nothing where a variable is missing and no fallback is given,
    /// where variables refer to each other in a circle, and where the result is very long.
    std::optional<std::string> substituted(std::string_view value) const;

private:
    /// What substituting may still do.
    struct Work {
        int depth = 32;      ///< variables in each other
        int lookups = 4096;  ///< variables
        /// Those that are being replaced, each referred to by the one before.
        std::vector<std::pair<const Variables*, std::string_view>> open{};
        std::size_t circle = none;  ///< which of them, and all behind it, refer to each other
        static constexpr std::size_t none = ~std::size_t(0);
    };
    std::optional<std::string> substituted(std::string_view value, Work& work) const;
    /// `--name` or `--name, fallback`
    std::optional<std::string> valueOf(std::string_view reference, Work& work) const;
    std::optional<std::string> find(std::string_view name, Work& work) const;
    using Declared = std::pair<const std::string_view, std::string_view>;
    std::optional<std::string> replaced(const Declared& variable, Work& work) const;

    std::shared_ptr<const Variables> parent_;
    std::unordered_map<std::string_view, std::string_view> own_;
};

/// Whether var() stands in a value.
bool hasVariables(std::string_view value);

}  // namespace vtm::svg
