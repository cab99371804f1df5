#include "svg/css/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace vtm::svg {
namespace {

constexpr int maxNested = 32;  ///< of brackets in each other
constexpr std::array<std::string_view, 4> functions{"calc(", "min(", "max(", "clamp("};

MathValue scaled(MathValue v, double by) {
    v.number *= by;
    v.length *= by;
    v.percent *= by;
    return v;
}

bool isFinite(const MathValue& v) {
    return std::abs(v.number) <= maxNumber && std::abs(v.length) <= maxNumber &&
           std::abs(v.percent) <= maxNumber;
}

class MathReader {
public:
    MathReader(Cursor& cursor, const Units& units) : cursor_(cursor), units_(units) {}

    std::optional<MathValue> function(int depth) {
        if (depth > maxNested)
            return std::nullopt;
        for (const std::string_view name : functions)
            if (cursor_.consume(name))
                return call(name, depth);
        return std::nullopt;
    }

private:
    std::optional<MathValue> call(std::string_view name, int depth) {
        std::vector<MathValue> arguments;
        do {
            const auto argument = sum(depth);
            if (!argument || !isAlike(*argument, arguments))
                return std::nullopt;
            arguments.push_back(*argument);
        } while (cursor_.consume(','));
        if (!cursor_.consume(')'))
            return std::nullopt;
        if (name == "calc(")
            return arguments.size() == 1 ? std::optional(arguments[0]) : std::nullopt;
        for (const MathValue& v : arguments)
            if (v.hasPercent && v.length != 0)
                return std::nullopt;
        if (name == "clamp(") {
            if (arguments.size() != 3)
                return std::nullopt;
            return most(arguments[0], least(arguments[1], arguments[2]));
        }
        MathValue result = arguments[0];
        for (const MathValue& v : arguments)
            result = name == "min(" ? least(result, v) : most(result, v);
        return result;
    }

    static bool isOfOneKind(const MathValue& a, const MathValue& b) {
        return a.isLength == b.isLength && a.isAngle == b.isAngle;
    }
    /// Comparable, where functions compare: all numbers, all lengths or all percentages.
    static bool isAlike(const MathValue& value, const std::vector<MathValue>& others) {
        return others.empty() || (isOfOneKind(value, others[0]) && value.hasPercent == others[0].hasPercent);
    }
    static double key(const MathValue& v) {
        return v.hasPercent ? v.percent : v.isLength || v.isAngle ? v.length : v.number;
    }
    static MathValue least(const MathValue& a, const MathValue& b) { return key(b) < key(a) ? b : a; }
    static MathValue most(const MathValue& a, const MathValue& b) { return key(b) > key(a) ? b : a; }

    /// Terms with + or - between them, which have spaces around them.
    std::optional<MathValue> sum(int depth) {
        auto result = product(depth);
        while (result) {
            const bool spaced = isSpace(cursor_.peek());
            cursor_.skipSpaces();
            const char sign = cursor_.peek();
            if (!spaced || (sign != '+' && sign != '-'))
                break;
            cursor_.advance();
            if (!isSpace(cursor_.peek()))
                return std::nullopt;
            const auto term = product(depth);
            if (!term || !isOfOneKind(*term, *result))
                return std::nullopt;
            const double factor = sign == '+' ? 1 : -1;
            result->number += factor * term->number;
            result->length += factor * term->length;
            result->percent += factor * term->percent;
            result->hasPercent = result->hasPercent || term->hasPercent;
        }
        return result && isFinite(*result) ? result : std::nullopt;
    }

    std::optional<MathValue> product(int depth) {
        auto result = value(depth);
        while (result) {
            const Cursor before = cursor_;
            cursor_.skipSpaces();
            const bool isQuotient = cursor_.peek() == '/';
            if (!isQuotient && cursor_.peek() != '*') {
                cursor_ = before;  // sum() wants to see the spaces
                break;
            }
            cursor_.advance();
            const auto factor = value(depth);
            if (!factor)
                return std::nullopt;
            const auto isPlain = [](const MathValue& v) { return !v.isLength && !v.isAngle; };
            if (isQuotient ? !isPlain(*factor) || factor->number == 0
                           : !isPlain(*factor) && !isPlain(*result))
                return std::nullopt;
            if (isQuotient)
                result = scaled(*result, 1 / factor->number);
            else
                result = isPlain(*factor) ? scaled(*result, factor->number) : scaled(*factor, result->number);
        }
        return result && isFinite(*result) ? result : std::nullopt;
    }

    std::optional<MathValue> value(int depth) {
        cursor_.skipSpaces();
        if (startsMath(cursor_))
            return function(depth + 1);
        if (cursor_.consume('(')) {
            const auto inner = depth < maxNested ? sum(depth + 1) : std::nullopt;
            return inner && cursor_.consume(')') ? inner : std::nullopt;
        }
        Cursor ahead = cursor_;
        if (const auto number = ahead.number(); number && ahead.peek() != '%') {
            const std::string_view unit = ahead.unit();
            const auto degrees = degreesIn(unit);
            if (unit.empty() || degrees)
                cursor_ = ahead;
            if (unit.empty())
                return MathValue{*number};
            if (degrees)
                return MathValue{.length = *number * *degrees, .isAngle = true};
        }
        if (cursor_.consume("pi"))
            return MathValue{std::numbers::pi};
        auto length = readLength(cursor_, units_);
        if (!length)
            return std::nullopt;
        if (length->percent && units_.whole)
            length = Length{length->of(*units_.whole)};
        return length->percent ? MathValue{0, 0, length->value, true, true}
                               : MathValue{0, length->value, 0, true, false};
    }

    Cursor& cursor_;
    const Units& units_;
};

}  // namespace

bool startsMath(const Cursor& cursor) {
    return std::ranges::any_of(functions, [&](std::string_view name) {
        return equalsIgnoringCase(cursor.rest().substr(0, name.size()), name);
    });
}

std::optional<MathValue> readMath(Cursor& cursor, const Units& units) {
    return MathReader(cursor, units).function(0);
}

}  // namespace vtm::svg
