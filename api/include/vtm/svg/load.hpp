/// \file
/// SVG in, scene out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vtm/error.hpp>
#include <vtm/scene/fit.hpp>
#include <vtm/scene/scene.hpp>
#include <vtm/text/font_options.hpp>

#pragma GCC visibility push(default)

namespace vtm::svg {

/// A position in a file. Lines and columns count from 1; 0 means unknown.
struct Location {
    std::string file;
    int line = 0, column = 0;
};

/// The document cannot be read. The message is `file:line:column: cause`.
class ParseError : public Error {
public:
    ParseError(Location where, const std::string& what);
    const Location& where() const { return where_; }

private:
    Location where_;
};

/// Something that was left out or repaired; names the element, and the attribute or property if its value is
/// not one of its own. The picture is drawn without it.
struct Warning {
    enum class Kind {
        Filter,     ///< a filter that is in error, or part of one
        Font,       ///< a family that is not there or a font that cannot be used: another one is
        Element,    ///< another element that is not drawn
        Value,      ///< an attribute, a property or path data that cannot be read or drawn
        Reference,  ///< to nothing, to the wrong thing, in a circle; an image that cannot be drawn
        Limit       ///< what is beyond a limit of the importer
    };
    Kind kind = Kind::Element;
    Location where;
    std::string message;
};

struct Options {
    std::string fileName;           ///< for messages
    std::string resourceDirectory;  ///< relative hrefs start here; empty: no files are read
    std::string resourceRoot;       ///< files outside of this folder are not read; empty: all may be
    double dpi = 96;
    /// CSS that comes before the document's own style sheets, so that these win where both say the same.
    std::string styleSheet;
    /// Only this element is drawn, with all that is in it, where it stands in the picture. It inherits from
    /// its ancestors, but their opacity, clips, masks and filters are not applied. Empty: all.
    std::string exportId;
    std::string language = "en";  ///< for systemLanguage
    /// The size, in user units, of a document that has neither width and height nor a viewBox; and the
    /// viewport in which a root width or height in percent resolves.
    double defaultWidth = 100, defaultHeight = 100;
    text::FontOptions fonts;
    double defaultFontSize = 12;
};

/// Limits for hostile files, all of them errors or warnings, never silence.
struct Limits {
    static constexpr std::size_t maxBytes = 256u << 20;
    /// Nesting of elements, `use`, clipPath, mask, pattern, marker and image followed.
    static constexpr int maxDepth = 256;
    static constexpr std::size_t maxCompounds = 256;    ///< of one selector: `a b > c` has three
    static constexpr std::size_t maxNodes = 1'000'000;  ///< elements visited, `use` expanded
};

struct Document {
    scene::Scene scene;  ///< valid (scene::validate)
    /// If Options::exportId is set: the bounds, clipped to the picture, of the exported element's outlines,
    /// with enough room for the joins and caps of strokes.
    std::optional<scene::Rect> exported = {};
    std::vector<Warning> warnings;
};

/// Throws ParseError, also if Options::exportId names nothing that is drawn, and limits::Exceeded under a
/// budget (vtm/limits/limits.hpp). `bytes` may be gzip-compressed (SVGZ).
Document load(std::span<const std::uint8_t> bytes, const Options& options = {});

}  // namespace vtm::svg

#pragma GCC visibility pop
