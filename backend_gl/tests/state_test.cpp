// The state contract: whatever GL's state is, the picture is right and the state is the same afterwards.
#include <bit>
#include <map>
#include <string>

#include <vtm/gl/sampled_texture.hpp>
#include "asset/testing.hpp"
#include "backend_gl/tests/gl_fixture.hpp"
#include "raster/testing_views.hpp"

namespace vtm::gl {
namespace {

using asset::Asset;
using namespace asset::test;

using Values = std::vector<GLint>;
using Snapshot = std::map<std::string, Values>;

struct Named {
    const char* text;
    GLenum name;
    std::size_t count;
};
#define STATE(name, count) \
    Named { #name, name, count }
/// GL ES 3.0's context state (specification, tables 6.4 to 6.36) but for hints, limits and what is indexed.
const Named states[] = {STATE(GL_CURRENT_PROGRAM, 1),
                        STATE(GL_VERTEX_ARRAY_BINDING, 1),
                        STATE(GL_ARRAY_BUFFER_BINDING, 1),
                        STATE(GL_COPY_READ_BUFFER_BINDING, 1),
                        STATE(GL_COPY_WRITE_BUFFER_BINDING, 1),
                        STATE(GL_PIXEL_PACK_BUFFER_BINDING, 1),
                        STATE(GL_PIXEL_UNPACK_BUFFER_BINDING, 1),
                        STATE(GL_UNIFORM_BUFFER_BINDING, 1),
                        STATE(GL_TRANSFORM_FEEDBACK_BINDING, 1),
                        STATE(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 1),
                        STATE(GL_TRANSFORM_FEEDBACK_ACTIVE, 1),
                        STATE(GL_TRANSFORM_FEEDBACK_PAUSED, 1),
                        STATE(GL_DRAW_FRAMEBUFFER_BINDING, 1),
                        STATE(GL_READ_FRAMEBUFFER_BINDING, 1),
                        STATE(GL_RENDERBUFFER_BINDING, 1),
                        STATE(GL_ACTIVE_TEXTURE, 1),
                        STATE(GL_VIEWPORT, 4),
                        STATE(GL_SCISSOR_BOX, 4),
                        STATE(GL_BLEND_SRC_RGB, 1),
                        STATE(GL_BLEND_DST_RGB, 1),
                        STATE(GL_BLEND_SRC_ALPHA, 1),
                        STATE(GL_BLEND_DST_ALPHA, 1),
                        STATE(GL_BLEND_EQUATION_RGB, 1),
                        STATE(GL_BLEND_EQUATION_ALPHA, 1),
                        STATE(GL_BLEND_COLOR, 4),
                        STATE(GL_COLOR_WRITEMASK, 4),
                        STATE(GL_COLOR_CLEAR_VALUE, 4),
                        STATE(GL_DEPTH_CLEAR_VALUE, 1),
                        STATE(GL_STENCIL_CLEAR_VALUE, 1),
                        STATE(GL_DEPTH_FUNC, 1),
                        STATE(GL_DEPTH_WRITEMASK, 1),
                        STATE(GL_DEPTH_RANGE, 2),
                        STATE(GL_STENCIL_FUNC, 1),
                        STATE(GL_STENCIL_REF, 1),
                        STATE(GL_STENCIL_VALUE_MASK, 1),
                        STATE(GL_STENCIL_WRITEMASK, 1),
                        STATE(GL_STENCIL_BACK_FUNC, 1),
                        STATE(GL_STENCIL_BACK_WRITEMASK, 1),
                        STATE(GL_STENCIL_FAIL, 1),
                        STATE(GL_STENCIL_PASS_DEPTH_FAIL, 1),
                        STATE(GL_STENCIL_PASS_DEPTH_PASS, 1),
                        STATE(GL_CULL_FACE_MODE, 1),
                        STATE(GL_FRONT_FACE, 1),
                        STATE(GL_LINE_WIDTH, 1),
                        STATE(GL_POLYGON_OFFSET_FACTOR, 1),
                        STATE(GL_POLYGON_OFFSET_UNITS, 1),
                        STATE(GL_SAMPLE_COVERAGE_VALUE, 1),
                        STATE(GL_SAMPLE_COVERAGE_INVERT, 1),
                        STATE(GL_PACK_ALIGNMENT, 1),
                        STATE(GL_PACK_ROW_LENGTH, 1),
                        STATE(GL_PACK_SKIP_ROWS, 1),
                        STATE(GL_PACK_SKIP_PIXELS, 1),
                        STATE(GL_UNPACK_ALIGNMENT, 1),
                        STATE(GL_UNPACK_ROW_LENGTH, 1),
                        STATE(GL_UNPACK_IMAGE_HEIGHT, 1),
                        STATE(GL_UNPACK_SKIP_IMAGES, 1),
                        STATE(GL_UNPACK_SKIP_ROWS, 1),
                        STATE(GL_UNPACK_SKIP_PIXELS, 1),
                        STATE(GL_DRAW_BUFFER0, 1),
                        STATE(GL_DRAW_BUFFER1, 1),
                        STATE(GL_READ_BUFFER, 1)};
const Named capabilities[] = {STATE(GL_BLEND, 1),
                              STATE(GL_CULL_FACE, 1),
                              STATE(GL_DEPTH_TEST, 1),
                              STATE(GL_DITHER, 1),
                              STATE(GL_POLYGON_OFFSET_FILL, 1),
                              STATE(GL_PRIMITIVE_RESTART_FIXED_INDEX, 1),
                              STATE(GL_RASTERIZER_DISCARD, 1),
                              STATE(GL_SAMPLE_ALPHA_TO_COVERAGE, 1),
                              STATE(GL_SAMPLE_COVERAGE, 1),
                              STATE(GL_SCISSOR_TEST, 1),
                              STATE(GL_STENCIL_TEST, 1)};
#undef STATE

/// Every value of the context's state that a program can ask for, by name.
Snapshot snapshot() {
    Snapshot result;
    for (const Named& state : states) {
        Values values(state.count);
        glGetIntegerv(state.name, values.data());
        result[state.text] = values;
    }
    for (const Named& capability : capabilities)
        result[capability.text] = {glIsEnabled(capability.name)};
    const int active = limit(GL_ACTIVE_TEXTURE), units = limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    for (int unit = 0; unit < units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + GLenum(unit));
        result["unit " + std::to_string(unit)] = {
            limit(GL_TEXTURE_BINDING_2D), limit(GL_TEXTURE_BINDING_3D), limit(GL_TEXTURE_BINDING_CUBE_MAP),
            limit(GL_TEXTURE_BINDING_2D_ARRAY), limit(GL_SAMPLER_BINDING)};
    }
    glActiveTexture(GLenum(active));
    for (GLuint i = 0; i < GLuint(limit(GL_MAX_VERTEX_ATTRIBS)); ++i) {
        Values values(6);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &values[0]);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_SIZE, &values[1]);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_TYPE, &values[2]);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_STRIDE, &values[3]);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_DIVISOR, &values[4]);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &values[5]);
        result["attribute " + std::to_string(i)] = values;
    }
    checkErrors("snapshot");
    return result;
}

/// What a user's program may leave behind, as hostile to drawing as can be: made with the user's objects, put
/// back to GL's defaults at the end.
class Scrambled {
public:
    explicit Scrambled(bool feedback) : feedback_(feedback) {
        glGenBuffers(4, buffers_);
        glGenTextures(8, textures_);
        glGenSamplers(1, &sampler_);
        glGenVertexArrays(1, &vertexArray_);
        glBindVertexArray(vertexArray_);
        glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
        glBufferData(GL_ARRAY_BUFFER, 64, nullptr, GL_STATIC_DRAW);
        for (GLuint i = 0; i < 4; ++i) {
            glEnableVertexAttribArray(i);
            glVertexAttribPointer(i, 2, GL_SHORT, GL_TRUE, 12, nullptr);
            glVertexAttribDivisor(i, 3);
        }
        glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_[1]);
        glBufferData(GL_PIXEL_PACK_BUFFER, 16, nullptr, GL_STATIC_READ);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers_[2]);
        glBufferData(GL_PIXEL_UNPACK_BUFFER, 16, nullptr, GL_STATIC_DRAW);
        // Samplers make integer textures incomplete.
        glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glSamplerParameteri(sampler_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        for (GLuint i = 0; i < 8; ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, textures_[i]);
            glBindSampler(i, sampler_);
        }
        glActiveTexture(GL_TEXTURE3);
        glViewport(3, 1, 7, 2);
        glScissor(1, 2, 3, 4);
        glBlendFuncSeparate(GL_ZERO, GL_DST_COLOR, GL_CONSTANT_ALPHA, GL_ONE);
        glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
        glBlendColor(0, 1, 0, 1);
        glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
        glClearColor(0, 0, 1, 1);
        glDepthFunc(GL_NEVER);
        glDepthMask(GL_FALSE);
        glStencilFunc(GL_NEVER, 3, 7);
        glStencilMask(5);
        glCullFace(GL_FRONT_AND_BACK);
        glFrontFace(GL_CW);
        glPolygonOffset(2, 3);
        glSampleCoverage(0, GL_FALSE);
        for (const GLenum name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
            glPixelStorei(name, 8);
        for (const GLenum name :
             {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_UNPACK_ROW_LENGTH,
              GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
            glPixelStorei(name, 13);
        for (const Named& capability : capabilities)
            glEnable(capability.name);
        glUseProgram(program_.get());
        if (feedback_) {
            glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffers_[3]);
            glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, 4096, nullptr, GL_STATIC_READ);
            glBeginTransformFeedback(GL_LINES);
        }
        checkErrors("scrambling");
    }
    ~Scrambled() {
        if (feedback_)
            glEndTransformFeedback();
        glUseProgram(0);
        glDeleteBuffers(4, buffers_);
        glDeleteTextures(8, textures_);
        glDeleteSamplers(1, &sampler_);
        glDeleteVertexArrays(1, &vertexArray_);
        glBlendFunc(GL_ONE, GL_ZERO);
        glBlendEquation(GL_FUNC_ADD);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        for (const GLenum name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
            glPixelStorei(name, 4);
        for (const GLenum name :
             {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_UNPACK_ROW_LENGTH,
              GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
            glPixelStorei(name, 0);
        for (const Named& capability : capabilities)
            glDisable(capability.name);
        checkErrors("putting back");
    }

private:
    bool feedback_;
    ProgramHandle program_ = capturing();
    GLuint buffers_[4] = {}, textures_[8] = {}, sampler_ = 0, vertexArray_ = 0;

    /// A program whose vertices can be captured.
    static ProgramHandle capturing();
};

ProgramHandle Scrambled::capturing() {
    ProgramHandle program(glCreateProgram());
    for (const auto& [stage, text] :
         {std::pair{GL_VERTEX_SHADER, "#version 300 es\nvoid main() { gl_Position = vec4(0.0); }"},
          {GL_FRAGMENT_SHADER,
           "#version 300 es\nprecision highp float;\nout vec4 c;\nvoid main() { c = vec4(1.0); }"}}) {
        const ShaderHandle shader(glCreateShader(GLenum(stage)));
        glShaderSource(shader.get(), 1, &text, nullptr);
        glCompileShader(shader.get());
        glAttachShader(program.get(), shader.get());
    }
    const char* captured = "gl_Position";
    glTransformFeedbackVaryings(program.get(), 1, &captured, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program.get());
    return program;
}

void expectEqual(const Snapshot& before, const Snapshot& after) {
    for (const auto& [name, values] : before)
        EXPECT_EQ(values, after.at(name)) << name;
}

constexpr int side = 40;

class State : public Gl {};

/// Every public call among scrambled state, against the same one among GL's defaults.
TEST_F(State, AnyStateIsRightAndIsLeftAsItWas) {
    for (const bool feedback : {false, true})
        for (const Asset& asset : {everyPaint(), layers()}) {
            SCOPED_TRACE(feedback);
            const asset::View view = turnedView(side, side, {32, 32}, 0.6, 0.3);
            const UserFramebuffer expected(GL_RGBA8, side, side);
            Renderer calm;
            const Texture known = calm.upload(asset);
            calm.draw(known, view, Output{});
            const image::Raster picture = calm.render(known, view);
            const image::Bitmap bitmap = calm.renderBitmap(known, view);
            const std::vector<std::uint8_t> bytes = expected.bytes();

            const UserFramebuffer read(GL_RGBA8, 2, 2), target(GL_RGBA8, side, side);
            glBindFramebuffer(GL_READ_FRAMEBUFFER, read.framebuffer.get());
            image::Raster got;
            image::Bitmap gotBitmap;
            {
                const Scrambled scrambled(feedback);
                const Snapshot before = snapshot();
                {
                    Renderer mine;
                    expectEqual(before, snapshot());
                    const Texture texture = mine.upload(asset);
                    expectEqual(before, snapshot());
                    mine.draw(texture, view, Output{});
                    expectEqual(before, snapshot());
                    got = mine.render(texture, view);
                    expectEqual(before, snapshot());
                    gotBitmap = mine.renderBitmap(texture, view);
                    expectEqual(before, snapshot());
                    mine.draw(texture, view);
                }
                expectEqual(before, snapshot());
            }
            EXPECT_EQ(got.rgba, picture.rgba);
            EXPECT_EQ(gotBitmap.rgba, bitmap.rgba);
            EXPECT_EQ(target.bytes(), bytes);
        }
}

TEST_F(State, ErrorsLeaveTheStateToo) {
    const Texture texture = renderer->upload(disc());
    const UserFramebuffer integers(GL_RGBA8UI, 4, 4);
    const Scrambled scrambled(false);
    const Snapshot before = snapshot();
    EXPECT_THROW(renderer->draw(texture, {4, 4, {}}, Output{}), GlError);
    expectEqual(before, snapshot());
    Asset broken = emptyAsset();
    broken.materials = {{"wrong", "vec4 wrong(vec2 p) { return nothing; }"}};
    broken.data = {};
    const std::uint32_t fill = addMaterial(broken.data, {});
    broken.data.push_back(std::bit_cast<asset::Texel>(asset::Instruction{asset::Op::Material, {}, 1, fill}));
    broken.paints.push_back({std::uint32_t(broken.data.size() - 1), 1, 0, asset::programTag});
    EXPECT_THROW(renderer->upload(broken), GlError);
    expectEqual(before, snapshot());
}

/// Whoever makes their prefilters.
TEST_F(State, UpdatesOfTexturesLeaveTheStateToo) {
    for (const bool feedback : {false, true})
        for (const Pixels pixels : {Pixels::Shaders, Pixels::Scanned}) {
            SampledTexture texture(placedMaps());
            const Scrambled scrambled(feedback);
            const Snapshot before = snapshot();
            texture.update(placedMaps(), true, pixels);
            expectEqual(before, snapshot());
        }
}

TEST_F(State, WithoutRestoringPicturesAreRightAnyway) {
    RendererOptions options;
    options.restoreState = false;
    Renderer careless(options);
    const asset::View view = turnedView(side, side, {32, 32}, 0.6, 0.3);
    const image::Raster expected = renderer->render(renderer->upload(layers()), view);
    image::Raster got;
    {
        const Scrambled scrambled(false);
        const Texture texture = careless.upload(layers());
        careless.render(texture, view);
        got = careless.render(texture, view);
    }
    EXPECT_EQ(got.rgba, expected.rgba);
}

TEST_F(State, PendingErrorsAreNotOurs) {
    const Texture texture = renderer->upload(disc());
    glEnable(0x1234);
    EXPECT_NO_THROW(renderer->render(texture, {4, 4, {}}));
}

}  // namespace
}  // namespace vtm::gl
