/// \file
/// Which characters are emoji without being asked for. Source: UTS 51, Emoji_Presentation of Unicode 15.0.
#pragma once

namespace vtm::text {

bool isEmojiByDefault(char32_t character);

}  // namespace vtm::text
