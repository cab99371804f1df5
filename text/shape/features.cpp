#include "text/features.hpp"

#include <hb-ot.h>

#include <algorithm>

namespace vtm::text {

bool hasFeature(const Font& font, Tag feature) {
    hb_face_t* const face = hb_font_get_face(font.harfbuzz());
    unsigned count = hb_ot_layout_table_get_feature_tags(face, HB_OT_TAG_GSUB, 0, nullptr, nullptr);
    std::vector<hb_tag_t> tags(count);
    hb_ot_layout_table_get_feature_tags(face, HB_OT_TAG_GSUB, 0, &count, tags.data());
    return std::find(tags.begin(), tags.end(), feature) != tags.end();
}

}  // namespace vtm::text
