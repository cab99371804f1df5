#include "backend_gl/core/constants.hpp"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <vtm/asset/asset.hpp>
#include "backend_gl/core/turns.hpp"
#include "backend_gl/tiles/plain_paints.hpp"
#include "backend_gl/tiles/tile.hpp"
#include "raster/coverage.hpp"
#include "raster/filter_tables.hpp"

namespace vtm::gl {

namespace {

using asset::Blend;
using asset::ImageFilter;
using asset::Op;
using asset::Spread;

template <class Value>
std::string constant(std::string_view name, Value value) {
    return fmt::format("const uint {} = {}u;\n", name, static_cast<unsigned>(value));
}

std::string layout() {
    return constant("texelColumnsLog2", texelColumnsLog2) + constant("imageColumnsLog2", imageColumnsLog2) +
           constant("placementColumns", placementColumns) + constant("maxLevel", asset::maxLevel) +
           constant("leafExtent", asset::leafExtent) + constant("programTag", asset::programTag) +
           constant("longRamp", longRamp) + constant("kindSolid", asset::Entry::Kind::Solid) +
           constant("kindNode", asset::Entry::Kind::Node) +
           constant("kindInstances", asset::Entry::Kind::Instances) +
           fmt::format("const int maxStack = {};\nconst float slopeScale = {:.1f};\n", asset::maxStack,
                       asset::slopeScale) +

           fmt::format("const int chordCount = {};\nconst float smallestSpan = {:.17g};\n", asset::chordCount,
                       asset::smallestSpan);
}

std::string tiles() {
    return constant("leftOfChordBit", leftOfChordBit) + constant("leftOfCurveBit", leftOfCurveBit) +
           constant("crowdedBit", crowdedBit) + constant("lengthShift", lengthShift) +
           constant("lowLengthBits", lowLengthBits) + constant("firstTexelBits", firstTexelBits) +
           constant("gridShift", gridShift) + constant("plainTexelBits", plainTexelBits) +
           constant("radialBit", radialBit) + constant("plainTag", plainTag) +
           fmt::format("const float tileStep = {:.17g};\nconst float tileSlopeScale = {:.1f};\n",
                       std::ldexp(1.0, -int(tileStepLog2)), tileSlopeScale) +
           fmt::format("const vec2 referenceShift = vec2({}, {});\n", referenceShiftX, referenceShiftY);
}

std::string operations() {
    return constant("opPush", Op::Push) + constant("opPop", Op::Pop) +
           constant("opPopMaskLuminance", Op::PopMaskLuminance) +
           constant("opPopMaskLinear", Op::PopMaskLinear) + constant("opPopMaskAlpha", Op::PopMaskAlpha) +
           constant("opSolid", Op::Solid) + constant("opLinear", Op::Linear) +
           constant("opRadial", Op::Radial) + constant("opImage", Op::Image) +
           constant("opMaterial", Op::Material) + constant("filterNearest", ImageFilter::Nearest) +
           constant("filterTrilinear", ImageFilter::Trilinear) +
           constant("filterBicubic", ImageFilter::Bicubic) + constant("spreadPad", Spread::Pad) +
           constant("spreadReflect", Spread::Reflect) + constant("spreadRepeat", Spread::Repeat);
}

std::string blendModes() {
    return constant("blendNormal", Blend::Normal) + constant("blendMultiply", Blend::Multiply) +
           constant("blendScreen", Blend::Screen) + constant("blendOverlay", Blend::Overlay) +
           constant("blendDarken", Blend::Darken) + constant("blendLighten", Blend::Lighten) +
           constant("blendColorDodge", Blend::ColorDodge) + constant("blendColorBurn", Blend::ColorBurn) +
           constant("blendHardLight", Blend::HardLight) + constant("blendSoftLight", Blend::SoftLight) +
           constant("blendDifference", Blend::Difference) + constant("blendExclusion", Blend::Exclusion) +
           constant("blendHue", Blend::Hue) + constant("blendSaturation", Blend::Saturation) +
           constant("blendColor", Blend::Color) + constant("blendLuminosity", Blend::Luminosity) +
           constant("blendPlusLighter", Blend::PlusLighter);
}

std::string filterPrimitives() {
    using asset::FilterOp;
    return constant("primitiveBlend", FilterOp::Blend) +
           constant("primitiveColorMatrix", FilterOp::ColorMatrix) +
           constant("primitiveComponentTransfer", FilterOp::ComponentTransfer) +
           constant("primitiveComposite", FilterOp::Composite) +
           constant("primitiveDropShadow", FilterOp::DropShadow) +
           constant("primitiveFlood", FilterOp::Flood) + constant("primitivePicture", FilterOp::Picture) +
           constant("primitiveOffset", FilterOp::Offset) + constant("primitiveTile", FilterOp::Tile);
}

std::string filterParameters() {
    using asset::CompositeOp, asset::FilterEdge, asset::LightKind, asset::TransferKind;
    return constant("compositeOver", CompositeOp::Over) + constant("compositeIn", CompositeOp::In) +
           constant("compositeOut", CompositeOp::Out) + constant("compositeAtop", CompositeOp::Atop) +
           constant("compositeXor", CompositeOp::Xor) + constant("compositeLighter", CompositeOp::Lighter) +
           constant("transferDiscrete", TransferKind::Discrete) +
           constant("transferLinear", TransferKind::Linear) + constant("transferGamma", TransferKind::Gamma) +
           constant("edgeWrap", FilterEdge::Wrap) + constant("edgeNone", FilterEdge::None) +
           constant("lightDistant", LightKind::Distant) + constant("lightSpot", LightKind::Spot);
}

std::string actions() {
    return constant("actionClip", Action::Clip) + constant("actionMask", Action::Mask) +
           constant("actionOver", Action::Over);
}

}  // namespace

std::string glslConstants() { return layout() + tiles() + operations() + blendModes() + actions(); }

std::string filterConstants() {
    return filterPrimitives() + filterParameters() + constant("blurReduce", BlurAction::Reduce) +
           constant("blurKernel", BlurAction::Kernel) +
           fmt::format("const int maxBlurKernel = {};\nconst float layerSteps = 65535.0;\n",
                       asset::maxBlurKernel);
}

}  // namespace vtm::gl
