/// \file
/// Roots of small polynomials, without allocations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

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

/// Bernstein coefficients, from those of powers.
template <std::size_t N>
Polynomial<N> bernsteinOf(Polynomial<N> p) {
    double binomial = 1;
    for (std::size_t k = 1; k < N; ++k) {
        binomial *= double(N - k) / double(k);
        p[k] /= binomial;
    }
    for (std::size_t k = N - 1; k > 0; --k)
        for (std::size_t i = k; i < N; ++i)
            p[i] += p[i - 1];
    return p;
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

/// The root between two places of which the polynomial is negative at one, `isLowNegative` says which:
/// Newton's step, or halving where that leaves the bracket.
template <std::size_t N>
double rootBetween(const Polynomial<N>& p, double low, double high, bool isLowNegative) {
    constexpr double exact = 0x1p-58;  // finer than the doubles of nearly all of [0, 1]
    constexpr int maxSteps = 100;      // halving alone takes 58; Newton's steps may be in vain
    const Polynomial<N - 1> slope = derivative(p);
    double t = (low + high) / 2;
    for (int i = 0; i < maxSteps; ++i) {
        const double value = evaluate(p, t);
        if (value == 0)
            return t;
        ((value < 0) == isLowNegative ? low : high) = t;
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

/// The two halves of a Bernstein polynomial's interval.
template <class T, std::size_t N>
std::pair<std::array<T, N>, std::array<T, N>> halves(std::array<T, N> b) {
    std::array<T, N> left{};
    for (std::size_t n = N; n > 0; --n) {
        left[N - n] = b[0];
        for (std::size_t i = 0; i + 1 < n; ++i)
            b[i] = (b[i] + b[i + 1]) * 0.5;
    }
    return {left, b};
}

/// Adds the roots of `p` in [from, to], where `bernstein` are its coefficients: no more than these change
/// their sign, and by an even number fewer. Roots closer together than 2^-`depth` of that are one or none.
template <std::size_t N>
void addRoots(const Polynomial<N>& p, const Polynomial<N>& bernstein, double from, double to, int depth,
              Roots<N - 1>& roots) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < N; ++i)
        changes += (bernstein[i - 1] < 0) != (bernstein[i] < 0);
    if (changes > 1 && depth > 0) {
        const auto [left, right] = halves(bernstein);
        const double middle = (from + to) / 2;
        addRoots(p, left, from, middle, depth - 1, roots);
        addRoots(p, right, middle, to, depth - 1, roots);
    } else if (changes % 2 != 0) {
        const double root = rootBetween(p, from, to, bernstein[0] < 0);
        if (root > 0 && root < 1 && roots.count < N - 1)  // rounding may find one twice
            roots.add(root);
    }
}

/// Real roots in the open interval (0, 1), rising; roots of even order may be left out.
template <std::size_t N>
Roots<N - 1> rootsInside(const Polynomial<N>& p) {
    constexpr int maxDepth = 32;
    Roots<N - 1> roots;
    addRoots(p, bernsteinOf(p), 0, 1, maxDepth, roots);
    return roots;
}

}  // namespace vtm::compiler::stroke
