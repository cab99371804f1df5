// Section 3.4.1: which configs match a list of attributes, and in which order they are given.

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include <vtm/egl.h>

#include "api/egl/state/attributes.hpp"
#include "api/egl/state/configs.hpp"
#include "api/egl/state/thread.hpp"

namespace vtm::egl {

namespace {

enum class Criterion { atLeast, exact, mask, ignored };

struct Rule {
    EGLint attribute, initial;
    Criterion criterion;
};

/// Table 3.4. EGL_CONFIG_ID, EGL_MATCH_NATIVE_PIXMAP and EGL_NATIVE_VISUAL_TYPE have sentences of their own.
constexpr std::array rules{
    Rule{EGL_BUFFER_SIZE, 0, Criterion::atLeast},
    Rule{EGL_RED_SIZE, 0, Criterion::atLeast},
    Rule{EGL_GREEN_SIZE, 0, Criterion::atLeast},
    Rule{EGL_BLUE_SIZE, 0, Criterion::atLeast},
    Rule{EGL_LUMINANCE_SIZE, 0, Criterion::atLeast},
    Rule{EGL_ALPHA_SIZE, 0, Criterion::atLeast},
    Rule{EGL_ALPHA_MASK_SIZE, 0, Criterion::atLeast},
    Rule{EGL_BIND_TO_TEXTURE_RGB, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_BIND_TO_TEXTURE_RGBA, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_COLOR_BUFFER_TYPE, EGL_RGB_BUFFER, Criterion::exact},
    Rule{EGL_COMPOSITOR_VTM, EGL_COMPOSITOR_AUTOMATIC_VTM, Criterion::exact},
    Rule{EGL_CONFIG_CAVEAT, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_CONFIG_ID, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_CONFORMANT, 0, Criterion::mask},
    Rule{EGL_DEPTH_SIZE, 0, Criterion::atLeast},
    Rule{EGL_LEVEL, 0, Criterion::exact},
    Rule{EGL_MATCH_NATIVE_PIXMAP, EGL_NONE, Criterion::ignored},
    Rule{EGL_MAX_SWAP_INTERVAL, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_MIN_SWAP_INTERVAL, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_NATIVE_RENDERABLE, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_NATIVE_VISUAL_TYPE, EGL_DONT_CARE, Criterion::exact},
    Rule{EGL_RENDERABLE_TYPE, EGL_OPENGL_ES_BIT, Criterion::mask},
    Rule{EGL_SAMPLE_BUFFERS, 0, Criterion::atLeast},
    Rule{EGL_SAMPLES, 0, Criterion::atLeast},
    Rule{EGL_STENCIL_SIZE, 0, Criterion::atLeast},
    Rule{EGL_SURFACE_TYPE, EGL_WINDOW_BIT, Criterion::mask},
    Rule{EGL_TRANSPARENT_TYPE, EGL_NONE, Criterion::exact},
    // Ours have no transparent pixels, so these never matter.
    Rule{EGL_TRANSPARENT_RED_VALUE, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_TRANSPARENT_GREEN_VALUE, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_TRANSPARENT_BLUE_VALUE, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_MAX_PBUFFER_WIDTH, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_MAX_PBUFFER_HEIGHT, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_MAX_PBUFFER_PIXELS, EGL_DONT_CARE, Criterion::ignored},
    Rule{EGL_NATIVE_VISUAL_ID, EGL_DONT_CARE, Criterion::ignored},
};

bool isOneOf(EGLint value, std::initializer_list<EGLint> values) {
    return std::ranges::find(values, value) != values.end();
}

bool isLegal(EGLint attribute, EGLint value) {
    if (value == EGL_DONT_CARE)
        return attribute != EGL_LEVEL && attribute != EGL_MATCH_NATIVE_PIXMAP;
    switch (attribute) {
        case EGL_BIND_TO_TEXTURE_RGB:
        case EGL_BIND_TO_TEXTURE_RGBA:
        case EGL_NATIVE_RENDERABLE:
            return isOneOf(value, {EGL_FALSE, EGL_TRUE});
        case EGL_COLOR_BUFFER_TYPE:
            return isOneOf(value, {EGL_RGB_BUFFER, EGL_LUMINANCE_BUFFER});
        case EGL_COMPOSITOR_VTM:
            return isOneOf(value,
                           {EGL_COMPOSITOR_AUTOMATIC_VTM, EGL_COMPOSITOR_CPU_VTM, EGL_COMPOSITOR_GL_VTM});
        case EGL_CONFIG_CAVEAT:
            return isOneOf(value, {EGL_NONE, EGL_SLOW_CONFIG, EGL_NON_CONFORMANT_CONFIG});
        case EGL_TRANSPARENT_TYPE:
            return isOneOf(value, {EGL_NONE, EGL_TRANSPARENT_RGB});
        case EGL_CONFIG_ID:
            return value > 0;
        case EGL_LEVEL:
        case EGL_MATCH_NATIVE_PIXMAP:
        case EGL_NATIVE_VISUAL_ID:
        case EGL_NATIVE_VISUAL_TYPE:
        case EGL_TRANSPARENT_RED_VALUE:
        case EGL_TRANSPARENT_GREEN_VALUE:
        case EGL_TRANSPARENT_BLUE_VALUE:
            return true;
        default:
            return value >= 0;
    }
}

/// What is asked for, by attribute of table 3.4.
class Request {
public:
    /// `systemHasJudged`: attributes of the system's extensions are legal then, and no config of ours has
    /// them.
    Request(const EGLint* list, bool systemHasJudged) {
        for (const Rule& rule : rules)
            values_[rule.attribute] = rule.initial;
        for (const auto& [attribute, value] : attributeList(list)) {
            const auto it = values_.find(attribute);
            const bool isKnown = it != values_.end();
            require((isKnown && isLegal(attribute, value)) || systemHasJudged, EGL_BAD_ATTRIBUTE);
            if (isKnown)
                it->second = value;
            else if (value != EGL_DONT_CARE)
                asksForMore_ = true;
        }
    }

    EGLint operator[](EGLint attribute) const { return values_.at(attribute); }

    bool matches(const Config& config) const {
        if ((*this)[EGL_CONFIG_ID] != EGL_DONT_CARE)
            return (*this)[EGL_CONFIG_ID] == config.id;
        return !asksForMore_ && std::ranges::all_of(rules, [&](const Rule& rule) {
            return matches(rule,
                           *config.attribute(rule.attribute == EGL_MATCH_NATIVE_PIXMAP ? EGL_CONFIG_ID
                                                                                       : rule.attribute));
        });
    }

private:
    bool matches(const Rule& rule, EGLint value) const {
        const EGLint wanted = (*this)[rule.attribute];
        if (wanted == EGL_DONT_CARE)
            return true;
        if (rule.attribute == EGL_NATIVE_VISUAL_TYPE && !((*this)[EGL_SURFACE_TYPE] & EGL_WINDOW_BIT))
            return true;
        switch (rule.criterion) {
            case Criterion::atLeast:
                return value >= wanted;
            case Criterion::exact:
                return value == wanted;
            case Criterion::mask:
                return (value & wanted) == wanted;
            case Criterion::ignored:
                return true;
        }
        return false;
    }

    std::map<EGLint, EGLint> values_;
    bool asksForMore_ = false;
};

/// A config as it is ordered: smaller keys come first (section 3.4.1.2, rules 1 to 9 and 11). Native visual
/// types have no order of their own. The key is made once: another thread may terminate the display
/// meanwhile.
struct Candidate {
    EGLConfig handle = nullptr;
    std::array<EGLint, 10> key{};
};

/// `value` gives the config's attributes by name.
template <class Value>
Candidate candidate(const Request& request, EGLConfig handle, Value&& value) {
    const auto asked = [&](EGLint name) { return request[name] > 0 ? value(name) : 0; };
    const EGLint caveat = value(EGL_CONFIG_CAVEAT);
    const bool isGrey = value(EGL_COLOR_BUFFER_TYPE) == EGL_LUMINANCE_BUFFER;
    const EGLint bits =
        asked(EGL_ALPHA_SIZE) + (isGrey ? asked(EGL_LUMINANCE_SIZE)
                                        : asked(EGL_RED_SIZE) + asked(EGL_GREEN_SIZE) + asked(EGL_BLUE_SIZE));
    return {
        handle,
        {caveat == EGL_NONE          ? 0
         : caveat == EGL_SLOW_CONFIG ? 1
                                     : 2,
         isGrey, -bits, value(EGL_BUFFER_SIZE), value(EGL_SAMPLE_BUFFERS), value(EGL_SAMPLES),
         value(EGL_DEPTH_SIZE), value(EGL_STENCIL_SIZE), value(EGL_ALPHA_MASK_SIZE), value(EGL_CONFIG_ID)}};
}

/// Without the attribute that the system does not know.
std::vector<EGLint> systemsList(const EGLint* list) {
    std::vector<EGLint> systems;
    for (const auto& [attribute, value] : attributeList(list))
        if (attribute != EGL_COMPOSITOR_VTM)
            systems.insert(systems.end(), {attribute, value});
    systems.push_back(EGL_NONE);
    return systems;
}

/// The system's choice, in its order. Throws what it says against the list.
std::vector<EGLConfig> systemChoice(const Display& display, const EGLint* given) {
    EGLint count = 0;
    if (!display.systemRuns)
        return {};
    const std::vector<EGLint> ours = systemsList(given);
    const EGLint* const list = ours.data();
    requireSystem(systemEgl()->ChooseConfig(display.handle, list, nullptr, 0, &count));
    std::vector<EGLConfig> chosen(std::size_t(std::max(count, 0)));
    if (count > 0)
        requireSystem(systemEgl()->ChooseConfig(display.handle, list, chosen.data(), count, &count));
    chosen.resize(std::size_t(count));
    return chosen;
}

/// Those that show pixmaps like this one.
std::vector<EGLConfig> pixmapConfigs(const Display& display, EGLint pixmap) {
    const EGLint list[] = {EGL_MATCH_NATIVE_PIXMAP, pixmap, EGL_SURFACE_TYPE, EGL_PIXMAP_BIT,
                           EGL_RENDERABLE_TYPE,     0,      EGL_NONE};
    return systemChoice(display, list);
}

std::vector<Candidate> ourChoice(Display& display, const Request& request) {
    const EGLint pixmap = request[EGL_MATCH_NATIVE_PIXMAP];
    const bool byPixmap = pixmap != EGL_NONE && request[EGL_CONFIG_ID] == EGL_DONT_CARE;
    const std::vector<EGLConfig> fitting =
        byPixmap ? pixmapConfigs(display, pixmap) : std::vector<EGLConfig>();
    const std::lock_guard lock(display.initializing);
    std::vector<Candidate> chosen;
    for (const auto& config : display.configs)
        if (request.matches(*config) && (!byPixmap || std::ranges::count(fitting, config->pixmap) > 0))
            chosen.push_back(candidate(request, config->handle,
                                       [&](EGLint name) { return config->attribute(name).value_or(0); }));
    std::ranges::sort(chosen, {}, &Candidate::key);
    return chosen;
}

/// In the system's order.
std::vector<Candidate> candidates(const Display& display, const Request& request,
                                  const std::vector<EGLConfig>& systems) {
    std::vector<Candidate> made;
    for (const EGLConfig config : systems)
        made.push_back(candidate(request, config,
                                 [&](EGLint name) { return systemConfigAttribute(display, config, name); }));
    return made;
}

/// Programs that ask for OpenGL or OpenGL ES alone get what they get without us, though both draw with
/// configs of ours.
bool isForOpenGl(const Request& request) {
    const EGLint apis = request[EGL_RENDERABLE_TYPE];
    return request[EGL_CONFIG_ID] == EGL_DONT_CARE && apis > 0 && !(apis & EGL_OPENVG_BIT);
}

std::vector<EGLConfig> choice(Display& display, const EGLint* list) {
    std::vector<EGLConfig> systems = systemChoice(display, list);
    const Request request(list, display.systemRuns);
    if (request[EGL_CONFIG_ID] == EGL_DONT_CARE && request[EGL_RENDERABLE_TYPE] != EGL_DONT_CARE &&
        (request[EGL_RENDERABLE_TYPE] & EGL_OPENVG_BIT))
        systems.clear();
    const std::vector<Candidate> ours =
        isForOpenGl(request) ? std::vector<Candidate>() : ourChoice(display, request);
    std::vector<Candidate> all;
    std::ranges::merge(candidates(display, request, systems), ours, std::back_inserter(all), {},
                       &Candidate::key, &Candidate::key);
    std::vector<EGLConfig> handles;
    std::ranges::transform(all, std::back_inserter(handles), &Candidate::handle);
    return handles;
}

}  // namespace

}  // namespace vtm::egl

using namespace vtm::egl;

EGLBoolean EGLAPIENTRY eglChooseConfig(EGLDisplay dpy, const EGLint* list, EGLConfig* configs, EGLint size,
                                       EGLint* count) {
    if (!findDisplay(dpy))
        return forward(&System::ChooseConfig, EGLBoolean(EGL_FALSE), EGL_BAD_DISPLAY, dpy, list, configs,
                       size, count);
    return call(EGLBoolean(EGL_FALSE), [&] {
        Display& display = initializedDisplay(dpy);
        require(count != nullptr && (!configs || size >= 0), EGL_BAD_PARAMETER);
        const std::vector<EGLConfig> all = choice(display, list);
        const EGLint total = EGLint(all.size());
        *count = configs ? std::min(size, total) : total;
        if (configs)
            std::copy_n(all.begin(), *count, configs);
        return EGLBoolean(EGL_TRUE);
    });
}
