#include "text/color/free_type_face.hpp"

namespace vtm::text {

std::shared_ptr<FreeTypeFace> FreeTypeFace::of(hb_face_t* face) {
    std::shared_ptr<FreeTypeFace> made(new FreeTypeFace);
    made->bytes_.reset(hb_face_reference_blob(face));
    unsigned size = 0;
    const auto* bytes = reinterpret_cast<const FT_Byte*>(hb_blob_get_data(made->bytes_.get(), &size));
    if (FT_Init_FreeType(&made->library_) != 0 ||
        FT_New_Memory_Face(made->library_, bytes, FT_Long(size), FT_Long(hb_face_get_index(face)),
                           &made->face_) != 0)
        return nullptr;
    FT_Set_Pixel_Sizes(made->face_, 0, hb_face_get_upem(face));
    return made;
}

FreeTypeFace::~FreeTypeFace() {
    if (face_)
        FT_Done_Face(face_);
    if (library_)
        FT_Done_FreeType(library_);
}

}  // namespace vtm::text
