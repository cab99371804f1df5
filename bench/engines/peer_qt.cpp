// Qt's painters as a peer process (docs/benchmarks.md): its raster engine, and its OpenGL engine without and
// with multisampling. Needs a display for OpenGL: xvfb-run.

#include <QGuiApplication>
#include <QImage>
#include <QLoggingCategory>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <QSvgRenderer>

#include "bench/engines/peer_process.hpp"

namespace vtm::bench {
namespace {

QTransform matrixOf(const asset::View& view) {
    const glm::dmat3x2& m = view.toPixels;
    return {m[0][0], m[0][1], m[1][0], m[1][1], m[2][0], m[2][1]};
}

/// Where a painter draws.
class Target : public Peer {
public:
    using Paint = std::function<void(QPaintDevice&)>;

    std::unique_ptr<Document> read(const std::string& path, double width, double height) override;
    image::Bitmap pixels() const override {
        const QImage straight = drawn().convertToFormat(QImage::Format_RGBA8888);
        image::Bitmap bitmap{straight.width(), straight.height(), {}};
        for (int y = 0; y < straight.height(); ++y)
            bitmap.rgba.insert(bitmap.rgba.end(), straight.constScanLine(y),
                               straight.constScanLine(y) + 4 * straight.width());
        return bitmap;
    }

    /// `paint` is given a device of this size, transparent.
    virtual void draw(int width, int height, const Paint& paint) = 0;

protected:
    virtual QImage drawn() const = 0;
};

class QtDocument : public Document {
public:
    QtDocument(Target& target, const std::string& path, double width, double height)
        : target_(target), picture_(0, 0, width, height) {
        if (!renderer_.load(QString::fromStdString(path)))
            throw std::runtime_error("QSvgRenderer cannot read it");
    }

    void draw(const asset::View& view) override {
        target_.draw(view.width, view.height, [&](QPaintDevice& device) {
            QPainter painter(&device);
            painter.setRenderHint(QPainter::Antialiasing);
            painter.setTransform(matrixOf(view));
            renderer_.render(&painter, picture_);
        });
    }

private:
    Target& target_;
    QSvgRenderer renderer_;
    QRectF picture_;
};

std::unique_ptr<Document> Target::read(const std::string& path, double width, double height) {
    return std::make_unique<QtDocument>(*this, path, width, height);
}

class RasterTarget : public Target {
public:
    void draw(int width, int height, const Paint& paint) override {
        if (image_.width() != width || image_.height() != height)
            image_ = QImage(width, height, QImage::Format_ARGB32_Premultiplied);
        image_.fill(Qt::transparent);
        paint(image_);
    }

private:
    QImage drawn() const override { return image_; }

    QImage image_;
};

class GlTarget : public Target {
public:
    explicit GlTarget(int samples) : samples_(samples) {}

    void draw(int width, int height, const Paint& paint) override {
        const QSize size(width, height);
        if (!buffer_ || buffer_->size() != size)
            make(size);
        QOpenGLFunctions& gl = *QOpenGLContext::currentContext()->functions();
        buffer_->bind();
        gl.glClearColor(0, 0, 0, 0);
        gl.glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        QOpenGLPaintDevice device(size);
        paint(device);
        if (resolved_)
            QOpenGLFramebufferObject::blitFramebuffer(resolved_.get(), buffer_.get());
        gl.glFinish();
    }

private:
    QImage drawn() const override { return buffer_->toImage(); }

    void make(QSize size) {
        QOpenGLFramebufferObjectFormat format;
        format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
        format.setSamples(samples_);
        buffer_ = std::make_unique<QOpenGLFramebufferObject>(size, format);
        if (!buffer_->isValid() || buffer_->format().samples() != samples_)
            throw std::runtime_error("OpenGL refuses a framebuffer of this size and number of samples");
        resolved_.reset(samples_ > 0 ? new QOpenGLFramebufferObject(size) : nullptr);
    }

    int samples_;
    std::unique_ptr<QOpenGLFramebufferObject> buffer_, resolved_;
};

/// Qt's engines that are here.
class QtProcess {
public:
    QtProcess() {
        const std::string version = std::string("Qt ") + qVersion();
        add("qt-raster", version + " QSvgRenderer, raster engine", std::make_unique<RasterTarget>());
        surface_.create();
        if (!context_.create() || !context_.makeCurrent(&surface_)) {
            std::cout << "missing qt-gl: no OpenGL context on Qt's platform "
                      << QGuiApplication::platformName().toStdString() << " (xvfb).\n";
            return;
        }
        const auto* renderer = context_.functions()->glGetString(GL_RENDERER);
        const std::string gl =
            version + " QSvgRenderer, OpenGL engine on " + reinterpret_cast<const char*>(renderer);
        add("qt-gl", gl + ", one sample", std::make_unique<GlTarget>(0));
        add("qt-gl-4", gl + ", 4 samples", std::make_unique<GlTarget>(4));
    }

    void run() { process_.run(); }

private:
    void add(const std::string& name, const std::string& description, std::unique_ptr<Target> target) {
        process_.add(name, "either", description, std::move(target));
    }

    QOffscreenSurface surface_;
    QOpenGLContext context_;
    PeerProcess process_;
};

}  // namespace
}  // namespace vtm::bench

int main(int argc, char** argv) {
    QLoggingCategory::setFilterRules("qt.svg*=false");  // which would cost time
    const QGuiApplication application(argc, argv);
    vtm::bench::QtProcess().run();
}
