#include "conformance/runner/kinds/svg_files.hpp"

#include <algorithm>
#include <span>

#include <vtm/svg/load.hpp>
#include <vtm/vtmtree.hpp>

namespace vtm::conformance {
namespace fs = std::filesystem;

namespace {

bool isPicture(const fs::path& file) { return file.extension() == ".svg" || file.extension() == ".vtmtree"; }

std::vector<fs::path> pictureFiles(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (isPicture(entry.path()))
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::string styled(const fs::path& file, std::string text, const std::string& style) {
    if (style.empty())
        return text;
    const std::size_t end = text.rfind("</svg>");
    if (end == std::string::npos || text.find("id=\"subject\"") == std::string::npos)
        throw SuiteError(file.string() + ": no element has id=\"subject\", which variants apply to");
    return text.insert(end, "<style>#subject{" + style + "}</style>");
}

}  // namespace

scene::Scene SvgCase::scene() const {
    const std::string text = styled(file, readText(file), style);
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    const std::string folder = file.parent_path().string();
    if (file.extension() == ".vtmtree")
        return readTree(bytes, {file.string(), folder}).toScene();
    svg::Options options;
    options.fileName = file.string();
    options.resourceDirectory = folder;
    return svg::load(bytes, options).scene;
}

std::vector<Case> svgCases(const Folder& folder, const std::function<Runner(const SvgCase&)>& make) {
    std::vector<Case> cases;
    const std::vector<Variant> variants = variantsOf(folder.settings);
    for (const fs::path& file : pictureFiles(folder.path)) {
        const std::string about = aboutOf(file, readText(file));
        for (const Variant& variant : variants) {
            SvgCase made{folder.name + "." + file.stem().string(), file, variant.style, folder.settings};
            if (!variant.name.empty())
                made.name += "." + variant.name;
            made.settings.merge_patch(variant.settings);
            cases.push_back({made.name, file.string(), about, make(made)});
        }
    }
    return cases;
}

}  // namespace vtm::conformance
