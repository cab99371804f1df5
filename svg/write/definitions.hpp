/// \file
/// Elements that others refer to by their ids, each written once.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vtm::svg {

/// Collects definitions while a document's body is made, then puts the two together. Texts that are equal are
/// one definition, however often they are made.
class Definitions {
public:
    /// Returns the id of an element. `rest` is its text behind the tag: attributes, content, end.
    std::string add(std::string_view tag, const std::string& rest);

    /// Returns a text that stands for `core`, the tag and first attributes of an element, for instance
    /// `path d="M0 0H9"`. It becomes `core`, or `use` with a reference to a definition where that is
    /// shorter. What is written behind it must mean the same on both.
    std::string shareable(const std::string& core);

    /// The definitions, if there are any, and the body, with what shareable() returned replaced. Without
    /// `shared` no `use` is written.
    std::string document(const std::string& body, bool shared) const;

private:
    struct Texts {
        std::unordered_map<std::string, std::size_t> numbers;
        std::vector<const std::string*> texts;  ///< keys of `numbers`
        std::size_t add(const std::string& text);
    };

    std::vector<std::string> sharedIds(const std::string& body) const;
    void append(std::string_view text, const std::vector<std::string>& ids, std::string& out) const;

    Texts elements_, cores_;
    std::vector<std::string> ids_;          ///< of the elements
    std::vector<std::size_t> tags_;         ///< lengths of their tags
    std::unordered_map<char, int> counts_;  ///< of ids by their first letter
};

}  // namespace vtm::svg
