#include "compiler/filters/append_asset.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <string>
#include <utility>

#include <vtm/compiler/compile.hpp>
#include "asset/records.hpp"

namespace vtm::compiler {
namespace {

using asset::Asset;
using asset::Command;
using asset::Entry;
using asset::Texel;

template <class Record>
void append(std::vector<Record>& to, const std::vector<Record>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

template <class Record>
void storeAt(std::vector<Texel>& data, std::size_t texel, const Record& record) {
    const auto texels = std::bit_cast<std::array<Texel, sizeof(Record) / sizeof(Texel)>>(record);
    std::ranges::copy(texels, data.begin() + std::ptrdiff_t(texel));
}

/// Where the records of a part begin in the asset.
struct Bases {
    std::uint32_t maps, nodes, leaves, pieces, paints, data, images, trees, instances, symbols, palettes,
        filters, primitives, words;

    explicit Bases(const Asset& a)
        : maps(size(a.maps)),
          nodes(size(a.nodes)),
          leaves(size(a.leaves)),
          pieces(size(a.pieces)),
          paints(size(a.paints)),
          data(size(a.data)),
          images(size(a.images)),
          trees(size(a.instanceTrees)),
          instances(size(a.instances)),
          symbols(size(a.symbols)),
          palettes(size(a.palettes)),
          filters(size(a.filters)),
          primitives(size(a.filterPrimitives)),
          words(size(a.filterWords)) {}

private:
    template <class Records>
    static std::uint32_t size(const Records& records) {
        return static_cast<std::uint32_t>(records.size());
    }
};

class Appending {
public:
    Appending(const Asset& part, glm::dvec2 by, Asset& asset)
        : part_(part), by_(by), asset_(asset), base_(asset) {
        const auto add = [&](Entry::Kind kind, std::uint32_t payload) {
            addedTo_[static_cast<std::size_t>(kind)] = payload << 2;
        };
        add(Entry::Kind::Leaf, base_.leaves);
        add(Entry::Kind::Node, base_.nodes);
        add(Entry::Kind::Instances, base_.instances * asset::maxInstancesPerCell);
    }

    void run() {
        appendPaints();
        appendTrees();
        appendInstances();
        appendFilters();
        appendCommands();
    }

private:
    /// Its payload counts from where the part's records begin.
    Entry moved(Entry entry) const { return {entry.bits + addedTo_[entry.bits & 3]}; }

    void appendTrees() {
        append(asset_.nodes, part_.nodes);
        for (asset::Node& node : std::span(asset_.nodes).subspan(base_.nodes))
            for (Entry& child : node.children)
                child = moved(child);
        append(asset_.leaves, part_.leaves);
        for (asset::Leaf& leaf : std::span(asset_.leaves).subspan(base_.leaves))
            leaf.firstPiece += base_.pieces;
        append(asset_.pieces, part_.pieces);
        std::vector<bool> isPlaced(part_.maps.size());
        for (const asset::Symbol& symbol : part_.symbols)
            isPlaced[symbol.map] = true;
        for (std::size_t i = 0; i < part_.maps.size(); ++i) {
            asset::Map map = part_.maps[i];
            map.root = moved(map.root);
            map.instances += map.instances == 0 ? 0 : base_.trees;
            if (!isPlaced[i]) {
                map.x += by_.x;
                map.y += by_.y;
            }
            asset_.maps.push_back(map);
        }
    }

    void appendInstances() {
        if (part_.symbols.empty())
            return;
        if (asset_.symbols.size() + part_.symbols.size() > 0x10000 || asset_.maps.size() > 0x10000 ||
            asset_.instances.size() + part_.instances.size() > asset::maxInstances)
            throw LimitError("the picture, which has filters, has more than 65536 symbols or 2^24 instances");
        for (asset::InstanceTree tree : part_.instanceTrees) {
            tree.root = moved(tree.root);
            tree.next += tree.next == 0 ? 0 : base_.trees;
            asset_.instanceTrees.push_back(tree);
        }
        for (const asset::Instance& instance : part_.instances)
            asset_.instances.push_back(
                asset::Instance::make(static_cast<std::uint16_t>(instance.symbol() + base_.symbols),
                                      instance.centre(), instance.linear()));
        for (asset::Symbol symbol : part_.symbols) {
            symbol.map = static_cast<std::uint16_t>(symbol.map + base_.maps);
            symbol.palette += base_.palettes;
            asset_.symbols.push_back(symbol);
        }
        append(asset_.palettes, part_.palettes);
    }

    // ---- Paints ----

    void appendPaints() {
        for (const asset::Material& material : part_.materials) {
            const auto known = std::ranges::find(asset_.materials, material.name, &asset::Material::name);
            materials_.push_back(static_cast<std::uint32_t>(known - asset_.materials.begin()));
            if (known == asset_.materials.end())
                asset_.materials.push_back(material);
        }
        append(asset_.paints, part_.paints);
        append(asset_.data, part_.data);
        append(asset_.images, part_.images);
        std::vector<bool> isMoved(part_.data.size() + 1);  // programs and records, by where they begin
        for (Texel& paint : std::span(asset_.paints).subspan(base_.paints)) {
            if (!asset::isProgram(paint))
                continue;
            const std::uint32_t first = paint[0];
            paint[0] += base_.data;
            if (isMoved[first])
                continue;
            isMoved[first] = true;
            for (std::uint32_t i = paint[0]; i < paint[0] + paint[1]; ++i)
                moveInstruction(i, isMoved);
        }
    }

    /// At a texel of the asset.
    void moveInstruction(std::uint32_t texel, std::vector<bool>& isMoved) {
        auto in = asset::recordAt<asset::Instruction>(asset_.data, texel);
        if (in.op < asset::Op::Solid)
            return;
        const std::uint32_t record = std::exchange(in.argument, in.argument + base_.data);
        if (in.op != asset::Op::Solid && !isMoved[record]) {
            isMoved[record] = true;
            if (in.op == asset::Op::Image)
                moveRecord<asset::ImageFill>(in.argument,
                                             [&](asset::ImageFill& fill) { fill.image += base_.images; });
            else if (in.op == asset::Op::Material)
                moveRecord<asset::MaterialFill>(in.argument, [&](asset::MaterialFill& fill) {
                    fill.material = materials_[fill.material];
                });
            else
                moveRecord<asset::Gradient>(in.argument, [](asset::Gradient&) {});
        }
        storeAt(asset_.data, texel, in);
    }

    /// Its matrix is of places of the picture.
    template <class Record, class Change>
    void moveRecord(std::uint32_t texel, Change change) {
        auto record = asset::recordAt<Record>(asset_.data, texel);
        auto& m = record.matrix;
        for (std::size_t row = 0; row < 2; ++row)
            m[4 + row] =
                static_cast<float>(double(m[4 + row]) - double(m[row]) * by_.x - double(m[2 + row]) * by_.y);
        change(record);
        storeAt(asset_.data, texel, record);
    }

    // ---- Filters and commands ----

    void appendFilters() {
        for (asset::Filter filter : part_.filters) {
            filter.firstPrimitive += base_.primitives;
            filter.matrix[4] += by_.x;
            filter.matrix[5] += by_.y;
            asset_.filters.push_back(filter);
        }
        for (asset::FilterPrimitive primitive : part_.filterPrimitives) {
            primitive.firstWord += base_.words;
            asset_.filterPrimitives.push_back(primitive);
        }
        append(asset_.filterWords, part_.filterWords);
    }

    void appendCommands() {
        if (asset_.commands.size() + part_.commands.size() > asset::maxCommands)
            throw LimitError("the picture needs more than " + std::to_string(asset::maxCommands) +
                             " commands");
        for (Command command : part_.commands) {
            switch (command.kind) {
                case Command::Kind::DrawMap:
                case Command::Kind::FillMask:
                    command.paint += base_.paints;
                    command.map += base_.maps;
                    break;
                case Command::Kind::ClipMask:
                    command.map += base_.maps;
                    break;
                case Command::Kind::PushInput:
                case Command::Kind::Filter:
                    command.map += base_.filters;
                    break;
                default:
                    break;
            }
            asset_.commands.push_back(command);
        }
    }

    const Asset& part_;
    const glm::dvec2 by_;
    Asset& asset_;
    const Bases base_;
    std::array<std::uint32_t, 4> addedTo_{};  ///< to the bits of an entry of a kind
    std::vector<std::uint32_t> materials_;    ///< of the part, in the asset
};

}  // namespace

void appendAsset(const asset::Asset& part, glm::dvec2 by, asset::Asset& asset) {
    Appending(part, by, asset).run();
}

}  // namespace vtm::compiler
