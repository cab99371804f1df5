#include "conformance/vgscript/src/names.hpp"

#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <VG/openvg.h>
#include <VG/vgext.h>
#include <VG/vgu.h>

namespace vtm::vgscript {

namespace {

template <class R>
Value valueOf(R result) {
    if constexpr (std::is_pointer_v<R>)
        return {Value::Kind::Text, 0, result ? reinterpret_cast<const char*>(result) : ""};
    else
        return {Value::Kind::Number, double(result), {}};
}

template <class R, class... Parameters>
Function bind(R (*function)(Parameters...)) {
    return {sizeof...(Parameters), [function](Frame& frame, [[maybe_unused]] std::span<const Word> words) {
                return [&]<std::size_t... i>(std::index_sequence<i...>)->Value {
                    // Braces: words are looked at in their order.
                    const std::tuple<Parameters...> arguments{frame.argument<Parameters>(words[i])...};
                    if constexpr (std::is_void_v<R>) {
                        std::apply(function, arguments);
                        return {};
                    } else {
                        return valueOf(std::apply(function, arguments));
                    }
                }
                (std::index_sequence_for<Parameters...>());
            }};
}

}  // namespace

std::optional<double> constantOf(std::string_view name) {
    static const std::map<std::string_view, double> constants{
#define VTM_CONSTANT(name) {#name, double(name)},
#include "vg_constants.inc"
        VTM_CONSTANT(VG_PATH_FORMAT_STANDARD) VTM_CONSTANT(VG_INVALID_HANDLE)
#undef VTM_CONSTANT
    };
    const auto found = constants.find(name);
    return found == constants.end() ? std::nullopt : std::optional(found->second);
}

const Function* functionOf(std::string_view name) {
    static const std::map<std::string_view, Function> functions{
#define VTM_FUNCTION(name) {#name, bind(&name)},
#include "vg_functions.inc"
#undef VTM_FUNCTION
    };
    const auto found = functions.find(name);
    return found == functions.end() ? nullptr : &found->second;
}

}  // namespace vtm::vgscript
