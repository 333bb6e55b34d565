// OpenGL 3.3 core by OSMesa (llvmpipe), drawing into a framebuffer object. One draw call per
// batch; all vertices of a page in one buffer.

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <GL/glext.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/base/check.h"
#include "render/canvas/canvas.h"

/// Read by the leak checker of BUILD=asan: OSMesa 22.3 leaks 160 bytes with each context.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }

namespace seam {
namespace {

const char* const kVertexShader = R"(#version 330 core
#extension GL_ARB_separate_shader_objects : require
out gl_PerVertex { vec4 gl_Position; float gl_PointSize; };
layout(location = 0) in vec2 position;
layout(location = 1) in vec4 shape;
layout(location = 2) in vec4 colour;
uniform vec2 page;
out vec4 fragment_shape;
out vec4 fragment_colour;
void main() {
  gl_Position = vec4(position / page * 2.0 - 1.0, 0.0, 1.0);
  gl_PointSize = 2.0 * shape.y + 1.0;
  fragment_shape = shape;
  fragment_colour = colour;
})";

// shape = across, half, along, period; see Vertex.
const char* const kShapeShader = R"(#version 330 core
in vec4 fragment_shape;
in vec4 fragment_colour;
out vec4 result;
void main() {
  float cover = clamp(fragment_shape.y + 0.5 - abs(fragment_shape.x), 0.0, 1.0);
  cover = min(cover, 2.0 * fragment_shape.y);
  result = vec4(fragment_colour.rgb, fragment_colour.a * cover);
})";

const char* const kDashedShader = R"(#version 330 core
in vec4 fragment_shape;
in vec4 fragment_colour;
out vec4 result;
void main() {
  float cover = clamp(fragment_shape.y + 0.5 - abs(fragment_shape.x), 0.0, 1.0);
  cover = min(cover, 2.0 * fragment_shape.y);
  float period = abs(fragment_shape.w);
  if (period > 0.0) {
    float on = period * (fragment_shape.w > 0.0 ? 0.6 : 0.3);
    float middle = abs(fract(fragment_shape.z / period) * period - 0.5 * period);
    cover *= clamp(0.5 * on + 0.5 - middle, 0.0, 1.0);
  }
  result = vec4(fragment_colour.rgb, fragment_colour.a * cover);
})";

const char* const kDiscShader = R"(#version 330 core
in vec4 fragment_shape;
in vec4 fragment_colour;
out vec4 result;
void main() {
  float cover = clamp(fragment_shape.y + 0.5 - length(fragment_shape.xz), 0.0, 1.0);
  result = vec4(fragment_colour.rgb, fragment_colour.a * cover);
})";

// The page's y equals the window's, because the page is drawn upside down.
const char* const kDotShader = R"(#version 330 core
in vec4 fragment_shape;
in vec4 fragment_colour;
out vec4 result;
void main() {
  float cover = clamp(fragment_shape.y + 0.5 - distance(gl_FragCoord.xy, fragment_shape.xz),
                      0.0, 1.0);
  result = vec4(fragment_colour.rgb, fragment_colour.a * cover);
})";

const char* const kPlainShader = R"(#version 330 core
in vec4 fragment_colour;
out vec4 result;
void main() {
  result = fragment_colour;
})";

const char* const kTextShader = R"(#version 330 core
in vec4 fragment_shape;
in vec4 fragment_colour;
uniform sampler2D atlas;
out vec4 result;
void main() {
  float cover = texelFetch(atlas, ivec2(fragment_shape.xy), 0).r;
  result = vec4(fragment_colour.rgb, fragment_colour.a * cover);
})";

/// Makes a separate shader stage, so that all fragment shaders share one compiled vertex shader.
GLuint Stage(GLenum kind, const char* source) {
  const GLuint program = glCreateShaderProgramv(kind, 1, &source);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  SEAM_ASSERT(good == GL_TRUE);
  return program;
}

/// Creates a context, after setting Mesa's environment variables.
OSMesaContext CreateContext() {
  setenv("LP_NUM_THREADS", "0", 1);                // frames are the unit of parallel work
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);  // leaves no files in the home folder
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0,
                            0};
  return OSMesaCreateContextAttribs(attributes, nullptr);
}

std::size_t Index(BatchKind kind) { return static_cast<std::size_t>(kind); }

class OsmesaCanvas : public Canvas {
 public:
  explicit OsmesaCanvas(const Font& font) : context_(CreateContext()) {
    if (context_ == nullptr) throw OperatorError("OSMesa gives no OpenGL 3.3 context");
    MakeCurrent();
    vertex_stage_ = Stage(GL_VERTEX_SHADER, kVertexShader);
    AddPipeline(BatchKind::kPlain, kPlainShader);
    AddPipeline(BatchKind::kShape, kShapeShader);
    AddPipeline(BatchKind::kDashed, kDashedShader);
    AddPipeline(BatchKind::kDisc, kDiscShader);
    AddPipeline(BatchKind::kDot, kDotShader);
    AddPipeline(BatchKind::kText, kTextShader);
    glGenVertexArrays(1, &vertex_array_);
    glBindVertexArray(vertex_array_);
    glGenBuffers(2, buffers_);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
    Attribute(0, 2, GL_FLOAT, offsetof(Vertex, x));
    Attribute(1, 4, GL_FLOAT, offsetof(Vertex, across));
    Attribute(2, 4, GL_UNSIGNED_BYTE, offsetof(Vertex, colour));
    UploadAtlas(font);
    glGenFramebuffers(1, &framebuffer_);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_DITHER);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  ~OsmesaCanvas() override { OSMesaDestroyContext(context_); }
  OsmesaCanvas(const OsmesaCanvas&) = delete;
  OsmesaCanvas& operator=(const OsmesaCanvas&) = delete;

  void Draw(const DrawList& list, Colour background, Image* image) override {
    DrawOver(
        list, [&](const Rect& rect) { FillTexture(rect, background); }, image);
  }

  void Draw(const DrawList& list, const Image& background, Image* image) override {
    SEAM_ASSERT(background.width_px == list.width_px() && background.height_px == list.height_px());
    DrawOver(
        list, [&](const Rect& rect) { CopyToTexture(rect, background); }, image);
  }

 private:
  /// `fill`: puts the background into a rectangle of whole pixels.
  template <class Fill>
  void DrawOver(const DrawList& list, const Fill& fill, Image* image) {
    MakeCurrent();
    Resize(list.width_px(), list.height_px());
    const std::vector<Batch> batches = list.Batches();
    const std::size_t under = FillUnder(batches, fill);
    Upload(list);
    for (std::size_t i = under; i < batches.size(); ++i) {
      const Batch& batch = batches[i];
      glScissor(static_cast<int>(batch.clip.x), static_cast<int>(batch.clip.y),
                static_cast<int>(batch.clip.width), static_cast<int>(batch.clip.height));
      if (batch.kind == BatchKind::kClear) {
        Clear(batch.clear);
        continue;
      }
      glBindProgramPipeline(pipelines_[Index(batch.kind)]);
      // The text's indices follow the shapes'.
      const std::size_t skip = batch.kind == BatchKind::kText ? list.indices().size() : 0;
      const std::size_t offset = (skip + batch.first_index) * sizeof(std::uint32_t);
      const GLenum what = batch.kind == BatchKind::kDot ? GL_POINTS : GL_TRIANGLES;
      glDrawElements(what, static_cast<GLsizei>(batch.indices), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(offset));
    }
    ReadBack(image);
    SEAM_ASSERT(glGetError() == GL_NO_ERROR);
  }

  void MakeCurrent() {
    // The context requires a buffer of its own, although nothing is drawn there.
    if (OSMesaGetCurrentContext() == context_) return;
    const bool good = OSMesaMakeCurrent(context_, own_buffer_, GL_UNSIGNED_BYTE, 4, 4) == GL_TRUE;
    SEAM_ASSERT(good);
  }

  /// Writes the background and the leading opaque rectangles directly to memory, in a quarter of
  /// the time that llvmpipe takes to draw them. Returns the number of rectangles.
  template <class Fill>
  std::size_t FillUnder(const std::vector<Batch>& batches, const Fill& fill) {
    std::size_t count = 0;
    Rect hole;  // the largest: the background is not filled there
    for (; count < batches.size() && batches[count].kind == BatchKind::kClear; ++count) {
      const Rect& rect = batches[count].clip;
      if (rect.width * rect.height > hole.width * hole.height) hole = rect;
    }
    const auto width = static_cast<float>(width_), height = static_cast<float>(height_);
    fill({0, 0, width, hole.y});
    fill({0, hole.y, hole.x, hole.height});
    fill({hole.right(), hole.y, width - hole.right(), hole.height});
    fill({0, hole.bottom(), width, height - hole.bottom()});
    for (std::size_t i = 0; i < count; ++i) FillTexture(batches[i].clip, batches[i].clear);
    return count;
  }

  void FillTexture(const Rect& rect, Colour colour) {
    if (rect.width <= 0 || rect.height <= 0) return;
    const std::uint8_t rgba[4] = {colour.r, colour.g, colour.b, 255};
    glClearTexSubImage(picture_, 0, static_cast<int>(rect.x), static_cast<int>(rect.y), 0,
                       static_cast<int>(rect.width), static_cast<int>(rect.height), 1, GL_RGBA,
                       GL_UNSIGNED_BYTE, rgba);
  }

  void CopyToTexture(const Rect& rect, const Image& from) {
    if (rect.width <= 0 || rect.height <= 0) return;
    const auto x = static_cast<int>(rect.x), y = static_cast<int>(rect.y);
    glBindTexture(GL_TEXTURE_2D, picture_);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, from.width_px);
    glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, static_cast<int>(rect.width),
                    static_cast<int>(rect.height), GL_RGBA, GL_UNSIGNED_BYTE, from.At(x, y));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glBindTexture(GL_TEXTURE_2D, texture_);
  }

  static void Clear(Colour colour) {
    glClearColor(static_cast<float>(colour.r) / 255, static_cast<float>(colour.g) / 255,
                 static_cast<float>(colour.b) / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  void AddPipeline(BatchKind kind, const char* fragment_source) {
    GLuint& pipeline = pipelines_[Index(kind)];
    glGenProgramPipelines(1, &pipeline);
    glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, vertex_stage_);
    glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT,
                       Stage(GL_FRAGMENT_SHADER, fragment_source));
  }

  static void Attribute(GLuint location, GLint count, GLenum type, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, count, type, type == GL_UNSIGNED_BYTE, sizeof(Vertex),
                          reinterpret_cast<const void*>(offset));
  }

  void Upload(const DrawList& list) {
    const std::size_t index_bytes = list.indices().size() * sizeof(std::uint32_t);
    const std::size_t text_bytes = list.text_indices().size() * sizeof(std::uint32_t);
    Reserve(0, list.vertices().size() * sizeof(Vertex));
    Reserve(1, index_bytes + text_bytes);
    const auto put = [](GLenum target, std::size_t at, const void* data, std::size_t bytes) {
      if (bytes == 0) return;
      glBufferSubData(target, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), data);
    };
    put(GL_ARRAY_BUFFER, 0, list.vertices().data(), list.vertices().size() * sizeof(Vertex));
    put(GL_ELEMENT_ARRAY_BUFFER, 0, list.indices().data(), index_bytes);
    put(GL_ELEMENT_ARRAY_BUFFER, index_bytes, list.text_indices().data(), text_bytes);
  }

  // Buffers only grow: a new one each page would be megabytes from the kernel each page.
  void Reserve(int buffer, std::size_t bytes) {
    if (bytes <= buffer_bytes_[buffer]) return;
    buffer_bytes_[buffer] = 2 * bytes;
    glBufferData(buffer == 0 ? GL_ARRAY_BUFFER : GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(2 * bytes), nullptr, GL_STREAM_DRAW);
  }

  void UploadAtlas(const Font& font) {
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, font.atlas_width(), font.atlas_height(), 0, GL_RED,
                 GL_UNSIGNED_BYTE, font.atlas().data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }

  void Resize(int width, int height) {
    if (width == width_ && height == height_) return;
    SEAM_ASSERT(width > 0 && height > 0);
    width_ = width;
    height_ = height;
    glDeleteTextures(1, &picture_);
    glGenTextures(1, &picture_);
    glBindTexture(GL_TEXTURE_2D, picture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_, 0);
    SEAM_ASSERT(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
    glViewport(0, 0, width, height);
    glProgramUniform2f(vertex_stage_, glGetUniformLocation(vertex_stage_, "page"),
                       static_cast<float>(width), static_cast<float>(height));
  }

  // The page is drawn upside down for OpenGL, so its rows come out from the top.
  void ReadBack(Image* image) {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    image->width_px = width_;
    image->height_px = height_;
    image->rgba.resize(4 * pixels);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image->rgba.data());
  }

  OSMesaContext context_;
  std::uint8_t own_buffer_[4 * 4 * 4] = {};
  GLuint vertex_stage_ = 0;
  GLuint pipelines_[6] = {0, 0, 0, 0, 0, 0};  // by BatchKind
  GLuint vertex_array_ = 0, texture_ = 0;
  GLuint buffers_[2] = {0, 0};  // vertices, indices
  std::size_t buffer_bytes_[2] = {0, 0};
  GLuint framebuffer_ = 0, picture_ = 0;  // drawn into, and its texture
  int width_ = 0, height_ = 0;
};

}  // namespace

std::unique_ptr<Canvas> MakeCanvas(const Font& font) {
  return std::make_unique<OsmesaCanvas>(font);
}

}  // namespace seam
