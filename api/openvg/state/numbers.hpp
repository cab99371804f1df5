/// \file
/// How parameters pass between the program's integers and floats and ours (specification section 5.2).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "api/openvg/state/error.hpp"
#include "api/openvg/state/state.hpp"

namespace vtm::openvg {

/// The values of a parameter: doubles hold every VGint and every VGfloat.
using Values = std::vector<double>;

/// Down, and to the nearest that there is.
inline VGint toInt(double v) {
    return std::isnan(v) ? 0 : VGint(std::clamp(std::floor(v), -2147483648.0, 2147483647.0));
}
inline VGfloat toFloat(double v) { return VGfloat(v); }

/// One of the numbers `first` to `last`.
inline VGint toEnumerator(double v, VGint first, VGint last) {
    const VGint value = toInt(v);
    require(value >= first && value <= last);
    return value;
}

template <std::size_t N>
std::array<VGfloat, N> toFloats(std::span<const double> v) {
    require(v.size() == N);
    std::array<VGfloat, N> floats;
    std::ranges::transform(v, floats.begin(), toFloat);
    return floats;
}

template <class Numbers>
Values toValues(const Numbers& numbers) {
    return Values(numbers.begin(), numbers.end());
}

/// What a setter was given; throws for sizes and pointers that no parameter takes.
template <class T>
Values given(VGint count, const T* values) {
    require(count >= 0);
    require(count == 0 || (values != nullptr && isAligned(values)));
    return count == 0 ? Values() : Values(values, values + count);
}

/// Stores the first `count` values where a getter was asked to.
template <class T>
void store(const Values& values, VGint count, T* to) {
    require(to != nullptr && isAligned(to));
    require(count > 0 && std::size_t(count) <= values.size());
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        if constexpr (std::is_same_v<T, VGint>)
            to[i] = toInt(values[i]);
        else
            to[i] = toFloat(values[i]);
    }
}

}  // namespace vtm::openvg
