#include "conformance/runner/kinds/kinds.hpp"

namespace vtm::conformance {
namespace {

struct Kind {
    const char* name;
    std::vector<Case> (*load)(const Folder&);
};

constexpr Kind kinds[] = {{"scene", sceneCases},
                          {"texture", textureCases},
                          {"random", randomCases},
                          {"paper", paperCases},
                          {"robustness", robustnessCases},
                          {"corpus", corpusCases},
                          {"svg-suite", svgSuiteCases},
                          {"openvg", openvgCases},
                          {"crowded", crowdedCases},
                          {"text", textCases},
                          {"pair", pairCases}};

}  // namespace

std::vector<Case> casesOf(const Folder& folder) {
    if (!folder.settings.contains("kind"))
        return {};
    const auto wanted = folder.settings.at("kind").get<std::string>();
    for (const Kind& kind : kinds)
        if (wanted == kind.name)
            return kind.load(folder);
    throw SuiteError("there is no kind '" + wanted + "'");
}

}  // namespace vtm::conformance
