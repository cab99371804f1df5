/// \file
/// The files of web/page, which the build embeds: the template, and what stands in it, with SHA-256 in
/// hexadecimal.
#pragma once

#include <string_view>

namespace vtm::web::text {

extern const std::string_view html, style, script;
extern const std::string_view styleSha256, scriptSha256;

}  // namespace vtm::web::text
