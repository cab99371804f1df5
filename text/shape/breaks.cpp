#include "text/breaks.hpp"

#include <linebreak.h>

#include <mutex>

namespace vtm::text {

std::vector<bool> lineBreaks(const std::u32string& text, const std::string& language) {
    static std::once_flag once;
    std::call_once(once, init_linebreak);
    std::vector<char> breaks(text.size());
    set_linebreaks_utf32(reinterpret_cast<const utf32_t*>(text.data()), text.size(), language.c_str(),
                         breaks.data());
    std::vector<bool> allowed;
    for (const char kind : breaks)
        allowed.push_back(kind == LINEBREAK_MUSTBREAK || kind == LINEBREAK_ALLOWBREAK);
    return allowed;
}

}  // namespace vtm::text
