/// \file
/// The backend's programs, each compiled when it is first needed, and users' GLSL as a part of them.
#pragma once

#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <vtm/asset/asset.hpp>
#include <vtm/gl/renderer.hpp>
#include "backend_gl/core/features.hpp"
#include "backend_gl/core/program.hpp"

namespace vtm::gl {

/// Every material's text, and the function that chooses among them:
///     vec4 materialColor(uint material, vec2 p)
/// It comes last in a shader, so that a name that is taken is an error of the user's line. `#line` makes a
/// driver's log count lines from the beginning of each text, material i being source string `materialString`
/// + i.
std::string materialsSource(std::span<const asset::Material> materials);
inline constexpr int materialString = 30000;  // above any string or line of ours

/// A compiler's message that begins with the material and the line at fault, where its log names one:
/// "material 'wood', line 3: ...". Where it names none (Mesa does not for functions defined twice): with all
/// materials.
std::string blamedOnMaterial(std::span<const asset::Material> materials, const std::string& message);

/// Programs of a mask's leaves.
enum class LeafProgram : unsigned {
    Solid,  ///< all inside
    Pieces
};
inline constexpr unsigned leafProgramCount = 2;

/// Programs of filters.
enum class FilterProgram : unsigned {
    Source,  ///< a picture as a layer
    PerPixel,
    Blur,
    Extreme,
    Move,
    Convolve,
    Light,
    Turbulence,
    Result  ///< a layer in a picture
};
/// Which of the programs: of PerPixel and Move by FilterOp, of Blur by BlurAction, of Result 1 where it
/// interpolates. Others have one.
using FilterVariant = unsigned;

/// Texture units, the same in every program.
enum class Unit : int { Texels, Images, Placements, Layer, Backdrop, Tiles };
inline constexpr std::size_t unitCount = 6;

/// Of numbers, which have one program only.
ProgramSource idsSource();

/// Each throws GlError with the driver's log where a program does not compile.
class Programs {
public:
    explicit Programs(const std::string& cacheDirectory = {}) : cache_(cacheDirectory) {}

    /// Materials that programs are compiled with, each list once. Number 0 is none.
    unsigned materialSet(std::span<const asset::Material> materials);

    const Program& leaf(LeafProgram program);
    /// Of a picture: blocks of one colour, and others.
    const Program& flat(Finish finish);
    /// Of one plain paint (backend_gl/tiles/plain_paints.hpp).
    const Program& plainFlat(Features features, bool isBent, Finish finish);
    /// `crowded`: some cells' pixels come from a texture.
    const Program& tile(Features features, unsigned materialSet, Finish finish, bool crowded = false);
    /// Of solid colours, two or several, without crowded cells. `isLong`: where cells have many pieces.
    const Program& solidTile(bool twoColors, bool isLong, Finish finish);
    /// Of plain paints that change little over a pixel. `isBent`: their means are those of several points.
    const Program& plainTile(Features features, bool isBent, Finish finish, bool crowded = false);
    const Program& fill(Features features, unsigned materialSet = 0);
    const Program& layer();
    const Program& blend();
    /// A finished picture into a user's framebuffer.
    const Program& compose(Finish finish);
    const Program& filter(FilterProgram program, FilterVariant variant = 0);

    /// Begin to compile, before anything is drawn: the programs of a picture with these paints, of its
    /// layers, of what puts them into a framebuffer. Where the driver compiles on threads of its own, false
    /// until it is done.
    bool warmUpPicture(Features features, unsigned materialSet, Finish finish);
    bool warmUpLayers(Features features, unsigned materialSet);
    bool warmUpCompose(Finish finish);

    ProgramFigures figures() const;

    /// The text of every program that there can be, numbers' too, with no materials.
    /// Features and finishes, which have no names in common, are combined with none and all of the others.
    static std::vector<ProgramSource> everySource();

private:
    enum class Kind : unsigned {
        Solid,
        Pieces,
        Flat,
        PlainFlat,
        Tile,
        CrowdedTile,
        LongTile,
        TwoColorTile,
        LongTwoColorTile,
        PlainTile,
        CrowdedPlainTile,
        Fill,
        Layer,
        Blend,
        Compose
    };
    static Features plainOf(Features features, bool isBent);
    using Key = std::tuple<Kind, unsigned, unsigned, unsigned>;  ///< features, material set, finish
    static Key keyOf(Kind kind, Features features, unsigned materialSet, Finish finish);
    const Program& get(Kind kind, Features features, unsigned materialSet = 0, Finish finish = {});
    Program& begun(const Key& key);
    const Program& complete(const Key& key);
    bool warmUp(const std::vector<Key>& keys);
    static ProgramSource source(Kind kind, Features features, Finish finish, std::string_view materials);

    static ProgramSource filterSource(FilterProgram program, FilterVariant variant);

    struct MaterialSet {
        std::vector<asset::Material> materials;
        std::string source;
    };
    ProgramCache cache_;
    std::vector<MaterialSet> materialSets_{{{}, materialsSource({})}};
    std::map<Key, Program> programs_;
    std::map<std::pair<FilterProgram, FilterVariant>, Program> filters_;
};

}  // namespace vtm::gl
