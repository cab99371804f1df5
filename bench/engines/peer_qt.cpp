// Qt's painters as a peer process (docs/benchmarks.md): its raster engine, and its OpenGL engine without and
// with multisampling. Needs a display for OpenGL: xvfb-run.

#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

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

#include "bench/measure/measure.hpp"

namespace vtm::bench {
namespace {

struct View {
    int width = 0, height = 0;
    QTransform toPixels;
};

class Document {
public:
    Document(const std::string& path, double width, double height) : picture_(0, 0, width, height) {
        if (!renderer_.load(QString::fromStdString(path)))
            throw std::runtime_error("QSvgRenderer cannot read it");
    }

    void draw(QPaintDevice& device, const QTransform& toPixels) {
        QPainter painter(&device);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setTransform(toPixels);
        renderer_.render(&painter, picture_);
    }

private:
    QSvgRenderer renderer_;
    QRectF picture_;
};

/// Where a painter draws.
class Target {
public:
    virtual ~Target() = default;
    virtual void draw(Document& document, const View& view) = 0;
    virtual QImage image() = 0;
};

class RasterTarget : public Target {
public:
    void draw(Document& document, const View& view) override {
        if (image_.width() != view.width || image_.height() != view.height)
            image_ = QImage(view.width, view.height, QImage::Format_ARGB32_Premultiplied);
        image_.fill(Qt::transparent);
        document.draw(image_, view.toPixels);
    }
    QImage image() override { return image_; }

private:
    QImage image_;
};

class GlTarget : public Target {
public:
    explicit GlTarget(int samples) : samples_(samples) {}

    void draw(Document& document, const View& view) override {
        const QSize size(view.width, view.height);
        if (!buffer_ || buffer_->size() != size)
            make(size);
        QOpenGLFunctions& gl = *QOpenGLContext::currentContext()->functions();
        buffer_->bind();
        gl.glClearColor(0, 0, 0, 0);
        gl.glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        QOpenGLPaintDevice device(size);
        document.draw(device, view.toPixels);
        if (resolved_)
            QOpenGLFramebufferObject::blitFramebuffer(resolved_.get(), buffer_.get());
        gl.glFinish();
    }
    QImage image() override { return buffer_->toImage(); }

private:
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

struct Engine {
    std::unique_ptr<Target> target;
    std::unique_ptr<Document> document = nullptr;
};

class Peer {
public:
    Peer() {
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

    void run() {
        std::cout << "ready" << std::endl;
        for (std::string line; std::getline(std::cin, line);) {
            try {
                const std::string reply = answer(line);  // may throw, before "ok" is said
                std::cout << "ok " << reply << std::endl;
            } catch (const std::exception& error) {
                std::cout << "error " << error.what() << std::endl;
            }
        }
    }

private:
    void add(const std::string& name, const std::string& description, std::unique_ptr<Target> target) {
        std::cout << "engine " << name << " either " << description << "\n";
        engines_[name].target = std::move(target);
    }

    std::string answer(const std::string& line) {
        std::istringstream in(line);
        std::string verb, name;
        in >> verb >> name;
        Engine& engine = engines_.at(name);
        double width = 0, height = 0;
        if (verb == "peak")
            return std::to_string(peakBytes());
        if (verb == "load" || verb == "cold")
            in >> width >> height;
        const View view = verb == "load" ? View() : readView(in);
        const std::string path = rest(in);
        if (verb == "load") {
            engine.document = std::make_unique<Document>(path, width, height);
        } else if (verb == "draw") {
            return std::to_string(cpuTime([&] { engine.target->draw(*engine.document, view); }));
        } else if (verb == "cold") {
            std::unique_ptr<Document> document;  // outlives the clock
            return std::to_string(cpuTime([&] {
                document = std::make_unique<Document>(path, width, height);
                engine.target->draw(*document, view);
            }));
        } else if (verb == "picture") {
            engine.target->draw(*engine.document, view);
            if (!engine.target->image().save(QString::fromStdString(path), "PNG"))
                throw std::runtime_error("the picture cannot be written");
        } else {
            throw std::runtime_error(verb + " is no request");
        }
        return "";
    }

    static std::string rest(std::istream& in) {
        std::string text;
        std::getline(in >> std::ws, text);
        return text;
    }

    static View readView(std::istream& in) {
        View view;
        double m[6];
        in >> view.width >> view.height;
        for (double& number : m)
            in >> number;
        view.toPixels = QTransform(m[0], m[1], m[2], m[3], m[4], m[5]);
        return view;
    }

    QOffscreenSurface surface_;
    QOpenGLContext context_;
    std::map<std::string, Engine> engines_;
};

}  // namespace
}  // namespace vtm::bench

int main(int argc, char** argv) {
    QLoggingCategory::setFilterRules("qt.svg*=false");  // which would cost time
    const QGuiApplication application(argc, argv);
    vtm::bench::Peer().run();
}
