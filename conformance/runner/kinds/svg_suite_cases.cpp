// The SVG test suite: all of it is drawn in one run of the vtm command and judged by the suite's own scorer
// (conformance/cases/svg_suite.py); a case a test, and one for the shares that must pass.

#include <cstdlib>
#include <map>
#include <mutex>

#include <fmt/core.h>

#include "conformance/cases/support.hpp"
#include "conformance/compare/compare.hpp"
#include "conformance/runner/kinds/kinds.hpp"

namespace vtm::conformance {
namespace {

namespace fs = std::filesystem;

struct Scores {
    std::map<std::string, std::string> verdicts;  ///< the script's, by a test's path
    std::string shares;                           ///< empty, or what the script said of them
};

/// Runs the script once, whoever asks first.
class Suite {
public:
    Suite(fs::path folder, std::string mode) : folder_(std::move(folder)), mode_(std::move(mode)) {}
    ~Suite() {
        std::error_code ignored;
        if (!pictures_.empty())
            fs::remove_all(pictures_, ignored);
    }

    const Scores& scores() {
        std::call_once(once_, [this] {
            try {
                run();
            } catch (const std::exception& error) {
                error_ = error.what();
            }
        });
        if (!error_.empty())
            throw SuiteError(error_);
        return scores_;
    }
    Pictures pictures(const std::string& test) const {
        const std::string png = test.substr(0, test.size() - 4) + ".png";
        return {"scorer", "300 px", compare::readPng((folder_ / "tests" / png).string()),
                compare::readPng((pictures_ / png).string())};
    }

private:
    void run() {
        std::string folder = (fs::temp_directory_path() / "vtm-svg-suite-XXXXXX").string();
        if (mkdtemp(folder.data()) == nullptr)
            throw SuiteError("no temporary folder can be made in " + fs::temp_directory_path().string());
        pictures_ = folder;
        const fs::path json = pictures_ / "verdicts.json";
        const std::string command = fmt::format(
            "'{}' '{}/conformance/cases/svg_suite.py' --vtm '{}' --mode {} --keep '{}' --verdicts '{}' > "
            "'{}' 2>&1",
            VTM_PYTHON, VTM_SOURCE_DIR, VTM_COMMAND, mode_, pictures_.string(), json.string(),
            (pictures_ / "log.txt").string());
        const int status = std::system(command.c_str());
        const std::string log = readText(pictures_ / "log.txt");
        if (!fs::exists(json))
            throw SuiteError("svg_suite.py failed: " + log);
        const nlohmann::json verdicts = nlohmann::json::parse(readText(json));
        for (const auto& [test, verdict] : verdicts.items())
            scores_.verdicts[test] = verdict.get<std::string>();
        if (status != 0)
            scores_.shares = log;
    }

    fs::path folder_, pictures_;
    std::string mode_;
    std::string error_;  ///< why there are no scores
    std::once_flag once_;
    Scores scores_;
};

std::string dotted(const std::string& test) {
    std::string name = test.substr(0, test.size() - 4);
    for (char& c : name)
        c = c == '/' ? '.' : c;
    return name;
}

Outcome run(Suite& suite, const std::string& test, const Setting& setting) {
    const Scores& scores = suite.scores();
    const auto found = scores.verdicts.find(test);
    const bool passed = found != scores.verdicts.end() && found->second != "failed";
    Outcome outcome = passed ? Outcome::passed() : Outcome::failed("the suite's scorer says no");
    if (passed && found->second == "edges")
        outcome.message = "differs at edges alone, as exact mode means them";
    if (found != scores.verdicts.end() && (!passed || setting.keepPictures))
        try {
            outcome.pictures = suite.pictures(test);
        } catch (const std::runtime_error&) {  // nothing was drawn
        }
    return outcome;
}

}  // namespace

std::vector<Case> svgSuiteCases(const Folder& folder) {
    const fs::path root = cases::sharedDirectory() / "svg-suite";
    if (!fs::exists(root))
        return {{folder.name + ".absent", root.string(), "The SVG test suite.",
                 [=](const Setting&) { return Outcome::skipped(root.string() + " is absent"); }}};
    const auto suite = std::make_shared<Suite>(root, folder.settings.value("mode", "compat"));
    std::vector<Case> cases{{folder.name + ".shares", "conformance/cases/svg_suite.py",
                             "The shares of the suite's folders that must pass.", [=](const Setting&) {
                                 const std::string& said = suite->scores().shares;
                                 return said.empty() ? Outcome::passed() : Outcome::failed(said);
                             }}};
    std::istringstream tests(readText(root / "tests.txt"));
    for (std::string test; std::getline(tests, test);)
        if (!test.empty())
            cases.push_back({folder.name + "." + dotted(test), (root / "tests" / test).string(),
                             "A test of the SVG test suite.",
                             [=](const Setting& setting) { return run(*suite, test, setting); }});
    return cases;
}

}  // namespace vtm::conformance
