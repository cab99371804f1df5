/// \file
/// What a running script knows: its variables, the memory that its calls see, and words as arguments.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "conformance/vgscript/src/script.hpp"

namespace vtm::vgscript {

/// Memory that a call reads or writes. It is followed by `guardBytes` of `filler`, which no call may change;
/// memory for results begins as `filler`, too.
struct Memory {
    static constexpr std::size_t guardBytes = 4096;
    static constexpr std::uint8_t filler = 0xa5;

    char type = 'b';        ///< b, h, w: 8, 16, 32 bits without sign; i: 32 with; f: floats
    std::size_t count = 0;  ///< of elements
    std::vector<std::uint8_t> bytes;

    Memory(char elementType, std::size_t elementCount);
    static std::size_t elementSize(char type);  ///< 0: no such type
    double at(std::size_t i) const;
    void set(std::size_t i, double value);
    bool isGuardIntact() const;
};

/// A call's result or an expected value.
struct Value {
    enum class Kind { Nothing, Number, Text } kind = Kind::Nothing;
    double number = 0;
    std::string text;
};

class Frame {
public:
    explicit Frame(const std::string& name) : name_(name) {}

    void at(int line) { line_ = line; }
    [[noreturn]] void fail(const std::string& what) const { vgscript::fail(name_, line_, what); }
    const std::string& name() const { return name_; }

    void setNumber(const std::string& name, double value) { numbers_[name] = value; }
    /// Null: no such memory.
    const Memory* memory(const std::string& name) const;

    /// A number, a constant of OpenVG, a variable, or several joined by `|`.
    double number(const Word& word) const;

    /// The argument that a word is for a parameter of type T.
    template <class T>
    T argument(const Word& word) {
        if constexpr (std::is_pointer_v<T>)
            return static_cast<T>(pointer(word, elementType<std::remove_cv_t<std::remove_pointer_t<T>>>()));
        else if constexpr (std::is_floating_point_v<T>)
            return T(number(word));
        else
            return T(integer(word));
    }

    /// After a call: names of memory that it wrote beyond the end of; forgets lists.
    std::vector<std::string> finishCall();

private:
    template <class T>
    static constexpr char elementType() {
        if constexpr (std::is_void_v<T>)
            return 0;
        else if constexpr (std::is_floating_point_v<T>)
            return 'f';
        else if constexpr (sizeof(T) == 1)
            return 'b';
        else if constexpr (sizeof(T) == 2)
            return 'h';
        else
            return std::is_unsigned_v<T> ? 'w' : 'i';
    }
    std::int64_t integer(const Word& word) const;
    /// `NULL`, a list (of `type`, unless it names its own), `NAME:f4` for results, or memory that was named
    /// before, perhaps some bytes on: `NAME+1`.
    void* pointer(const Word& word, char type);

    const std::string& name_;
    int line_ = 0;
    std::map<std::string, double> numbers_;
    std::map<std::string, Memory> memories_;
    std::vector<Memory> lists_;  ///< of the call that is being made
};

}  // namespace vtm::vgscript
