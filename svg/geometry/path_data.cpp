#include "svg/geometry/path_data.hpp"

#include <numbers>
#include <type_traits>
#include <variant>

#include <glm/geometric.hpp>

#include <vtm/limits/limits.hpp>
#include "svg/css/cursor.hpp"

namespace vtm::svg {
namespace {

using scene::Point;

/// Relative commands add up the roundings of their numbers, so that a subpath ends beside where it began by
/// some last digits. Closed by so small a share of its length, it ends there: a line back would be a segment
/// with a direction and joins of its own, which nobody drew.
constexpr double closingSlack = 0x1p-20;
/// The last command, which gets another end, must be so many times as long.
constexpr double leastOfLast = 0x1p10;

char upper(char c) { return static_cast<char>(c & ~0x20); }

class PathReader {
public:
    explicit PathReader(std::string_view text) : in_(text) {}

    ParsedPath read() {
        in_.skipSpaces();
        bool complete = in_.atEnd() || upper(in_.peek()) == 'M';
        std::string_view unread = in_.rest();
        while (complete && !in_.atEnd()) {
            const std::string_view command = in_.rest();
            in_.advance();
            in_.skipSpaces();
            const std::string_view numbers = in_.rest();
            complete = commands(command.front());
            unread = in_.rest().size() < numbers.size() ? in_.rest() : command;
            in_.skipSpaces();
        }
        return {std::move(path_), complete, complete ? std::string_view{} : unread};
    }

private:
    /// A letter's arguments, repeated as often as they come. False at an error.
    bool commands(char letter) {
        relative_ = letter >= 'a';
        char kind = upper(letter);
        if (kind == 'Z') {
            close();
            return true;
        }
        do {
            limits::check();
            in_.skipSpaces();
            if (!command(kind))
                return false;
            previous_ = kind;
            kind = kind == 'M' ? 'L' : kind;
            in_.skipCommaSpaces();
        } while (startsNumber(in_.peek()));
        return true;
    }

    bool command(char kind) {
        switch (kind) {
            case 'M':
                return move();
            case 'L':
                return line();
            case 'H':
                return horizontal();
            case 'V':
                return vertical();
            case 'C':
                return cubic(false);
            case 'S':
                return cubic(true);
            case 'Q':
                return quadratic(false);
            case 'T':
                return quadratic(true);
            case 'A':
                return arc();
            default:
                return false;
        }
    }

    static bool startsNumber(char c) { return isDigit(c) || c == '-' || c == '+' || c == '.'; }

    /// A second Close on end closes nothing more: it would only add vertices for markers.
    void close() {
        if (previous_ != 'Z') {
            const double rest = glm::distance(current_, start_);
            if (rest > 0 && rest <= closingSlack * length_ && leastOfLast * rest <= last_)
                endAt(start_);
            path_.push_back(scene::Close{});
        }
        current_ = start_;
        length_ = 0;
        previous_ = 'Z';
    }

    /// Instead of where the last command ends.
    void endAt(Point p) {
        std::visit(
            [&]<class Command>(Command& last) {
                if constexpr (!std::is_same_v<Command, scene::MoveTo> &&
                              !std::is_same_v<Command, scene::Close>)
                    last.to = p;
            },
            path_.back());
    }

    bool move() {
        Point to;
        if (!point(to))
            return false;
        path_.push_back(scene::MoveTo{to});
        start_ = current_ = to;
        length_ = 0;
        return true;
    }

    bool lineTo(Point to) {
        path_.push_back(scene::LineTo{to});
        goTo(to);
        return true;
    }
    bool line() {
        Point to;
        return point(to) && lineTo(to);
    }
    bool horizontal() {
        double x = 0;
        return number(x) && lineTo({x + (relative_ ? current_.x : 0), current_.y});
    }
    bool vertical() {
        double y = 0;
        return number(y) && lineTo({current_.x, y + (relative_ ? current_.y : 0)});
    }

    bool cubic(bool smooth) {
        Point control1 = reflected('C', 'S'), control2, to;
        if ((!smooth && !(point(control1) && separator())) || !point(control2) || !separator() || !point(to))
            return false;
        path_.push_back(scene::CubicTo{control1, control2, to});
        control_ = control2;
        goTo(to);
        return true;
    }

    bool quadratic(bool smooth) {
        Point control = reflected('Q', 'T'), to;
        if ((!smooth && !(point(control) && separator())) || !point(to))
            return false;
        path_.push_back(scene::QuadTo{control, to});
        control_ = control;
        goTo(to);
        return true;
    }

    bool arc() {
        Point radii, to;
        double degrees = 0;
        bool large = false, sweep = false;
        if (!number(radii.x) || !separator() || !number(radii.y) || !separator() || !number(degrees) ||
            !separator() || !flag(large) || !separator() || !flag(sweep) || !separator() || !point(to))
            return false;
        path_.push_back(scene::ArcTo{radii, degrees * std::numbers::pi / 180, large, sweep, to});
        goTo(to);
        return true;
    }

    void goTo(Point to) {
        last_ = glm::distance(current_, to);
        length_ += last_;
        current_ = to;
    }

    /// The control point of a smooth curve: the last one mirrored, if the last command was of its kind.
    Point reflected(char kind, char smoothKind) const {
        return previous_ == kind || previous_ == smoothKind ? 2.0 * current_ - control_ : current_;
    }

    bool separator() {
        in_.skipCommaSpaces();
        return true;
    }
    bool number(double& value) {
        const auto read = in_.number();
        value = read.value_or(0);
        return read.has_value();
    }
    bool point(Point& p) {
        if (!number(p.x) || !separator() || !number(p.y))
            return false;
        if (relative_)
            p += current_;
        return true;
    }
    /// A single digit, after which anything may follow at once.
    bool flag(bool& value) {
        value = in_.peek() == '1';
        if (!value && in_.peek() != '0')
            return false;
        in_.advance();
        return true;
    }

    Cursor in_;
    scene::Path path_;
    Point current_{}, start_{}, control_{};
    double length_ = 0, last_ = 0;  ///< of the subpath, along its chords, and of the last one
    char previous_ = 0;
    bool relative_ = false;
};

}  // namespace

ParsedPath parsePathData(std::string_view text) { return PathReader(text).read(); }

ParsedPath parsePoints(std::string_view text) {
    ParsedPath parsed;
    Cursor in(text);
    in.skipSpaces();
    while (!in.atEnd()) {
        limits::check();
        const std::string_view point = in.rest();
        const auto x = in.number();
        in.skipCommaSpaces();
        const auto y = in.number();
        in.skipCommaSpaces();
        if (!x || !y) {
            parsed.complete = false;
            parsed.unread = in.atEnd() ? in.rest() : point;
            break;
        }
        if (parsed.path.empty())
            parsed.path.push_back(scene::MoveTo{{*x, *y}});
        else
            parsed.path.push_back(scene::LineTo{{*x, *y}});
    }
    return parsed;
}

std::string_view pathFunctionData(std::string_view text) {
    Cursor cursor(trim(text));
    if (equalsIgnoringCase(cursor.rest(), "none"))
        return {};
    if (!cursor.consume("path("))
        return text;
    cursor.skipSpaces();
    const char quote = cursor.peek();
    cursor.advance(cursor.atEnd() ? 0 : 1);
    return cursor.until(quote);
}

bool isPathFunction(std::string_view text) {
    return equalsIgnoringCase(trim(text).substr(0, 5), "path(") && trim(text).ends_with(')') &&
           parsePathData(pathFunctionData(text)).complete;
}

}  // namespace vtm::svg
