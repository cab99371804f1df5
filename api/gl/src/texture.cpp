#include <vtm/gl/renderer.hpp>
#include <vtm/vtm.hpp>

namespace vtm {

gl::Texture Picture::texture() const { return gl::Texture(asset()); }

}  // namespace vtm
