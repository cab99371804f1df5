#include "conformance/vgscript/src/frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "conformance/vgscript/src/names.hpp"

namespace vtm::vgscript {

namespace {

template <class T>
double load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

template <class T>
void store(std::uint8_t* bytes, T value) {
    std::memcpy(bytes, &value, sizeof value);
}

}  // namespace

Memory::Memory(char elementType, std::size_t elementCount)
    : type(elementType),
      count(elementCount),
      bytes(elementCount * elementSize(elementType) + guardBytes, filler) {}

std::size_t Memory::elementSize(char type) {
    switch (type) {
        case 'b':
            return 1;
        case 'h':
            return 2;
        case 'w':
        case 'i':
        case 'f':
            return 4;
        default:
            return 0;
    }
}

double Memory::at(std::size_t i) const {
    const std::uint8_t* place = bytes.data() + i * elementSize(type);
    switch (type) {
        case 'b':
            return *place;
        case 'h':
            return load<std::uint16_t>(place);
        case 'w':
            return load<std::uint32_t>(place);
        case 'i':
            return load<std::int32_t>(place);
        default:
            return load<float>(place);
    }
}

void Memory::set(std::size_t i, double value) {
    std::uint8_t* place = bytes.data() + i * elementSize(type);
    const auto bits = std::uint64_t(std::int64_t(type == 'f' ? 0 : value));
    switch (type) {
        case 'b':
            *place = std::uint8_t(bits);
            break;
        case 'h':
            store(place, std::uint16_t(bits));
            break;
        case 'w':
        case 'i':
            store(place, std::uint32_t(bits));
            break;
        default:
            store(place, float(value));
    }
}

bool Memory::isGuardIntact() const {
    return std::all_of(bytes.end() - guardBytes, bytes.end(), [](std::uint8_t b) { return b == filler; });
}

const Memory* Frame::memory(const std::string& name) const {
    const auto found = memories_.find(name);
    return found == memories_.end() ? nullptr : &found->second;
}

double Frame::number(const Word& word) const {
    if (word.isList || word.isQuoted)
        fail("a number was expected");
    const std::size_t bar = word.text.find('|');
    if (bar != std::string::npos) {
        const double left = number({word.text.substr(0, bar), {}}),
                     right = number({word.text.substr(bar + 1), {}});
        return double(std::uint32_t(std::int64_t(left)) | std::uint32_t(std::int64_t(right)));
    }
    if (const auto found = numbers_.find(word.text); found != numbers_.end())
        return found->second;
    if (const auto constant = constantOf(word.text))
        return *constant;
    try {
        std::size_t used = 0;
        const double value = std::stod(word.text, &used);  // decimal, hexadecimal, inf, nan
        if (used == word.text.size())
            return value;
    } catch (const std::exception&) {
    }
    fail(fmt::format("'{}' is neither a number, nor a name in VG/openvg.h, nor a variable", word.text));
}

std::int64_t Frame::integer(const Word& word) const {
    const double value = number(word);
    if (value != std::floor(value) || value < -2147483648.0 || value > 4294967295.0)
        fail(fmt::format("'{}' is not an integer of 32 bits", word.text));
    return std::int64_t(value);
}

void* Frame::pointer(const Word& word, char type) {
    if (word.isList) {
        if (!word.text.empty())
            type = word.text.size() == 1 ? word.text[0] : '?';
        if (Memory::elementSize(type) == 0)
            fail("say what the list holds: b[...], h[...], w[...], i[...] or f[...]");
        Memory& list = lists_.emplace_back(type, word.items.size());
        for (std::size_t i = 0; i < word.items.size(); ++i)
            list.set(i, type == 'f' ? number(word.items[i]) : double(integer(word.items[i])));
        return list.bytes.data();
    }
    if (word.text == "NULL")
        return nullptr;
    if (const std::size_t colon = word.text.find(':'); colon != std::string::npos) {
        const char wanted = colon + 1 < word.text.size() ? word.text[colon + 1] : '?';
        const double count = number({word.text.substr(std::min(colon + 2, word.text.size())), {}});
        if (Memory::elementSize(wanted) == 0 || !(count >= 0 && count <= 1e6))
            fail(fmt::format("'{}': results are declared as NAME:f4, with b, h, w, i or f", word.text));
        const std::string name = word.text.substr(0, colon);
        memories_.erase(name);
        return memories_.emplace(name, Memory(wanted, std::size_t(count))).first->second.bytes.data();
    }
    const std::size_t plus = word.text.find('+');
    const auto found = memories_.find(word.text.substr(0, plus));
    if (found == memories_.end())
        fail(fmt::format("'{}' is no memory: a list, NULL, NAME:f4 or an earlier NAME was expected",
                         word.text));
    const double offset = plus == std::string::npos ? 0 : number({word.text.substr(plus + 1), {}});
    if (!(offset >= 0 && offset <= double(found->second.bytes.size())))
        fail(fmt::format("'{}' lies outside", word.text));
    return found->second.bytes.data() + std::size_t(offset);
}

std::vector<std::string> Frame::finishCall() {
    std::vector<std::string> broken;
    for (const auto& [name, memory] : memories_)
        if (!memory.isGuardIntact())
            broken.push_back(name);
    lists_.clear();
    return broken;
}

}  // namespace vtm::vgscript
