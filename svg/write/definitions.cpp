#include "svg/write/definitions.hpp"

#include <charconv>

#include <fmt/format.h>

#include <vtm/limits/limits.hpp>

namespace vtm::svg {
namespace {

// What stands for a core: its number between two characters that are in no other text.
constexpr char begin = '\1', end = '\2';

/// Calls `plain` and `core`, in turn, with the texts between cores and the numbers of cores.
template <class Plain, class Core>
void split(std::string_view text, Plain plain, Core core) {
    for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin)) {
        limits::check();
        plain(text.substr(0, at));
        const std::size_t stop = text.find(end, at);
        std::size_t number = 0;
        std::from_chars(text.data() + at + 1, text.data() + stop, number);
        core(number);
        text.remove_prefix(stop + 1);
    }
    plain(text);
}

std::string useOf(const std::string& id) { return "use href=\"#" + id + "\""; }
std::string elementOf(const std::string& core, const std::string& id) {
    return "<" + core + " id=\"" + id + "\"/>\n";
}

}  // namespace

std::size_t Definitions::Texts::add(const std::string& text) {
    const auto [found, isNew] = numbers.try_emplace(text, texts.size());
    if (isNew)
        texts.push_back(&found->first);
    return found->second;
}

std::string Definitions::add(std::string_view tag, const std::string& rest) {
    const std::size_t index = elements_.add(std::string(tag) + rest);
    if (index == ids_.size()) {
        ids_.push_back(fmt::format("{}{}", tag.front(), ++counts_[tag.front()]));
        tags_.push_back(tag.size());
    }
    return ids_[index];
}

std::string Definitions::shareable(const std::string& core) {
    return begin + std::to_string(cores_.add(core)) + end;
}

/// Of the cores that are definitions of their own; empty for the others.
std::vector<std::string> Definitions::sharedIds(const std::string& body) const {
    std::vector<std::size_t> uses(cores_.texts.size());
    const auto count = [&](std::string_view text) {
        split(
            text, [](std::string_view) {}, [&](std::size_t core) { ++uses[core]; });
    };
    for (const std::string* element : elements_.texts)
        count(*element);
    count(body);
    std::vector<std::string> ids(uses.size());
    int shared = 0;
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const std::string& core = *cores_.texts[i];
        const std::string id = fmt::format("s{}", shared + 1);
        const std::size_t inPlace = uses[i] * core.size(),
                          once = elementOf(core, id).size() + uses[i] * useOf(id).size();
        if (once < inPlace)
            ids[i] = id, ++shared;
    }
    return ids;
}

void Definitions::append(std::string_view text, const std::vector<std::string>& ids, std::string& out) const {
    split(
        text, [&](std::string_view plain) { out += plain; },
        [&](std::size_t core) { out += ids[core].empty() ? *cores_.texts[core] : useOf(ids[core]); });
}

std::string Definitions::document(const std::string& body, bool shared) const {
    const std::vector<std::string> shareds =
        shared ? sharedIds(body) : std::vector<std::string>(cores_.texts.size());
    std::string text;
    for (std::size_t i = 0; i < shareds.size(); ++i)
        if (!shareds[i].empty())
            text += elementOf(*cores_.texts[i], shareds[i]);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        const std::string_view element = *elements_.texts[i];
        text += fmt::format("<{} id=\"{}\"", element.substr(0, tags_[i]), ids_[i]);
        append(element.substr(tags_[i]), shareds, text);
        text += "\n";
    }
    if (!text.empty())
        text = "<defs>\n" + text + "</defs>\n";
    append(body, shareds, text);
    return text;
}

}  // namespace vtm::svg
