// Software drivers are told by their name, as far as it tells.

#include <gtest/gtest.h>

#include "gles_context/renderer_name.hpp"

namespace vtm::gles_context {
namespace {

TEST(RendererName, TellsSoftwareDrivers) {
    for (const char* name :
         {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "zink (llvmpipe)", "Apple Software Renderer",
          "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)"})
        EXPECT_EQ(isSoftwareName(name), true) << name;
    for (const char* name : {"NVIDIA H100", "AMD Radeon RX 6600", "Mesa Intel(R) UHD 620", "Mali-G78",
                             "ANGLE (Apple, Apple M1, OpenGL 4.1)"})
        EXPECT_EQ(isSoftwareName(name), false) << name;
    for (const char* name : {"", "WebKit WebGL", "Generic Renderer"})
        EXPECT_EQ(isSoftwareName(name), std::nullopt) << name;
}

}  // namespace
}  // namespace vtm::gles_context
