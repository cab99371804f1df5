/// \file
/// Roots of small polynomials, without allocations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vtm::compiler::stroke {

/// Coefficients of powers of t, constant term first; N - 1 is the degree.
template <std::size_t N>
using Polynomial = std::array<double, N>;

/// From Bernstein coefficients: coefficient k is the k-th forward difference at 0, times n over k.
template <std::size_t N>
Polynomial<N> powers(Polynomial<N> bernstein) {
    for (std::size_t k = 1; k < N; ++k)
        for (std::size_t i = N - 1; i >= k; --i)
            bernstein[i] -= bernstein[i - 1];
    double binomial = 1;
    for (std::size_t k = 1; k < N; ++k) {
        binomial *= double(N - k) / double(k);
        bernstein[k] *= binomial;
    }
    return bernstein;
}

template <std::size_t N>
double evaluate(const Polynomial<N>& p, double t) {
    double value = 0;
    for (std::size_t i = N; i-- > 0;)
        value = value * t + p[i];
    return value;
}

template <std::size_t N>
Polynomial<N - 1> derivative(const Polynomial<N>& p) {
    Polynomial<N - 1> result;
    for (std::size_t i = 1; i < N; ++i)
        result[i - 1] = double(i) * p[i];
    return result;
}

template <std::size_t A, std::size_t B>
Polynomial<A + B - 1> product(const Polynomial<A>& a, const Polynomial<B>& b) {
    Polynomial<A + B - 1> result{};
    for (std::size_t i = 0; i < A; ++i)
        for (std::size_t j = 0; j < B; ++j)
            result[i + j] += a[i] * b[j];
    return result;
}

/// At most `Most` numbers, rising.
template <std::size_t Most>
struct Roots {
    std::array<double, Most> at{};
    std::size_t count = 0;

    const double* begin() const { return at.data(); }
    const double* end() const { return at.data() + count; }
    void add(double root) { at[count++] = root; }
};

/// The root between two places where the polynomial differs in sign: Newton's step, or halving where
/// that leaves the bracket.
template <std::size_t N>
double rootBetween(const Polynomial<N>& p, double low, double high) {
    constexpr double exact = 0x1p-58;  // finer than the doubles of nearly all of [0, 1]
    constexpr int maxSteps = 100;      // halving alone takes 58; Newton's steps may be in vain
    const Polynomial<N - 1> slope = derivative(p);
    const bool lowNegative = evaluate(p, low) < 0;
    double t = (low + high) / 2;
    for (int i = 0; i < maxSteps; ++i) {
        const double value = evaluate(p, t);
        if (value == 0)
            return t;
        ((value < 0) == lowNegative ? low : high) = t;
        double next = t - value / evaluate(slope, t);
        // Every fourth step halves, so that a slow approach from one side ends, too.
        if (i % 4 == 3 || !(next > low && next < high))
            next = (low + high) / 2;
        if (std::abs(next - t) <= exact)
            return next;
        t = next;
    }
    return t;
}

/// Real roots in the open interval (0, 1), rising; roots of even order may be left out.
template <std::size_t N>
Roots<N - 1> rootsInside(const Polynomial<N>& p) {
    Roots<N - 1> roots;
    if constexpr (N > 1) {
        // Between neighbouring extremes the polynomial is monotone and has at most one root.
        double from = 0, low = p[0];
        const auto look = [&](double to) {
            const double high = evaluate(p, to);
            if ((low < 0) != (high < 0))
                if (const double root = rootBetween(p, from, to); root > 0 && root < 1)
                    roots.add(root);
            from = to, low = high;
        };
        if constexpr (N > 2)
            for (const double extreme : rootsInside(derivative(p)))
                look(extreme);
        look(1);
    }
    return roots;
}

}  // namespace vtm::compiler::stroke
