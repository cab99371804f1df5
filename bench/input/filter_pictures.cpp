#include "bench/input/filter_pictures.hpp"

#include <fstream>
#include <string>

namespace vtm::bench {
namespace {

struct Case {
    const char* name;
    const char* primitives;
};

constexpr Case cases[]{
    {"blur, deviation 3", R"(<feGaussianBlur stdDeviation="3"/>)"},
    {"blur, deviation 30", R"(<feGaussianBlur stdDeviation="30"/>)"},
    {"drop shadow", R"(<feDropShadow dx="8" dy="8" stdDeviation="6" flood-opacity="0.6"/>)"},
    {"colour matrix", R"(<feColorMatrix type="hueRotate" values="120"/>)"},
    {"morphology, radius 8", R"(<feMorphology operator="dilate" radius="8"/>)"},
    {"convolution, 5 x 5",
     R"(<feConvolveMatrix order="5" kernelMatrix="1 2 3 2 1 2 4 6 4 2 3 6 9 6 3 2 4 6 4 2 1 2 3 2 1"/>)"},
    {"specular light",
     R"(<feGaussianBlur in="SourceAlpha" stdDeviation="4"/><feSpecularLighting surfaceScale="5"
        specularExponent="20" lighting-color="#fc8"><fePointLight x="100" y="50" z="200"/></feSpecularLighting>
        <feComposite in2="SourceAlpha" operator="in"/><feComposite in="SourceGraphic" operator="arithmetic" k2="1" k3="1"/>)"},
    {"turbulence, 4 octaves", R"(<feTurbulence baseFrequency="0.02" numOctaves="4"/>
        <feComposite in2="SourceGraphic" operator="in"/>)"},
    {"displacement",
     R"(<feTurbulence baseFrequency="0.02" result="n"/><feDisplacementMap in="SourceGraphic" in2="n"
        scale="30" xChannelSelector="R" yChannelSelector="G"/>)"}};

constexpr const char* filtered =
    R"svg(<g filter="url(#f)"><path d="M 256,20 L 320,180 L 490,190 L 355,300 L 400,470 L 256,370
    L 112,470 L 157,300 L 22,190 L 192,180 Z" fill="#c04020"/><circle cx="256" cy="270" r="90" fill="#2060c0" opacity="0.8"/>
    <path d="M 60,420 C 160,300 360,500 460,60" stroke="#208040" stroke-width="24" fill="none"/></g>)svg";

}  // namespace

std::vector<File> writeFilterPictures(const std::filesystem::path& folder) {
    std::vector<File> files;
    for (const Case& one : cases) {
        const std::filesystem::path path = folder / (std::to_string(files.size()) + ".svg");
        std::ofstream(path)
            << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"512\" height=\"512\"><filter id=\"f\">"
            << one.primitives << "</filter>" << filtered << "</svg>\n";
        files.push_back({one.name, path});
    }
    return files;
}

}  // namespace vtm::bench
